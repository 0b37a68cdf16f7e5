#include "harness/scripted_site.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "core/box.h"
#include "core/rng.h"
#include "core/working_grid.h"
#include "harness/synthesis_sources.h"
#include "streets/exemplar.h"
#include "streets/segment_index.h"
#include "synthesis/city_expansion.h"
#include "synthesis/point_blend.h"
#include "synthesis/point_join.h"

namespace plat::harness {
namespace {

using streets::IntersectionPoint;
using synthesis::PointSet;

Point center_of(const PointSet& points) {
  Box box;
  for (const IntersectionPoint& point : points) box.add(point.place);
  return snap(box.center());
}

/// Points nearer to an existing street than this share of their mean distance are left out, as
/// expand() does.
constexpr double kClearanceShare_01 = synthesis::ExpansionOptions{}.clearance_share_01;

class SiteBuilder {
 public:
  SiteBuilder(const SynthesisScript& script, std::uint64_t seed, Jobs jobs)
      : script_(script), seed_(seed) {
    for (const ScriptExample& example : script.examples)
      examples_.push_back(read_example(example.source, script.source, jobs));
    frame_.source = script.source;
    if (script.city) {
      ReadCity city = read_city_streets(*script.city, script.source, jobs);
      frame_.frame = city.frame;
      frame_.anchor = snap(box_of(city.network.nodes).center());
      growth_.existing = std::move(city.network);
      parcels_ = std::move(city.parcels);
    } else {
      frame_.frame = examples_.front().frame;
      frame_.anchor = center_of(examples_.front().points);
    }
  }

  ScriptedSite build() {
    for (std::size_t i = 0; i < script_.operations.size(); ++i) run(script_.operations[i], i);
    if (growth_.points.empty())
      throw InputError(script_.source + ": operations: no point is left to grow streets from");
    if (script_.boundary) {
      growth_.boundary = polygon_in(frame_, *script_.boundary);
    } else if (script_.operations.size() > 1) {
      growth_.boundary.reset();  // the region of one expansion would bound the others
    }
    for (const ScriptRegion& region : script_.obstacles) {
      for (Polygon& polygon : polygons_in(frame_, region))
        growth_.obstacles.push_back(std::move(polygon));
    }
    ScriptedSite out{{std::move(growth_), {}, {}}, frame_.frame};
    if (script_.city) know_city(out.site);
    return out;
  }

 private:
  void run(const ScriptOperation& operation, std::size_t index) {
    Rng rng(derive_seed(seed_, {seed_key("operations"), index}));
    if (const auto* join = std::get_if<JoinOperation>(&operation.what)) {
      add(joined(*join), operation, join->spacing);
    } else if (const auto* blend = std::get_if<BlendOperation>(&operation.what)) {
      add(blended(*blend, operation, rng), operation, blend->options.spacing);
    } else {
      expand(std::get<ExpandOperation>(operation.what), operation);
    }
  }

  /// Points of an operation behind those that are there.
  void add(PointSet points, const ScriptOperation& operation, const synthesis::Spacing& spacing) {
    if (operation.region) {
      const Polygon region = polygon_in(frame_, *operation.region);
      std::erase_if(points, [&](const IntersectionPoint& point) {
        return locate(region, point.place) == Side::kOutside;
      });
    }
    keep_clear_of_streets(points);
    add(std::move(points), spacing);
  }
  void add(PointSet points, const synthesis::Spacing& spacing) {
    const std::array<PointSet, 2> sets{std::move(growth_.points), std::move(points)};
    growth_.points = synthesis::join(sets, spacing);
  }

  void keep_clear_of_streets(PointSet& points) const {
    std::vector<Segment> segments;
    for (const streets::Street& street : growth_.existing.streets) {
      for (std::size_t i = 1; i < street.line.size(); ++i)
        segments.push_back({street.line[i - 1], street.line[i]});
    }
    const streets::SegmentIndex index(std::move(segments));
    std::erase_if(points, [&](const IntersectionPoint& point) {
      const double clearance_m = kClearanceShare_01 * synthesis::mean_distance_m(point);
      return index.nearest(point.place, clearance_m, [](std::uint32_t) { return true; })
          .has_value();
    });
  }

