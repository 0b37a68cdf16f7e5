#include "parcels/lot.h"

#include <algorithm>
#include <cmath>

#include "core/working_grid.h"

namespace plat::parcels {
namespace {

Ring positions(const std::vector<LotVertex>& ring) {
  Ring out;
  out.reserve(ring.size());
  for (const LotVertex& v : ring) out.push_back(v.position);
  return out;
}

/// Where a ring crosses the split line, on the edge from `vertex` to the next one.
struct Crossing {
  double along = 0.0;
  Point position;
  std::uint32_t ring = 0;
  std::uint32_t vertex = 0;
  bool goes_left = false;
};

/// Drops vertices that coincide with the next one; empties rings without area.
void tidy(std::vector<LotVertex>& ring) {
  std::vector<LotVertex> kept;
  kept.reserve(ring.size());
  for (std::size_t i = 0; i < ring.size(); ++i) {
    if (ring[i].position == ring[i + 1 == ring.size() ? 0 : i + 1].position) continue;
    kept.push_back(ring[i]);
  }
  ring = std::move(kept);
  if (ring.size() < 3) ring.clear();
}

class Splitter {
 public:
  Splitter(const Lot& lot, const SplitLine& line)
      : lot_(lot), line_(line), normal_(perpendicular(line.direction)) {
    find_crossings();
  }

  SplitResult run() {
    SplitResult out;
    if (crossings_.size() < 2 || crossings_.size() % 2 != 0 || !are_pairs_consistent()) {
      out.lots.push_back(lot_);
      return out;
    }
    for (std::size_t k = 0; k < crossings_.size(); k += 2) {
      if (crossings_[k].position != crossings_[k + 1].position) {
        out.cuts.push_back({crossings_[k].position, crossings_[k + 1].position});
      }
    }
    for (const bool left : {true, false}) trace_side(left, out.lots);
    assign_uncrossed_holes(out.lots);
    if (out.lots.size() < 2) out.cuts.clear();
    return out;
  }

 private:
  [[nodiscard]] double height(Point p) const { return dot(p - line_.pivot, normal_); }

  void find_crossings() {
    for (std::uint32_t r = 0; r < lot_.rings.size(); ++r) {
      const auto& ring = lot_.rings[r];
      std::vector<std::uint32_t>& of_ring = by_ring_.emplace_back();
      double from = height(ring.front().position);
      for (std::uint32_t i = 0; i < ring.size(); ++i) {
        const Point next = ring[i + 1 == ring.size() ? 0 : i + 1].position;
        const double to = height(next);
        if ((from >= 0.0) != (to >= 0.0)) {
          const Point at = lerp(ring[i].position, next, from / (from - to));
          of_ring.push_back(static_cast<std::uint32_t>(crossings_.size()));
          crossings_.push_back({dot(at - line_.pivot, line_.direction), snap(at), r, i, to >= 0.0});
        }
        from = to;
      }
    }
    // Sort along the line, keeping track of where each ring's crossings went.
    std::vector<std::uint32_t> order(crossings_.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      return std::pair(crossings_[a].along, a) < std::pair(crossings_[b].along, b);
    });
    std::vector<std::uint32_t> place(order.size());
    std::vector<Crossing> sorted;
    for (const std::uint32_t i : order) {
      place[i] = static_cast<std::uint32_t>(sorted.size());
      sorted.push_back(crossings_[i]);
    }
    crossings_ = std::move(sorted);
    for (auto& ring : by_ring_) {
      for (std::uint32_t& c : ring) c = place[c];
    }
  }

  /// Crossings 2k and 2k + 1 bound a part of the line inside the lot: one goes left, the other
  /// right.
  [[nodiscard]] bool are_pairs_consistent() const {
    for (std::size_t k = 0; k < crossings_.size(); k += 2) {
      if (crossings_[k].goes_left == crossings_[k + 1].goes_left) return false;
    }
    return true;
  }

