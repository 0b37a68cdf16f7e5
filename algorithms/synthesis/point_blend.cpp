#include "synthesis/point_blend.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "core/failure.h"
#include "core/polygon.h"
#include "core/working_grid.h"
#include "synthesis/place_groups_internal.h"

namespace plat::synthesis {
namespace {

using streets::IntersectionPoint;
using streets::PassingStreet;

/// A place of one of the two sets that may be taken.
struct Candidate {
  std::uint32_t set = 0;  ///< 0 for a, 1 for b
  PlaceGroup group;
  double weight_01 = 0.0;  ///< of b, for this place
  double draw_01 = 0.0;
  bool is_shared = false;  ///< in the overlap of the boxes
  std::optional<std::uint32_t> partner{};
  Point place{};  ///< where it is put

  /// The weight of its own set.
  [[nodiscard]] double own_weight_01() const { return set == 0 ? 1.0 - weight_01 : weight_01; }
  [[nodiscard]] double other_weight_01() const { return set == 0 ? weight_01 : 1.0 - weight_01; }
  /// How far it is from being left out; the share of positive ones is its own weight.
  [[nodiscard]] double margin() const {
    return set == 0 ? draw_01 - weight_01 : weight_01 - draw_01;
  }
};

struct Sets {
  std::array<std::span<const IntersectionPoint>, 2> points;
  std::array<std::span<const double>, 2> weights_01;
};

std::vector<Candidate> candidates_of(const Sets& sets, const std::array<PointQuadtree, 2>& trees,
                                     Rng& rng) {
  std::vector<Candidate> out;
  for (std::uint32_t set = 0; set < 2; ++set) {
    for (PlaceGroup& group : groups_of(sets.points[set])) {
      Candidate one{.set = set, .group = std::move(group)};
      one.place = one.group.place;
      one.is_shared = trees[0].contains(one.place) && trees[1].contains(one.place);
      const double weight_01 = sets.weights_01[set][one.group.points.front()];
      one.weight_01 = one.is_shared ? std::clamp(weight_01, 0.0, 1.0) : static_cast<double>(set);
      if (one.is_shared) one.draw_01 = rng.uniform_01();
      out.push_back(std::move(one));
    }
  }
  return out;
}

/// Gives the places of the overlap one draw for each patch: the region nearer to one seed than to
/// any other, seeds being every so many of the places.
void draw_in_patches(std::vector<Candidate>& all, std::int64_t patch_places, PlaceIndex seeds,
                     double cell_m, Rng& rng) {
  if (patch_places == 1) return;
  bool has_seed = false;
  const double chance_01 = 1.0 / static_cast<double>(patch_places);
  for (std::uint32_t i = 0; i < all.size(); ++i) {
    if (!all[i].is_shared || rng.uniform_01() >= chance_01) continue;
    seeds.add(all[i].place, i);
    has_seed = true;
  }
  if (!has_seed) {
    const double draw_01 = rng.uniform_01();
    for (Candidate& one : all) one.draw_01 = draw_01;
    return;
  }
  std::vector<double> draws_01(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    std::optional<std::pair<double, std::uint32_t>> nearest;
    for (double radius_m = cell_m; !nearest; radius_m *= 2.0) {
      seeds.for_each_nearer(all[i].place, radius_m, [&](std::uint32_t seed, double apart_m) {
        if (!nearest || std::pair(apart_m, seed) < *nearest) nearest = {apart_m, seed};
      });
    }
    draws_01[i] = all[nearest->second].draw_01;
  }
  for (std::size_t i = 0; i < all.size(); ++i) all[i].draw_01 = draws_01[i];
}

/// Places of both sets that correspond, nearest pairs first: each nearer than both sets' mean
/// distance to the next intersection. Partners share weight and draw, so that one of them is taken.
void pair_up(std::vector<Candidate>& all, PlaceIndex index) {
  for (std::uint32_t i = 0; i < all.size(); ++i) {
    if (all[i].set == 1 && all[i].is_shared) index.add(all[i].place, i);
  }
  std::vector<std::tuple<double, std::uint32_t, std::uint32_t>> pairs;
  for (std::uint32_t i = 0; i < all.size(); ++i) {
    if (all[i].set == 1 || !all[i].is_shared) continue;
    const double own_m = all[i].group.mean_distance_m;
    index.for_each_nearer(all[i].place, own_m, [&](std::uint32_t j, double apart_m) {
      if (apart_m < all[j].group.mean_distance_m) pairs.emplace_back(apart_m, i, j);
    });
  }
  std::ranges::sort(pairs);
  for (const auto& [apart_m, i, j] : pairs) {
    if (all[i].partner || all[j].partner) continue;
    all[i].partner = j;
    all[j].partner = i;
    all[j].draw_01 = all[i].draw_01;
    all[i].weight_01 = all[j].weight_01 = 0.5 * (all[i].weight_01 + all[j].weight_01);
  }
}

void morph(std::vector<Candidate>& all) {
  for (Candidate& one : all) {
    if (!one.partner || one.set == 1) continue;
    Candidate& other = all[*one.partner];
    if (one.weight_01 == 0.0 || one.weight_01 == 1.0) continue;
    one.place = other.place = snap(lerp(one.group.place, other.group.place, one.weight_01));
  }
}

/// The order in which places are taken: in the overlap those of full weight, then all outside it,
/// then the surest first.
std::vector<std::uint32_t> order_of(std::span<const Candidate> all) {
  std::vector<std::uint32_t> order(all.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  const auto rank = [&](std::uint32_t i) {
    const Candidate& one = all[i];
    if (one.is_shared && one.own_weight_01() == 1.0) return std::tuple(0, 0.0, i);
    if (!one.is_shared) return std::tuple(1, 0.0, i);
    return std::tuple(2, -one.margin(), i);
  };
  std::ranges::sort(order, {}, rank);
  return order;
}

/// Takes as many places of the overlap as the weights sum to, none too near to one of the other
/// set.
std::vector<bool> taken_of(std::span<const Candidate> all, const Spacing& spacing,
                           PlaceIndex index) {
  double wanted = 0.0;
  for (const Candidate& one : all) wanted += one.is_shared ? one.own_weight_01() : 0.0;
  auto left = static_cast<std::int64_t>(std::llround(wanted));
  std::vector<bool> taken(all.size(), false);
  for (const std::uint32_t i : order_of(all)) {
    const Candidate& one = all[i];
    if (one.is_shared && (left == 0 || one.own_weight_01() == 0.0)) continue;
    const double own_m = one.group.mean_distance_m;
    bool is_free = true;
    index.for_each_nearer(
        one.place, spacing.between_m(own_m, own_m), [&](std::uint32_t j, double apart_m) {
          const double needed_m = spacing.between_m(own_m, all[j].group.mean_distance_m);
          if (all[j].set != one.set && apart_m < needed_m) is_free = false;
        });
    if (!is_free) continue;
    taken[i] = true;
    index.add(one.place, i);
    if (one.is_shared) --left;
  }
  return taken;
}

void mix(PassingStreet& street, const PassingStreet& other, double other_weight_01) {
  const auto towards = [&](double& own, double its) { own = std::lerp(own, its, other_weight_01); };
  towards(street.tortuosity, other.tortuosity);
  towards(street.distance_mean_m, other.distance_mean_m);
  towards(street.distance_variance_m2, other.distance_variance_m2);
  towards(street.angle_mean_rad, other.angle_mean_rad);
  towards(street.angle_variance_rad2, other.angle_variance_rad2);
  towards(street.width_m, other.width_m);
}

/// The point with the attributes of the other set's streets of the same rank mixed into it.
IntersectionPoint mixed(IntersectionPoint point, const PointQuadtree& own,
                        const PointQuadtree& other, double other_weight_01) {
  if (other_weight_01 == 0.0) return point;
  const auto mix_in = [&](PassingStreet& street) {
    const auto ranks = own.ranks_at(point.place, street.hierarchy);
    if (!ranks) return;
    if (const auto style = other.style_at(point.place, *ranks))
      mix(street, *style, other_weight_01);
  };
  mix_in(point.a);
  if (point.b) mix_in(*point.b);
  const std::optional<double> area_m2 = other.parcel_area_at_m2(point.place);
  if (point.parcel_area_m2 && area_m2) {
    point.parcel_area_m2 = std::lerp(*point.parcel_area_m2, *area_m2, other_weight_01);
  }
  return point;
}

/// The part of a convex ring to the left of a line.
Ring clipped(const Ring& ring, Segment line) {
  Ring out;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point p = ring[i];
    const Point q = ring[i + 1 == ring.size() ? 0 : i + 1];
    const double side_p = orientation(line.a, line.b, p);
    const double side_q = orientation(line.a, line.b, q);
    if (side_p >= 0.0) out.push_back(p);
    if ((side_p < 0.0) != (side_q < 0.0) && side_p != side_q) {
      out.push_back(lerp(p, q, side_p / (side_p - side_q)));
    }
  }
  return out;
}

}  // namespace

double RampWeight::operator()(Point place) const { return nearest_parameter({from, to}, place); }

std::optional<RampWeight> ramp_across(const PointQuadtree& a, const PointQuadtree& b) {
  if (a.nodes().empty() || b.nodes().empty()) return std::nullopt;
  Ring overlap = a.corners(0);
  const Ring other = b.corners(0);
  for (std::size_t i = 0; i < other.size(); ++i) {
    overlap = clipped(overlap, {other[i], other[(i + 1) % other.size()]});
  }
  const Point axis = normalized(b.box().center - a.box().center);
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const Point p : overlap) {
    low = std::min(low, dot(p - a.box().center, axis));
    high = std::max(high, dot(p - a.box().center, axis));
  }
  if (!(high - low > kGridStep_m)) return std::nullopt;
  return RampWeight{a.box().center + low * axis, a.box().center + high * axis};
}

