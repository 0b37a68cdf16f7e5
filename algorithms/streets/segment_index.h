#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/box.h"
#include "core/point.h"

namespace plat::streets {

/// Finds segments near a place: a uniform grid of cells, each listing the segments whose box meets
/// it. Memory: one entry per segment and cell; cells are about as large as a mean segment.
class SegmentIndex {
 public:
  struct Hit {
    std::uint32_t segment = 0;
    double distance_m = 0.0;
  };

  explicit SegmentIndex(std::vector<Segment> segments);

  [[nodiscard]] std::span<const Segment> segments() const { return segments_; }

  /// Calls visit(index) for the segments whose cells meet `box`; an index may come several times.
  template <class Visit>
  void for_each_near(const Box& box, Visit visit) const {
    if (segments_.empty() || !bounds_.intersects(box)) return;
    const auto [c0, r0] = cell(box.min);
    const auto [c1, r1] = cell(box.max);
    for (std::int64_t r = r0; r <= r1; ++r) {
      for (std::int64_t c = c0; c <= c1; ++c) {
        const auto bucket = static_cast<std::size_t>(r * columns_ + c);
        for (std::uint32_t k = offsets_[bucket]; k < offsets_[bucket + 1]; ++k) visit(items_[k]);
      }
    }
  }

  /// The nearest segment within `max_m` that `is_wanted(index)`; of equally near ones the lowest.
  template <class IsWanted>
  std::optional<Hit> nearest(Point p, double max_m, IsWanted is_wanted) const {
    std::optional<Hit> best;
    for_each_near(Box{p, p}.expanded(max_m), [&](std::uint32_t i) {
      const double d = distance(segments_[i], p);
      if (d > max_m ||
          (best && (d > best->distance_m || (d == best->distance_m && i >= best->segment)))) {
        return;
      }
      if (is_wanted(i)) best = Hit{i, d};
    });
    return best;
  }

  /// The first wanted segment that the ray from `origin` along the unit vector `direction` meets
  /// within `max_m`.
  template <class IsWanted>
  std::optional<Hit> first_hit(Point origin, Point direction, double max_m,
                               IsWanted is_wanted) const {
    std::optional<Hit> best;
    // Cell by cell would save work on long rays; in steps of one cell's size the box stays small
    // enough.
    const double step = std::max(cell_m_, 1.0);
    for (double from = 0.0; from < max_m; from += step) {
      const double to = std::min(from + step, max_m);
      Box box;
      box.add(origin + from * direction);
      box.add(origin + to * direction);
      for_each_near(box, [&](std::uint32_t i) {
        const double t = ray_parameter(origin, direction, segments_[i]);
        if (!(t >= 0.0 && t <= max_m)) return;
        if (best && (t > best->distance_m || (t == best->distance_m && i >= best->segment))) return;
        if (is_wanted(i)) best = Hit{i, t};
      });
      if (best && best->distance_m <= to) break;
    }
    return best;
  }

 private:
  /// Distance along the ray to its meeting with `s`; negative where they do not meet.
  static double ray_parameter(Point origin, Point direction, const Segment& s) {
    const Point e = s.b - s.a;
    const double denominator = cross(direction, e);
    if (denominator == 0.0) return -1.0;
    const Point w = s.a - origin;
    const double along_segment = cross(w, direction) / denominator;
    if (along_segment < 0.0 || along_segment > 1.0) return -1.0;
    return cross(w, e) / denominator;
  }
  [[nodiscard]] std::pair<std::int64_t, std::int64_t> cell(Point p) const {
    const auto index = [&](double v, double low, std::int64_t count) {
      const double i = std::floor((v - low) / cell_m_);
      return i <= 0.0 ? std::int64_t{0}
                      : std::min(static_cast<std::int64_t>(std::min(i, 1e9)), count - 1);
    };
    return {index(p.x, bounds_.min.x, columns_), index(p.y, bounds_.min.y, rows_)};
  }

  std::vector<Segment> segments_;
  Box bounds_;
  double cell_m_ = 1.0;
  std::int64_t columns_ = 1;
  std::int64_t rows_ = 1;
  std::vector<std::uint32_t> offsets_;
  std::vector<std::uint32_t> items_;
};

}  // namespace plat::streets
