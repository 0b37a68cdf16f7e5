#include "similarity/shape_context_similarity.h"

#include "similarity/cyclic_warping.h"
#include "similarity/rigid_alignment.h"
#include "similarity/shape_admission.h"

namespace plat::similarity {
namespace {

CyclicWarping warping(const ShapeContextSimilarity::Prepared& a,
                      const ShapeContextSimilarity::Prepared& b) {
  return cheapest_cyclic_warping(a.contexts.samples, context_costs(a.contexts, b.contexts));
}

double distance_of(const CyclicWarping& warping, std::size_t samples) {
  return warping.cost / static_cast<double>(samples);
}

}  // namespace

Expected<ShapeContextSimilarity::Prepared> ShapeContextSimilarity::prepare(
    const LabelledShape& shape) const {
  if (auto defect = find_shape_defect(shape)) return tl::unexpected(std::move(*defect));
  OutlineSamples outline =
      outline_samples(shape.polygon.outer, static_cast<std::size_t>(options_.samples));
  ShapeContexts contexts =
      shape_contexts(outline,
                     {.angular = static_cast<std::size_t>(options_.angular_bins),
                      .distance = static_cast<std::size_t>(options_.distance_bins),
                      .inner_radius_m = options_.inner_radius_m,
                      .outer_radius_m = options_.outer_radius_m},
                     options_.alignment);
  return Prepared{std::move(outline), std::move(contexts)};
}

double ShapeContextSimilarity::distance(const Prepared& a, const Prepared& b) const {
  return distance_of(warping(a, b), a.contexts.samples);
}

ShapeComparison ShapeContextSimilarity::compare(const Prepared& a, const Prepared& b) const {
  const CyclicWarping matched = warping(a, b);
  ShapeComparison out{distance_of(matched, a.contexts.samples), {}, {}};
  out.correspondence.reserve(matched.matches.size());
  for (const auto& [i, j] : matched.matches)
    out.correspondence.emplace_back(a.outline.origin + a.outline.places[i],
                                    b.outline.origin + b.outline.places[j]);
  out.transformation = rigid_alignment(out.correspondence);
  return out;
}

SimilarityClaims ShapeContextSimilarity::claims() const {
  return {.is_symmetric = true,
          .rotation = options_.alignment != ContextAlignment::kNone,
          .collinear_vertices = true};
}

}  // namespace plat::similarity
