#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <tuple>
#include <vector>

#include "core/options.h"
#include "core/rng.h"
#include "synthesis/point_quadtree.h"
#include "synthesis/point_set.h"

namespace plat::synthesis {

/// The same weight everywhere: 0 is the style of the first set, 1 that of the second.
struct ConstantWeight {
  double weight_01 = 0.5;
  [[nodiscard]] double operator()(Point) const { return weight_01; }
};

/// Grows linearly along an axis: 0 at and before `from`, 1 at and behind `to`. Pre: from != to.
struct RampWeight {
  Point from;
  Point to;
  [[nodiscard]] double operator()(Point place) const;
};

/// The ramp from the first set to the second across the overlap of their boxes, along the line of
/// their centres; none where the boxes do not overlap or have one centre.
std::optional<RampWeight> ramp_across(const PointQuadtree& a, const PointQuadtree& b);

/// Where the points of a blend lie.
enum class BlendPositions : std::uint8_t {
  kThinned,  ///< where they are in one of the sets
  kMorphed,  ///< points of both sets that correspond meet on the way from one to the other
};

struct BlendOptions {
  QuadtreeOptions quadtree{};
  Spacing spacing{};
  BlendPositions positions = BlendPositions::kThinned;
  std::int64_t patch_places = 20;
  static constexpr auto fields() {
    return std::tuple{EnumField{"positions",
                                &BlendOptions::positions,
                                {EnumName{"thinned", BlendPositions::kThinned},
                                 EnumName{"morphed", BlendPositions::kMorphed}},
                                "Where the points of a blend lie."},
                      Field{"patch_places", &BlendOptions::patch_places, 1, 1000000,
                            "Places that are taken from the same set together, about; 1: each by "
                            "itself."}};
  }
};

/// Blends two point sets where their boxes overlap; outside, each stays as it is.
///
/// At a place of weight w, as many points are taken as (1 - w) of the first set and w of the second
/// have there, and every attribute of a point is the weighted mean of its own and of what streets
/// of its rank have in the leaf of the other set around it.
///
/// Guarantees: 1. weight 0 gives, in the overlap, the points of `a` unchanged, weight 1 those of
/// `b`;  2. the points of `a` come first, both in their order; levels and connections are a point's
/// own;  3. every other attribute lies between the point's own and the other leaf's mean and is
/// linear in the weight;  4. in the overlap no more places than the weighted sum of both sets;  5.
/// points of different sets keep the spacing;  6. the same stream gives the same points.
/// @param weight  called with places of points: [0, 1]
/// Complexity: O(n log n) where places are of similar density
/// Paper: [AVB08, Sec. 4.2, "blend"]
/// Deviation: which points are taken is ours (ADR 0029)
template <class Weight>
PointSet blend(std::span<const streets::IntersectionPoint> a,
               std::span<const streets::IntersectionPoint> b, const Weight& weight,
               const BlendOptions& options, Rng& rng);

/// The same with the weight at every point, in their order.
PointSet blend_weighted(std::span<const streets::IntersectionPoint> a,
                        std::span<const streets::IntersectionPoint> b,
                        std::span<const double> weights_a_01, std::span<const double> weights_b_01,
                        const BlendOptions& options, Rng& rng);

template <class Weight>
PointSet blend(std::span<const streets::IntersectionPoint> a,
               std::span<const streets::IntersectionPoint> b, const Weight& weight,
               const BlendOptions& options, Rng& rng) {
  const auto weights_of = [&](std::span<const streets::IntersectionPoint> points) {
    std::vector<double> out;
    out.reserve(points.size());
    for (const streets::IntersectionPoint& point : points) out.push_back(weight(point.place));
    return out;
  };
  return blend_weighted(a, b, weights_of(a), weights_of(b), options, rng);
}

}  // namespace plat::synthesis
