#include "imagery/imagery_plan.h"

#include <algorithm>
#include <map>
#include <string>

#include "core/failure.h"

namespace plat::imagery {

double SourceWeight::at(Point p) const {
  if (!ramp) return begin_01;
  const double t = nearest_parameter(*ramp, p);
  return begin_01 + t * (end_01 - begin_01);
}

namespace {

using OwnParcels = std::vector<std::map<std::string, std::size_t>>;  // per example, by id

OwnParcels own_parcels(std::span<const ImageExample> examples, OwnImage own_image) {
  OwnParcels own(examples.size());
  if (own_image == OwnImage::kAllowed) return own;
  for (std::size_t e = 0; e < examples.size(); ++e) {
    for (std::size_t i = 0; i < examples[e].parcels.size(); ++i)
      own[e].emplace(examples[e].parcels[i].id, i);
  }
  return own;
}

}  // namespace

std::vector<std::optional<ParcelImage>> plan_imagery(std::span<const ParcelShape> targets,
                                                     std::span<const ImageExample> examples,
                                                     const PlanOptions& options, Jobs jobs) {
  expects(examples.size() == 1 || examples.size() == 2, "images come from one example or two");
  std::vector<ImageRetrieval> retrievals;
  for (const ImageExample& example : examples)
    retrievals.emplace_back(example.parcels, options.retrieval);
  const OwnParcels own = own_parcels(examples, options.own_image);
  return parallel_map<std::optional<ParcelImage>>(
      targets.size(), jobs, [&](std::size_t i) -> std::optional<ParcelImage> {
        const ParcelShape& target = targets[i];
        Rng rng(derive_seed(options.seed, {seed_key("imagery"), i}));
        const double weight = options.weight.at(target.box.center);
        const std::size_t drawn = drawn_source(weight, rng);
        ParcelImage image;
        image.example = std::min(drawn, examples.size() - 1);
        std::optional<std::size_t> excluded;
        if (const auto self = own[image.example].find(target.id); self != own[image.example].end())
          excluded = self->second;
        const auto match = retrievals[image.example].nearest(target, rng, excluded);
        if (!match) return std::nullopt;
        image.match = *match;
        const ParcelShape& source = examples[image.example].parcels[match->example];
        image.grid = warp_grid(source, target, match->symmetry);
        return image;
      });
}

}  // namespace plat::imagery
