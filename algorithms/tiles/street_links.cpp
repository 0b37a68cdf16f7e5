#include "tiles/street_links.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <utility>

#include "core/working_grid.h"
#include "tiles/cell_index_internal.h"

namespace plat::tiles {
namespace {

/// About the width of a street: what the indices of fronts and of lines are divided by.
constexpr double kCell_m = 20.0;
/// Fronts go round a corner where the ring turns by more than this.
constexpr double kCorner_rad = std::numbers::pi / 6.0;
/// Links begin this far from the ends of a front, so that they see past the corners of crossings.
constexpr double kInset_m = 1.0;
/// A way that meets the other side more slantwise than this does not cross the street.
constexpr double kSlantMax_rad = std::numbers::pi / 3.0;
/// Two links of the same tiles as near as this are one seen from both sides.
constexpr double kTwin_m = 4.0;

/// An edge of a tile that no other tile has.
struct FreeEdge {
  std::uint32_t tile = 0;
  Segment segment;
};

/// Consecutive free edges of a tile that run about straight on.
using Front = std::vector<std::uint32_t>;  // of free edges

Box box_of(const Segment& s) {
  Box box;
  box.add(s.a);
  box.add(s.b);
  return box;
}

/// Where the segment from `from` to `to` crosses `wall`, as a parameter of the former.
std::optional<double> crossing_at(Point from, Point to, const Segment& wall) {
  const Point way = to - from;
  const Point along = wall.b - wall.a;
  const double denominator = cross(way, along);
  if (denominator == 0.0) return std::nullopt;
  const double t = cross(wall.a - from, along) / denominator;
  const double u = cross(wall.a - from, way) / denominator;
  if (t < 0.0 || t > 1.0 || u < 0.0 || u > 1.0) return std::nullopt;
  return t;
}

class LinkSearch {
 public:
  LinkSearch(const TileLayout& layout, std::span<const StreetLine> streets,
             const LinkOptions& options)
      : layout_(layout), options_(options), walls_({}, kCell_m), lines_({}, kCell_m) {
    collect_fronts();
    std::vector<Box> boxes;
    for (const FreeEdge& edge : edges_) boxes.push_back(box_of(edge.segment));
    walls_ = CellIndex(std::move(boxes), kCell_m);
    boxes.clear();
    for (const StreetLine& street : streets) {
      for (std::size_t i = 0; i + 1 < street.line.size(); ++i) {
        line_segments_.push_back({street.line[i], street.line[i + 1]});
        boxes.push_back(box_of(line_segments_.back()));
      }
    }
    lines_ = CellIndex(std::move(boxes), kCell_m);
  }

  std::vector<StreetLink> run() {
    for (const Front& front : fronts_) look_across(front);
    std::ranges::sort(links_, [](const StreetLink& s, const StreetLink& t) {
      return std::tie(s.a, s.b, s.rest_a, s.width_m) < std::tie(t.a, t.b, t.rest_a, t.width_m);
    });
    return without_twins();
  }

 private:
  void collect_fronts() {
    std::set<std::pair<std::uint32_t, std::uint32_t>> directed;
    const auto for_each_corner = [&](const auto& visit) {
      for (std::uint32_t t = 0; t < layout_.tiles.size(); ++t) {
        for (const auto& ring : layout_.tiles[t].rings) {
          for (std::size_t i = 0; i < ring.size(); ++i)
            visit(t, ring, i, ring[i].vertex, ring[(i + 1) % ring.size()].vertex);
        }
      }
    };
    for_each_corner([&](std::uint32_t, const auto&, std::size_t, std::uint32_t a, std::uint32_t b) {
      directed.emplace(a, b);
    });
    bool is_open = false;  // the last front may go on
    for_each_corner(
        [&](std::uint32_t t, const auto&, std::size_t i, std::uint32_t a, std::uint32_t b) {
          if (i == 0) is_open = false;
          if (directed.contains({b, a})) {
            is_open = false;
            return;
          }
          const FreeEdge edge{t, {layout_.vertices[a].at, layout_.vertices[b].at}};
          if (!is_open || turns(edges_.back().segment, edge.segment)) fronts_.emplace_back();
          fronts_.back().push_back(static_cast<std::uint32_t>(edges_.size()));
          edges_.push_back(edge);
          is_open = true;
        });
    for (std::uint32_t t = 0; t < layout_.tiles.size(); ++t) {
      auto& own = vertices_of_.emplace_back();
      for (const auto& ring : layout_.tiles[t].rings) {
        for (const Corner& corner : ring) own.push_back(corner.vertex);
      }
      std::ranges::sort(own);
    }
  }

