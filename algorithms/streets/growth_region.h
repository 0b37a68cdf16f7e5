#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/polygon.h"

namespace plat::streets {

/// A polygon that is asked again and again where points and segments lie in it. Even-odd, so that
/// rings need not be simple; exact on the working grid at any distance.
class GrowthRegion {
 public:
  explicit GrowthRegion(const Polygon& polygon);

  [[nodiscard]] std::span<const Segment> edges() const { return edges_; }
  /// Pre: on the working grid, or the midpoint of two points that are.
  [[nodiscard]] Side locate(Point p) const;
  /// Whether no part of the segment lies on the side `barred`; its boundary is on neither side.
  [[nodiscard]] bool keeps_off(const Segment& segment, Side barred) const;

 private:
  [[nodiscard]] std::size_t row_of(double y) const;

  std::vector<Segment> edges_;
  Box box_;
  double row_m_ = 1.0;
  std::vector<std::vector<std::uint32_t>> rows_;  ///< edges by height, from box_.min.y up
};

}  // namespace plat::streets
