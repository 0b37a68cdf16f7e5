#include "parcels/random_divisions.h"

#include <algorithm>

namespace plat::parcels {
namespace {

/// Widths are kept within this factor of their mean, so that no draw makes one of no width.
constexpr double kMinWidthShare = 0.25;
constexpr double kMaxWidthShare = 4.0;

}  // namespace

std::vector<double> random_divisions(double length_m, int count, double relative_deviation,
                                     Rng& rng) {
  std::vector<double> ends{0.0};
  for (int i = 0; i < count; ++i) {
    ends.push_back(ends.back() +
                   std::clamp(rng.normal(1.0, relative_deviation), kMinWidthShare, kMaxWidthShare));
  }
  const double sum = ends.back();
  for (double& end : ends) end *= length_m / sum;
  return ends;
}

}  // namespace plat::parcels
