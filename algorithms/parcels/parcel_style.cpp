#include "parcels/parcel_style.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "parcels/parcel_measures.h"

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

ParcelStyle style_of(const blocks::Block& block, std::span<const Polygon> parcels) {
  ParcelStyle style;
  style.count = parcels.size();
  if (parcels.empty()) return style;
  std::vector<double> areas;
  std::vector<double> widths;
  std::vector<double> aspect_ratios;
  double with_access = 0.0;
  double area_with_access_m2 = 0.0;
  for (const ParcelMeasures& m : measure_parcels(block, parcels)) {
    areas.push_back(m.area_m2);
    widths.push_back(m.width_m);
    aspect_ratios.push_back(m.aspect_ratio);
    if (!m.has_street_access) continue;
    with_access += 1.0;
    area_with_access_m2 += m.area_m2;
  }
  const Moments area = moments(areas);
  const Moments width = moments(widths);
  const auto count = static_cast<double>(parcels.size());
  style.area_mean_m2 = area.mean;
  style.area_deviation_m2 = area.deviation;
  style.width_mean_m = width.mean;
  style.width_deviation_m = width.deviation;
  style.aspect_ratio_mean = moments(aspect_ratios).mean;
  style.access_share_01 = with_access / count;
  style.access_area_01 = std::min(1.0, area_with_access_m2 / (area.mean * count));
  std::vector<double> rows;
  for (const int row : parcel_rows(block, parcels)) {
    if (row > 0) rows.push_back(static_cast<double>(row));
  }
  style.rows_mean = moments(rows).mean;
  return style;
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
