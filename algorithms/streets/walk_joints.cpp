#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/working_grid.h"
#include "streets/growth_cells.h"
#include "streets/transition.h"
#include "streets/walk_joints_internal.h"

namespace plat::streets::detail {
namespace {

/// Deviation of a joint's length, as a share of the mean distance and its deviation together: at a
/// threshold of 0.01 a joint is no longer than one and a half times their sum.
constexpr double kLengthShare = 0.5;

double gaussian(double deviations) { return std::exp(-0.5 * deviations * deviations); }

double length_deviation_m(const PassingStreet& street, double min_deviation_m) {
  const double deviation_m = std::max(std::sqrt(street.distance_variance_m2), min_deviation_m);
  return std::max(kLengthShare * (street.distance_mean_m + deviation_m), kGridStep_m);
}

/// A slot without a segment has no direction to turn from.
double by_turn(const WalkSlot& slot, Point way, double deviation_rad) {
  return slot.heading ? gaussian(turn_between(*slot.heading, way) / deviation_rad) : 1.0;
}

}  // namespace

std::vector<WalkStep> open_end_joints(const WalkSlots& slots,
                                      const RandomWalkGrower::Options& options) {
  const double most_deviations = std::sqrt(-2.0 * std::log(options.threshold));
  std::vector<double> deviation_m;  // per open end
  for (std::uint32_t end = 0; end < slots.open_ends(); ++end) {
    deviation_m.push_back(length_deviation_m(slots[end].style, options.min_distance_deviation_m));
  }
  std::vector<WalkStep> steps;
  if (deviation_m.empty()) return steps;
  const double widest_m =
      most_deviations * *std::max_element(deviation_m.begin(), deviation_m.end());
  GrowthCells cells(std::max(widest_m, kGridStep_m));
  for (std::uint32_t i = slots.open_ends(); i < slots.size(); ++i) {
    if (slots[i].is_free()) cells.add({slots[i].place, slots[i].place}, i);
  }

  for (std::uint32_t from = 0; from < slots.open_ends(); ++from) {
    const WalkSlot& end = slots[from];
    if (!end.is_free()) continue;
    const double reach_m = most_deviations * deviation_m[from];
    const Point reach{reach_m, reach_m};
    std::vector<std::uint32_t> near;
    cells.for_each_in(Box{end.place - reach, end.place + reach}, [&](std::uint32_t i) {
      if (slots[i].vertex != end.vertex) near.push_back(i);
      return true;
    });
    std::sort(near.begin(), near.end());
    near.erase(std::unique(near.begin(), near.end()), near.end());
    for (const std::uint32_t to : near) {
      const Point way = slots[to].place - end.place;
      const double p = gaussian(length(way) / deviation_m[from]) *
                       by_turn(end, way, options.joint_angle_deviation_rad) *
                       by_turn(slots[to], -way, options.joint_angle_deviation_rad);
      if (p >= options.threshold) steps.push_back({from, to, p});
    }
  }
  const auto key = [&](const WalkStep& s) {
    return std::tuple(-s.probability, slots[s.from].vertex, slots[s.to].vertex, s.from, s.to);
  };
  std::sort(steps.begin(), steps.end(),
            [&](const WalkStep& a, const WalkStep& b) { return key(a) < key(b); });
  return steps;
}

}  // namespace plat::streets::detail
