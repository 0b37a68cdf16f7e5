#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "core/failure.h"
#include "core/polygon.h"

namespace plat::similarity {

/// An outline by length along it. Places are relative to its first vertex, so that digits are not
/// lost far from the origin.
class OutlineWalk {
 public:
  /// Pre: at least three vertices.
  explicit OutlineWalk(std::span<const Point> ring) {
    expects(ring.size() >= 3, "an outline has three vertices");
    origin_ = ring.front();
    for (std::size_t i = 0; i < ring.size(); ++i) {
      places_.push_back(ring[i] - origin_);
      starts_m_.push_back(length_m_);
      length_m_ += plat::distance(ring[i], ring[(i + 1) % ring.size()]);
    }
  }

  [[nodiscard]] Point origin() const { return origin_; }
  [[nodiscard]] const Ring& places() const { return places_; }
  [[nodiscard]] double length_m() const { return length_m_; }
  /// How far behind the first vertex this one lies.
  [[nodiscard]] double start_m(std::size_t vertex) const { return starts_m_[vertex]; }

  /// The place `along_m` behind the first vertex; any number of times round. O(log n).
  [[nodiscard]] Point at(double along_m) const {
    while (along_m >= length_m_) along_m -= length_m_;
    const auto next = std::ranges::upper_bound(starts_m_, along_m);
    const auto edge = static_cast<std::size_t>(next - starts_m_.begin()) - 1;
    const Segment s{places_[edge], places_[(edge + 1) % places_.size()]};
    const double size = length(s);
    return size > 0.0 ? lerp(s.a, s.b, std::min(1.0, (along_m - starts_m_[edge]) / size)) : s.a;
  }

 private:
  Point origin_;
  Ring places_;
  std::vector<double> starts_m_;
  double length_m_ = 0.0;
};

}  // namespace plat::similarity
