#include "parcels/parcel_style.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/oriented_box.h"

namespace plat::parcels {
namespace {

struct Moments {
  double mean = 0.0;
  double deviation = 0.0;
};

Moments moments(std::span<const double> values) {
  if (values.empty()) return {};
  double sum = 0.0;
  for (const double v : values) sum += v;
  const double mean = sum / static_cast<double>(values.size());
  double squares = 0.0;
  for (const double v : values) squares += (v - mean) * (v - mean);
  return {mean,
          values.size() < 2 ? 0.0 : std::sqrt(squares / static_cast<double>(values.size() - 1))};
}

}  // namespace

ParcelStyle style_of(std::span<const Polygon> parcels) {
  std::vector<double> areas;
  std::vector<double> widths;
  for (const Polygon& p : parcels) {
    areas.push_back(area_m2(p));
    widths.push_back(minimum_area_box(p).width_m);
  }
  const Moments area = moments(areas);
  const Moments width = moments(widths);
  return {parcels.size(), area.mean, area.deviation, width.mean, width.deviation};
}

Bounds bounds_around(double mean, double deviation, double k, double floor) {
  const double half_range = std::max(k * deviation, 0.1 * mean);
  const double low = std::max(floor, mean - half_range);
  return {low, std::max(low, mean + half_range)};
}

LotSize mean_lot(const ParcelStyle& style) {
  constexpr double kLeast_m = 0.5;
  constexpr double kUndivided_m = 1e6;
  if (style.count <= 1) return {kUndivided_m, kUndivided_m};
  const double width = std::clamp(style.width_mean_m, kLeast_m, kUndivided_m);
  return {width, std::clamp(style.area_mean_m2 / width, kLeast_m, kUndivided_m)};
}

}  // namespace plat::parcels
