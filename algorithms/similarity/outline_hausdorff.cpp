#include "similarity/outline_hausdorff.h"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/failure.h"

namespace plat::similarity {
namespace {

Segment edge_of(std::span<const Point> ring, std::size_t i) {
  return {ring[i], ring[i + 1 == ring.size() ? 0 : i + 1]};
}

/// An edge of the other ring, and how far it is from both ends of a piece of this one.
struct Near {
  std::uint32_t edge = 0;
  double from_a_m = 0.0;
  double from_b_m = 0.0;
};

// How far a point of a piece is from an edge is convex along the piece: nowhere more than at the
// farther end. So the least such maximum over all edges bounds the distance of the whole piece,
// and is the distance itself where one edge is the nearest throughout; pieces that could hold a
// farther point than the farthest so far are halved.
class FarthestPoint {
 public:
  FarthestPoint(std::span<const Point> ring, std::span<const Point> other, double at_least_m,
                double give_up_m)
      : other_(other), farthest_m_(at_least_m), give_up_m_(give_up_m) {
    const std::size_t m = other.size();
    std::vector<double> before = distances(ring.back());
    for (std::size_t i = 0; i < ring.size() && farthest_m_ < give_up_m_; ++i) {
      std::vector<double> here = distances(ring[i]);
      std::vector<Near> all(m);
      for (std::size_t k = 0; k < m; ++k)
        all[k] = {static_cast<std::uint32_t>(k), before[k], here[k]};
      look_at({ring[(i + ring.size() - 1) % ring.size()], ring[i]}, all);
      before = std::move(here);
    }
  }

  [[nodiscard]] double farthest_m() const { return farthest_m_; }

 private:
  [[nodiscard]] std::vector<double> distances(Point p) const {
    std::vector<double> out(other_.size());
    for (std::size_t k = 0; k < out.size(); ++k) out[k] = distance(edge_of(other_, k), p);
    return out;
  }

  void look_at(const Segment& piece, std::span<const Near> edges) {
    double from_a = std::numeric_limits<double>::infinity();
    double from_b = from_a;
    double bound = from_a;
    for (const Near& near : edges) {
      from_a = std::min(from_a, near.from_a_m);
      from_b = std::min(from_b, near.from_b_m);
      bound = std::min(bound, std::max(near.from_a_m, near.from_b_m));
    }
    farthest_m_ = std::max({farthest_m_, from_a, from_b});
    if (bound <= farthest_m_ + kHausdorffResolution_m || farthest_m_ >= give_up_m_) return;
    const double size = length(piece);
    const Point middle = midpoint(piece.a, piece.b);
    if (middle == piece.a || middle == piece.b) return;
    std::vector<Near> first;
    std::vector<Near> second;
    for (const Near& near : edges) {
      // Along the piece, a distance changes by no more than the way.
      if (0.5 * (near.from_a_m + near.from_b_m - size) > bound) continue;
      const double from_middle = distance(edge_of(other_, near.edge), middle);
      first.push_back({near.edge, near.from_a_m, from_middle});
      second.push_back({near.edge, from_middle, near.from_b_m});
    }
    look_at({piece.a, middle}, first);
    look_at({middle, piece.b}, second);
  }

  std::span<const Point> other_;
  double farthest_m_;
  double give_up_m_;
};

}  // namespace

double outline_hausdorff_m(std::span<const Point> a, std::span<const Point> b, double give_up_m) {
  expects(a.size() >= 3 && b.size() >= 3, "outlines have three vertices");
  const double there_m = FarthestPoint(a, b, 0.0, give_up_m).farthest_m();
  return FarthestPoint(b, a, there_m, give_up_m).farthest_m();
}

}  // namespace plat::similarity