  [[nodiscard]] PointSet copy_of(const ScriptCopy& copy) const {
    const ReadExample& example = examples_[copy.example];
    synthesis::Placement placement;
    placement.pivot = center_of(example.points);
    placement.mirroring = copy.mirroring;
    placement.scale = copy.scale;
    placement.rotation_rad = copy.rotation_rad;
    Point target = frame_.anchor;
    if (copy.at) {
      target = place_in(frame_, *copy.at);
    } else if (example.frame.crs_wkt == frame_.frame.crs_wkt) {
      target = placement.pivot + (example.frame.origin - frame_.frame.origin);
    }
    placement.translation = target - placement.pivot;
    PointSet out = synthesis::place(example.points, placement);
    for (const IntersectionPoint& point : out) {
      if (std::abs(point.place.x) < kGridExtent_m && std::abs(point.place.y) < kGridExtent_m)
        continue;
      refuse(copy.path, fmt::format("the copy lies {:.0f} km away from the layout's centre",
                                    1e-3 * distance(target, frame_.anchor)));
    }
    return out;
  }

  [[nodiscard]] PointSet joined(const JoinOperation& join) const {
    std::vector<PointSet> copies;
    for (const ScriptCopy& copy : join.copies) copies.push_back(copy_of(copy));
    return synthesis::join(copies, join.spacing);
  }

  [[nodiscard]] PointSet blended(const BlendOperation& blend, const ScriptOperation& operation,
                                 Rng& rng) const {
    const PointSet first = copy_of(blend.first);
    const PointSet second = copy_of(blend.second);
    const auto with = [&](const auto& weight) {
      return synthesis::blend(first, second, weight, blend.options, rng);
    };
    if (const auto* constant = std::get_if<double>(&blend.weight))
      return with(synthesis::ConstantWeight{*constant});
    if (const auto* ramp = std::get_if<ScriptRamp>(&blend.weight)) {
      const synthesis::RampWeight weight{place_in(frame_, ramp->from), place_in(frame_, ramp->to)};
      if (weight.from == weight.to) refuse(operation.path + ".weight", "from and to are one place");
      return with(weight);
    }
    const auto across =
        synthesis::ramp_across(synthesis::PointQuadtree(first, blend.options.quadtree),
                               synthesis::PointQuadtree(second, blend.options.quadtree));
    if (!across) {
      refuse(operation.path + ".weight",
             "the copies' boxes do not overlap, or have one centre: give a number, or from and to");
    }
    return with(*across);
  }

  void expand(const ExpandOperation& expand, const ScriptOperation& operation) {
    synthesis::ExpansionOptions options = expand.options;
    if (expand.copy.at) options.copy_place = synthesis::CopyPlace::kAsPlaced;
    auto grown =
        synthesis::expand(growth_.existing, parcels_, polygon_in(frame_, *operation.region),
                          copy_of(expand.copy), options, script_.city->exemplar);
    if (!grown) refuse(operation.path, grown.error().message);
    growth_.existing = std::move(grown->site.existing);
    open_ends_ = std::move(grown->site.open_ends);
    growth_.boundary = std::move(grown->site.boundary);
    add(std::move(grown->site.points), options.spacing);
  }

  /// What is known of the city's streets, which operations may have cut: points, levels, and the
  /// ends from which new streets may go on. A single expansion chose its ends itself.
  void know_city(synthesis::LayoutSite& site) const {
    const streets::StreetNetwork& existing = site.growth.existing;
    const streets::Exemplar known =
        streets::exemplar_of(existing, parcels_, script_.city->exemplar);
    const bool is_one_expansion =
        script_.operations.size() == 1 && script_.operations.front().name == "expand";
    site.growth.open_ends = is_one_expansion ? open_ends_ : streets::open_ends_of(existing, known);
    site.existing_segments.resize(existing.streets.size());
    for (std::uint32_t c = 0; c < known.chains.size(); ++c) {
      for (const streets::StreetChain::Piece& piece : known.chains[c].pieces)
        site.existing_segments[piece.street] = {known.chains[c].hierarchy, c};
    }
    site.existing_points = known.points;
  }

  [[noreturn]] void refuse(const std::string& path, std::string_view what) const {
    throw InputError(fmt::format("{}: {}: {}", script_.source, path, what));
  }

  const SynthesisScript& script_;
  std::uint64_t seed_;
  std::vector<ReadExample> examples_;
  ScriptFrame frame_;
  streets::GrowthSite growth_;
  std::vector<streets::OpenEnd> open_ends_;
  std::vector<Polygon> parcels_;
};

}  // namespace

ScriptedSite scripted_site(const SynthesisScript& script, std::uint64_t seed, Jobs jobs) {
  return SiteBuilder(script, seed, jobs).build();
}

}  // namespace plat::harness