PointSet blend_weighted(std::span<const IntersectionPoint> a, std::span<const IntersectionPoint> b,
                        std::span<const double> weights_a_01, std::span<const double> weights_b_01,
                        const BlendOptions& options, Rng& rng) {
  expects(weights_a_01.size() == a.size() && weights_b_01.size() == b.size(),
          "one weight per point");
  const std::array<PointQuadtree, 2> trees{PointQuadtree(a, options.quadtree),
                                           PointQuadtree(b, options.quadtree)};
  const Sets sets{{a, b}, {weights_a_01, weights_b_01}};
  std::vector<Candidate> all = candidates_of(sets, trees, rng);
  std::vector<PlaceGroup> groups;
  for (const Candidate& one : all) groups.push_back(one.group);
  const double cell_m = cell_for_m(groups, options.spacing);
  draw_in_patches(all, options.patch_places, PlaceIndex(cell_m), cell_m, rng);
  pair_up(all, PlaceIndex(cell_m));
  if (options.positions == BlendPositions::kMorphed) morph(all);
  const std::vector<bool> taken = taken_of(all, options.spacing, PlaceIndex(cell_m));

  PointSet out;
  for (std::uint32_t set = 0; set < 2; ++set) {
    std::vector<const Candidate*> candidate_of(sets.points[set].size(), nullptr);
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (all[i].set != set || !taken[i]) continue;
      for (const std::uint32_t point : all[i].group.points) candidate_of[point] = &all[i];
    }
    for (std::size_t i = 0; i < candidate_of.size(); ++i) {
      if (candidate_of[i] == nullptr) continue;
      const Candidate& one = *candidate_of[i];
      IntersectionPoint point =
          mixed(sets.points[set][i], trees[set], trees[1 - set], one.other_weight_01());
      point.place = one.place;
      out.push_back(std::move(point));
    }
  }
  return out;
}

}  // namespace plat::synthesis