  static bool turns(const Segment& s, const Segment& t) {
    const Point along = s.b - s.a;
    const Point next = t.b - t.a;
    return std::abs(std::atan2(cross(along, next), dot(along, next))) > kCorner_rad;
  }

  void look_across(const Front& front) {
    double length_m = 0.0;
    for (const std::uint32_t e : front) length_m += length(edges_[e].segment);
    if (length_m < options_.front_m) return;
    constexpr double kInsetShare = 0.25;  // of a short front
    const double inset = std::min(kInset_m, kInsetShare * length_m);
    const double inner = length_m - 2.0 * inset;
    const auto steps = static_cast<int>(std::max(1.0, std::ceil(inner / options_.spacing_m)));
    for (int k = 0; k <= steps; ++k) look_across(front, inset + inner * k / steps);
  }

  void look_across(const Front& front, double along_m) {
    for (const std::uint32_t e : front) {
      const Segment& s = edges_[e].segment;
      const double edge_m = length(s);
      if (along_m > edge_m && e != front.back()) {
        along_m -= edge_m;
        continue;
      }
      const Point from = lerp(s.a, s.b, std::min(1.0, along_m / edge_m));
      // Tiles lie to the left of their edges.
      look_across(e, from, from - options_.reach_m * normalized(perpendicular(s.b - s.a)));
      return;
    }
  }

  void look_across(std::uint32_t edge, Point from, Point to) {
    double first = 2.0;
    std::uint32_t wall = edge;
    for (const std::uint32_t e : walls_.near(box_of(Segment{from, to}))) {
      if (e == edge) continue;
      const auto t = crossing_at(from, to, edges_[e].segment);
      if (t && *t < first) {
        first = *t;
        wall = e;
      }
    }
    const std::uint32_t a = edges_[edge].tile;
    const std::uint32_t b = edges_[wall].tile;
    if (a == b || share_vertices(a, b)) return;
    const Point way = to - from;
    const Segment& met = edges_[wall].segment;
    // Met from outside, and not too slantwise.
    const double inward = dot(normalized(way), normalized(perpendicular(met.b - met.a)));
    if (inward < std::cos(kSlantMax_rad)) return;
    const Point foot = from + first * way;
    const Point middle = centre_between(from, foot);
    StreetLink link{a, middle, b, middle, distance(from, foot)};
    if (link.b < link.a) std::swap(link.a, link.b);
    links_.push_back(link);
  }

  /// Where the centre line nearest to the middle crosses the way; the middle where none does.
  [[nodiscard]] Point centre_between(Point from, Point to) const {
    double best = 0.5;
    double off = 1.0;
    for (const std::uint32_t l : lines_.near(box_of(Segment{from, to}))) {
      const auto t = crossing_at(from, to, line_segments_[l]);
      if (t && std::abs(*t - 0.5) < off) {
        off = std::abs(*t - 0.5);
        best = *t;
      }
    }
    return snap(lerp(from, to, best));
  }

  [[nodiscard]] bool share_vertices(std::uint32_t a, std::uint32_t b) const {
    return std::ranges::any_of(vertices_of_[a], [&](std::uint32_t v) {
      return std::ranges::binary_search(vertices_of_[b], v);
    });
  }

  [[nodiscard]] std::vector<StreetLink> without_twins() const {
    std::vector<StreetLink> out;
    std::size_t first_of_pair = 0;
    for (const StreetLink& link : links_) {
      if (out.empty() || out.back().a != link.a || out.back().b != link.b)
        first_of_pair = out.size();
      const bool is_twin = std::any_of(
          out.begin() + static_cast<std::ptrdiff_t>(first_of_pair), out.end(),
          [&](const StreetLink& other) { return distance(other.rest_a, link.rest_a) < kTwin_m; });
      if (!is_twin) out.push_back(link);
    }
    return out;
  }

  const TileLayout& layout_;
  const LinkOptions& options_;
  std::vector<FreeEdge> edges_;
  std::vector<Front> fronts_;
  std::vector<std::vector<std::uint32_t>> vertices_of_;  ///< per tile, ascending
  std::vector<Segment> line_segments_;
  CellIndex walls_;
  CellIndex lines_;
  std::vector<StreetLink> links_;
};

}  // namespace

std::vector<StreetLink> find_street_links(const TileLayout& layout,
                                          std::span<const StreetLine> streets,
                                          const LinkOptions& options) {
  return LinkSearch(layout, streets, options).run();
}

}  // namespace plat::tiles