  void trace_side(bool left, std::vector<Lot>& lots) const {
    std::vector<bool> is_done(crossings_.size(), false);
    for (std::uint32_t start = 0; start < crossings_.size(); ++start) {
      if (is_done[start] || crossings_[start].goes_left != left) continue;
      std::vector<LotVertex> ring;
      for (std::uint32_t c = start; !is_done[c];) {
        is_done[c] = true;
        const Crossing& enter = crossings_[c];
        const auto& source = lot_.rings[enter.ring];
        ring.push_back({enter.position, source[enter.vertex].is_street, false});
        // Along the ring to its next crossing, then back along the line to that one's partner.
        const auto& of_ring = by_ring_[enter.ring];
        const auto here = std::find(of_ring.begin(), of_ring.end(), c);
        const std::uint32_t leave = here + 1 == of_ring.end() ? of_ring.front() : *(here + 1);
        const auto n = static_cast<std::uint32_t>(source.size());
        for (std::uint32_t i = (enter.vertex + 1) % n; i != (crossings_[leave].vertex + 1) % n;
             i = (i + 1) % n) {
          ring.push_back(source[i]);
        }
        ring.push_back({crossings_[leave].position, false, false});
        c = leave ^ 1U;
      }
      tidy(ring);
      if (ring.empty() || signed_area_m2(positions(ring)) <= 0.0) continue;
      lots.push_back({{std::move(ring)}});
    }
  }

  void assign_uncrossed_holes(std::vector<Lot>& lots) const {
    for (std::size_t r = 1; r < lot_.rings.size(); ++r) {
      if (!by_ring_[r].empty()) continue;
      for (Lot& lot : lots) {
        if (locate(positions(lot.rings.front()), lot_.rings[r].front().position) != Side::kInside)
          continue;
        lot.rings.push_back(lot_.rings[r]);
        break;
      }
    }
  }

  const Lot& lot_;
  SplitLine line_;
  Point normal_;
  std::vector<Crossing> crossings_;                  ///< along the line
  std::vector<std::vector<std::uint32_t>> by_ring_;  ///< indices into crossings_, along each ring
};

}  // namespace

Lot lot_of(const blocks::Block& block) {
  Lot lot;
  for (std::size_t r = 0; r < block.edges.size(); ++r) {
    const Ring& ring = blocks::ring_at(block, r);
    auto& out = lot.rings.emplace_back();
    for (std::size_t i = 0; i < ring.size(); ++i)
      out.push_back({ring[i], block.edges[r][i].is_street(), true});
  }
  return lot;
}

Polygon polygon_of(const Lot& lot) {
  Polygon polygon;
  polygon.outer = positions(lot.rings.front());
  for (std::size_t r = 1; r < lot.rings.size(); ++r)
    polygon.holes.push_back(positions(lot.rings[r]));
  return polygon;
}

double area_m2(const Lot& lot) { return plat::area_m2(polygon_of(lot)); }

double frontage_m(const Lot& lot) {
  double sum = 0.0;
  for (const auto& ring : lot.rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      if (ring[i].is_street)
        sum += distance(ring[i].position, ring[i + 1 == ring.size() ? 0 : i + 1].position);
    }
  }
  return sum;
}

OrientedBox minimum_area_box(const Lot& lot) {
  return plat::minimum_area_box(std::span<const Point>(positions(lot.rings.front())));
}

double front_width_m(const Lot& lot, const OrientedBox& box) {
  Point front;
  for (const auto& ring : lot.rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Point edge = ring[i + 1 == ring.size() ? 0 : i + 1].position - ring[i].position;
      if (ring[i].is_street && squared_length(edge) > squared_length(front)) front = edge;
    }
  }
  if (front == Point{}) return box.width_m;
  return std::abs(dot(front, box.axis)) >= std::abs(cross(front, box.axis)) ? box.length_m
                                                                            : box.width_m;
}

SplitResult split(const Lot& lot, const SplitLine& line) { return Splitter(lot, line).run(); }

}  // namespace plat::parcels
