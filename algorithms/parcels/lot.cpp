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

/// The loops of a ring that visits places twice, as where the line went through a corner of a hole;
/// the ring itself where it does not.
std::vector<std::vector<LotVertex>> loops_of(std::vector<LotVertex> ring) {
  Ring sorted = positions(ring);
  std::sort(sorted.begin(), sorted.end());
  if (std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end()) return {std::move(ring)};
  std::vector<std::vector<LotVertex>> loops;
  std::vector<LotVertex> open;
  for (const LotVertex& v : ring) {
    const auto same = std::find_if(open.begin(), open.end(), [&](const LotVertex& earlier) {
      return earlier.position == v.position;
    });
    if (same != open.end()) {
      loops.emplace_back(same, open.end());
      open.erase(same, open.end());
    }
    open.push_back(v);
  }
  loops.push_back(std::move(open));
  return loops;
}

bool is_inside(const std::vector<LotVertex>& ring, const std::vector<LotVertex>& container) {
  const Ring outer = positions(container);
  return std::any_of(ring.begin(), ring.end(), [&](const LotVertex& v) {
    return locate(std::span<const Point>(outer), v.position) == Side::kInside;
  });
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

  [[nodiscard]] std::vector<double> heights_of(const std::vector<LotVertex>& ring) const {
    std::vector<double> heights;
    heights.reserve(ring.size());
    for (const LotVertex& v : ring) heights.push_back(height(v.position));
    return heights;
  }

  /// A vertex on the line counts as left of it, but for one that touches the line from the left: so
  /// a touch from either side is two crossings, and land that meets in a point is seen to.
  [[nodiscard]] static std::vector<bool> sides_of(const std::vector<double>& heights) {
    const std::size_t n = heights.size();
    std::vector<bool> is_left(n);
    for (std::size_t i = 0; i < n; ++i) {
      const double before = heights[i == 0 ? n - 1 : i - 1];
      const double after = heights[i + 1 == n ? 0 : i + 1];
      is_left[i] = heights[i] > 0.0 || (heights[i] == 0.0 && (before <= 0.0 || after <= 0.0));
    }
    return is_left;
  }

  void find_crossings() {
    for (std::uint32_t r = 0; r < lot_.rings.size(); ++r) {
      const auto& ring = lot_.rings[r];
      std::vector<std::uint32_t>& of_ring = by_ring_.emplace_back();
      const std::vector<double> heights = heights_of(ring);
      const std::vector<bool> is_left = sides_of(heights);
      for (std::uint32_t i = 0; i < ring.size(); ++i) {
        const std::uint32_t next = i + 1 == ring.size() ? 0 : i + 1;
        if (is_left[i] == is_left[next]) continue;
        const Point at =
            lerp(ring[i].position, ring[next].position, heights[i] / (heights[i] - heights[next]));
        of_ring.push_back(static_cast<std::uint32_t>(crossings_.size()));
        crossings_.push_back(
            {dot(at - line_.pivot, line_.direction), snap(at), r, i, is_left[next]});
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
    alternate(place);
    for (auto& ring : by_ring_) {
      for (std::uint32_t& c : ring) c = place[c];
    }
  }

  /// Where the line goes through a vertex, two crossings coincide but for rounding: along the line,
  /// the region is entered (an edge goes right) and left (an edge goes left) in turn.
  void alternate(std::vector<std::uint32_t>& place) {
    std::vector<std::uint32_t> at(place.size());
    for (std::uint32_t i = 0; i < place.size(); ++i) at[place[i]] = i;
    for (std::size_t i = 0; i + 1 < crossings_.size(); ++i) {
      const bool must_go_left = i % 2 == 1;
      for (std::size_t k = i; k < crossings_.size(); ++k) {
        if (crossings_[k].along - crossings_[i].along > kGridStep_m) break;
        if (crossings_[k].goes_left != must_go_left) continue;
        std::swap(crossings_[i], crossings_[k]);
        std::swap(at[i], at[k]);
        break;
      }
    }
    for (std::uint32_t c = 0; c < at.size(); ++c) place[at[c]] = c;
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
      add_lots(loops_of(std::move(ring)), lots);
    }
  }

  /// Counter-clockwise loops are lots of their own: land that only meets in a point is not one lot.
  /// Clockwise ones are holes that touch the outer ring.
  static void add_lots(std::vector<std::vector<LotVertex>> loops, std::vector<Lot>& lots) {
    const std::size_t first = lots.size();
    std::vector<std::vector<LotVertex>> holes;
    for (auto& loop : loops) {
      const double area = signed_area_m2(positions(loop));
      if (area > 0.0) lots.push_back({{std::move(loop)}});
      if (area < 0.0) holes.push_back(std::move(loop));
    }
    for (auto& hole : holes) {
      for (std::size_t i = first; i < lots.size(); ++i) {
        if (!is_inside(hole, lots[i].rings.front())) continue;
        lots[i].rings.push_back(std::move(hole));
        break;
      }
    }
  }

  void assign_uncrossed_holes(std::vector<Lot>& lots) const {
    for (std::size_t r = 1; r < lot_.rings.size(); ++r) {
      if (!by_ring_[r].empty()) continue;
      for (Lot& lot : lots) {
        if (!is_inside(lot_.rings[r], lot.rings.front())) continue;
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
