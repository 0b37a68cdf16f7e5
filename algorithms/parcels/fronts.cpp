#include "parcels/fronts.h"

#include <algorithm>
#include <cmath>

#include "core/failure.h"

namespace plat::parcels {
namespace {

class RingFronts {
 public:
  RingFronts(const Ring& ring, const std::vector<blocks::BlockEdge>& edges)
      : ring_(ring), edges_(edges), size_(ring.size()) {}

  void append_to(std::vector<Front>& out) const {
    const std::size_t first = first_break();
    if (first == size_) {
      if (edges_[0].is_street()) out.push_back({closed_line(), true});
      return;
    }
    for (std::size_t k = 0; k < size_; ++k) {
      const std::size_t i = (first + k) % size_;
      if (!edges_[i].is_street()) continue;
      if (begins_front(i)) out.push_back({{ring_[i]}, false});
      out.back().line.push_back(ring_[(i + 1) % size_]);
    }
  }

 private:
  /// Whether edge i does not go on the front of the edge before it.
  [[nodiscard]] bool begins_front(std::size_t i) const {
    const std::size_t before = (i + size_ - 1) % size_;
    if (edges_[i].is_street() != edges_[before].is_street()) return true;
    return std::abs(turn_rad(ring_, i)) > kFrontCorner_rad;
  }

  [[nodiscard]] std::size_t first_break() const {
    std::size_t i = 0;
    while (i < size_ && !begins_front(i)) ++i;
    return i;
  }

  [[nodiscard]] Polyline closed_line() const {
    Polyline line(ring_.begin(), ring_.end());
    line.push_back(ring_.front());
    return line;
  }

  const Ring& ring_;
  const std::vector<blocks::BlockEdge>& edges_;
  std::size_t size_;
};

}  // namespace

std::vector<Front> fronts_of(const blocks::Block& given) {
  const blocks::Block block = blocks::with_streets_assumed(given);
  std::vector<Front> out;
  for (std::size_t r = 0; r < block.edges.size(); ++r) {
    RingFronts(blocks::ring_at(block, r), block.edges[r]).append_to(out);
  }
  return out;
}

double length_m(const Front& front) { return plat::length_m(front.line); }

FrontPlace place_at(const Front& front, double s_m) {
  const Polyline& line = front.line;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const double size = distance(line[i], line[i + 1]);
    if (s_m < size || i + 2 == line.size()) {
      const double t = std::clamp(s_m / size, 0.0, 1.0);
      return {lerp(line[i], line[i + 1], t), perpendicular(normalized(line[i + 1] - line[i]))};
    }
    s_m -= size;
  }
  throw LogicError("a front has an edge");
}

}  // namespace plat::parcels
