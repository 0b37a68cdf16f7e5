#include "streets/street_width.h"

#include <algorithm>
#include <cmath>

#include "streets/street_classes.h"

namespace plat::streets {
namespace {

/// Gaps are sampled in the middle of equal parts of the line, so that no sample lies on a crossing.
std::optional<double> median_gap_m(const Polyline& line, const SegmentIndex& boundaries,
                                   const WidthOptions& options) {
  const double total_m = length_m(line);
  const auto count =
      static_cast<std::size_t>(std::clamp(std::ceil(total_m / options.sample_step_m), 3.0, 64.0));
  std::vector<double> gaps;
  std::size_t i = 1;
  double before_m = 0.0;  // length of the line up to point i - 1
  for (std::size_t k = 0; k < count; ++k) {
    const double at_m = total_m * (static_cast<double>(k) + 0.5) / static_cast<double>(count);
    while (i + 1 < line.size() && before_m + distance(line[i - 1], line[i]) < at_m) {
      before_m += distance(line[i - 1], line[i]);
      ++i;
    }
    const Point along = normalized(line[i] - line[i - 1]);
    const Point p = line[i - 1] + (at_m - before_m) * along;
    const Point across = perpendicular(along);
    const auto left = free_distance_m(boundaries, p, across, options.max_width_m);
    if (!left) continue;
    const auto right = free_distance_m(boundaries, p, -across, options.max_width_m);
    if (!right) continue;
    const double gap = *left + *right;
    if (gap >= options.min_width_m && gap <= options.max_width_m) gaps.push_back(gap);
  }
  // A street measured at one sample in three or fewer runs along open land or through plots.
  if (gaps.empty() || 3 * gaps.size() <= count) return std::nullopt;
  const auto middle = gaps.begin() + static_cast<std::ptrdiff_t>(gaps.size() / 2);
  std::nth_element(gaps.begin(), middle, gaps.end());
  return *middle;
}

}  // namespace

SegmentIndex boundary_index(std::span<const Polygon> land) {
  std::vector<Segment> segments;
  for (const Polygon& polygon : land)
    for_each_edge(polygon, [&](const Segment& s) { segments.push_back(s); });
  return SegmentIndex(std::move(segments));
}

std::optional<double> free_distance_m(const SegmentIndex& boundaries, Point origin, Point direction,
                                      double max_m) {
  const auto hit =
      boundaries.first_hit(origin, direction, max_m, [](std::uint32_t) { return true; });
  if (!hit) return std::nullopt;
  const Segment& s = boundaries.segments()[hit->segment];
  const bool is_entered = dot(perpendicular(s.b - s.a), direction) > 0.0;
  if (!is_entered) return std::nullopt;
  return hit->distance_m;
}

void assign_widths(StreetNetwork& network, std::span<const Polygon> land,
                   const WidthOptions& options, Jobs jobs) {
  const SegmentIndex boundaries = boundary_index(land);
  parallel_for(network.streets.size(), jobs, [&](std::size_t i) {
    Street& street = network.streets[i];
    const auto give = [&](double width_m, WidthSource source) {
      street.width_m = width_m;
      street.width_source = source;
    };
    if (street.attributes.given_width_m)
      return give(*street.attributes.given_width_m, WidthSource::kAttribute);
    if (street.attributes.lanes) {
      return give(*street.attributes.lanes * options.lane_width_m + 2.0 * options.pavement_m,
                  WidthSource::kLanes);
    }
    if (!land.empty()) {
      if (const auto gap = median_gap_m(street.line, boundaries, options))
        return give(*gap, WidthSource::kGap);
    }
    if (const auto rule = class_rule(street.attributes.street_class))
      return give(rule->width_m, WidthSource::kClass);
    give(options.default_width_m, WidthSource::kAssumed);
  });
}

}  // namespace plat::streets
