#include "growth_scaling/made_town.h"

#include <cmath>
#include <utility>

#include "core/rng.h"
#include "core/working_grid.h"

namespace plat::growth_scaling {
namespace {

constexpr double kStep_m = 80.0;
constexpr double kJitter_m = 8.0;
constexpr int kMainEvery = 10;

streets::PassingStreet street_of(int line) {
  const bool is_main = line % kMainEvery == 0;
  streets::PassingStreet out;
  out.hierarchy = is_main ? 0 : 1;
  out.tortuosity = 1.01;
  out.distance_mean_m = kStep_m;
  out.distance_variance_m2 = 2.0 * kJitter_m * kJitter_m;
  out.angle_mean_rad = 0.1;
  out.angle_variance_rad2 = 0.02;
  out.width_m = is_main ? 20.0 : 12.0;
  return out;
}

}  // namespace

std::string_view town_name(TownKind kind) {
  return kind == TownKind::kRegular ? "regular" : "random";
}

std::vector<streets::IntersectionPoint> made_town(TownKind kind, std::size_t points,
                                                  std::uint64_t seed) {
  const int side = static_cast<int>(std::lround(std::sqrt(static_cast<double>(points))));
  const double half_m = 0.5 * kStep_m * side;
  Rng rng(derive_seed(seed, {static_cast<std::uint64_t>(kind), points}));
  std::vector<streets::IntersectionPoint> out;
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column) {
      Point place = kStep_m * Point{static_cast<double>(column), static_cast<double>(row)};
      place = place - Point{half_m, half_m} +
              Point{rng.uniform(-kJitter_m, kJitter_m), rng.uniform(-kJitter_m, kJitter_m)};
      if (kind == TownKind::kRandom)
        place = {rng.uniform(-half_m, half_m), rng.uniform(-half_m, half_m)};
      streets::IntersectionPoint point{snap(place), street_of(row), street_of(column),
                                       std::nullopt};
      if (point.b->hierarchy < point.a.hierarchy) std::swap(point.a, *point.b);
      out.push_back(std::move(point));
    }
  }
  return out;
}

}  // namespace plat::growth_scaling
