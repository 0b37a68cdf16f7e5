#include "streets/growth_contract.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "core/working_grid.h"

namespace plat::testing {
namespace {

using streets::Growth;
using streets::GrowthSite;
using streets::Street;

/// Products of differences of places.
__extension__ using Wide = __int128;

/// A place in grid steps, or in half steps where that is said.
using Place = std::array<std::int64_t, 2>;

std::optional<Place> place_of(Point p) {
  const Place out{to_grid(p.x), to_grid(p.y)};
  if (from_grid(out[0]) != p.x || from_grid(out[1]) != p.y) return std::nullopt;
  return out;
}

std::string text_of(Place p) { return fmt::format("({}, {})", from_grid(p[0]), from_grid(p[1])); }

int sign_of_turn(Place a, Place b, Place c) {
  const auto turn = static_cast<Wide>(b[0] - a[0]) * (c[1] - a[1]) -
                    static_cast<Wide>(b[1] - a[1]) * (c[0] - a[0]);
  return turn > 0 ? 1 : turn < 0 ? -1 : 0;
}

/// A straight piece of a street.
struct Piece {
  Place a;
  Place b;
  std::size_t street = 0;
  std::size_t number = 0;  ///< in the street's line

  [[nodiscard]] std::int64_t low(int axis) const { return std::min(a[axis], b[axis]); }
  [[nodiscard]] std::int64_t high(int axis) const { return std::max(a[axis], b[axis]); }
};

bool is_on(const Piece& piece, Place p) {
  for (const int axis : {0, 1})
    if (p[axis] < piece.low(axis) || p[axis] > piece.high(axis)) return false;
  return sign_of_turn(piece.a, piece.b, p) == 0;
}

bool cross_properly(Place a, Place b, Place c, Place d) {
  return sign_of_turn(a, b, c) * sign_of_turn(a, b, d) < 0 &&
         sign_of_turn(c, d, a) * sign_of_turn(c, d, b) < 0;
}

/// A street as the check sees it.
struct Line {
  std::vector<Place> places;
  bool is_grown = false;

  [[nodiscard]] bool ends_at(Place p) const { return places.front() == p || places.back() == p; }
};

/// What is wrong with two pieces' common places; every place that both hold is an end of one piece,
/// or they cross.
std::string why_not_apart(const Piece& s, const Piece& t, const std::vector<Line>& lines) {
  const auto name = [&](const Piece& piece) {
    return fmt::format("street {} at {}", piece.street, text_of(piece.a));
  };
  if (cross_properly(s.a, s.b, t.a, t.b)) return name(s) + " crosses " + name(t);
  std::set<Place> common;
  for (const Place p : {s.a, s.b})
    if (is_on(t, p)) common.insert(p);
  for (const Place p : {t.a, t.b})
    if (is_on(s, p)) common.insert(p);
  if (common.size() > 1) return name(s) + " runs along " + name(t);
  const bool are_neighbours =
      s.street == t.street && (s.number + 1 == t.number || t.number + 1 == s.number);
  if (common.empty() || are_neighbours) return {};
  const Place p = *common.begin();
  if (s.street == t.street || !lines[s.street].ends_at(p) || !lines[t.street].ends_at(p))
    return name(s) + " touches " + name(t) + " at " + text_of(p) + ", where no node of both is";
  return {};
}

/// All pairs of pieces of which one is grown, by a sweep along x.
std::string why_not_planar(const std::vector<Line>& lines) {
  std::vector<Piece> pieces;
  for (std::size_t s = 0; s < lines.size(); ++s)
    for (std::size_t i = 0; i + 1 < lines[s].places.size(); ++i)
      pieces.push_back({lines[s].places[i], lines[s].places[i + 1], s, i});
  std::ranges::sort(pieces, {}, [](const Piece& piece) { return piece.low(0); });
  std::vector<Piece> open;
  for (const Piece& piece : pieces) {
    std::erase_if(open, [&](const Piece& other) { return other.high(0) < piece.low(0); });
    for (const Piece& other : open) {
      if (!lines[piece.street].is_grown && !lines[other.street].is_grown) continue;
      if (other.high(1) < piece.low(1) || other.low(1) > piece.high(1)) continue;
      if (auto wrong = why_not_apart(other, piece, lines); !wrong.empty()) return wrong;
    }
    open.push_back(piece);
  }
  return {};
}

/// No grown street passes through one of the places.
std::string why_not_clear_of(const std::vector<Place>& places, const std::vector<Line>& lines) {
  for (std::size_t s = 0; s < lines.size(); ++s) {
    if (!lines[s].is_grown) continue;
    for (std::size_t i = 0; i + 1 < lines[s].places.size(); ++i) {
      const Piece piece{lines[s].places[i], lines[s].places[i + 1], s, i};
      for (const Place p : places)
        if (is_on(piece, p) && !lines[s].ends_at(p))
          return fmt::format("street {} passes through {}", s, text_of(p));
    }
  }
  return {};
}

/// The edges of all rings, on the grid or off it by less than half a step.
std::vector<std::pair<Place, Place>> edges_of(const Polygon& polygon) {
  std::vector<std::pair<Place, Place>> out;
  for_each_edge(polygon, [&](const Segment& edge) {
    out.push_back({{to_grid(edge.a.x), to_grid(edge.a.y)}, {to_grid(edge.b.x), to_grid(edge.b.y)}});
  });
  return out;
}

Place doubled(Place p) { return {2 * p[0], 2 * p[1]}; }

/// Where `half_steps` lies; even-odd.
Side side_of(const std::vector<std::pair<Place, Place>>& edges, Place half_steps) {
  bool is_inside = false;
  for (const auto& [from, to] : edges) {
    const Place a = doubled(from);
    const Place b = doubled(to);
    if (is_on({a, b}, half_steps)) return Side::kBoundary;
    if ((a[1] > half_steps[1]) == (b[1] > half_steps[1])) continue;
    const int turn = sign_of_turn(a, b, half_steps);
    if ((turn > 0) == (b[1] > a[1])) is_inside = !is_inside;
  }
  return is_inside ? Side::kInside : Side::kOutside;
}

/// Whether part of the piece lies on the side: it crosses an edge, or between two vertices of the
/// polygon on it its middle does.
bool has_part_on(const Piece& piece, const std::vector<std::pair<Place, Place>>& edges, Side side) {
  std::set<Place> cuts{piece.a, piece.b};
  for (const auto& [a, b] : edges) {
    if (cross_properly(piece.a, piece.b, a, b)) return true;
    if (is_on(piece, a)) cuts.insert(a);
  }
  // The order of places is that along the piece, or against it.
  for (auto cut = cuts.begin(); std::next(cut) != cuts.end(); ++cut) {
    const Place& next = *std::next(cut);
    if (side_of(edges, {(*cut)[0] + next[0], (*cut)[1] + next[1]}) == side) return true;
  }
  return side_of(edges, doubled(piece.a)) == side || side_of(edges, doubled(piece.b)) == side;
}

std::string why_not_within(const std::vector<Line>& lines, const GrowthSite& site) {
  const auto any_part = [&](const Polygon& polygon, Side side) -> std::optional<std::size_t> {
    const auto edges = edges_of(polygon);
    for (std::size_t s = 0; s < lines.size(); ++s) {
      if (!lines[s].is_grown) continue;
      for (std::size_t i = 0; i + 1 < lines[s].places.size(); ++i)
        if (has_part_on({lines[s].places[i], lines[s].places[i + 1], s, i}, edges, side)) return s;
    }
    return std::nullopt;
  };
  if (site.boundary) {
    if (const auto street = any_part(*site.boundary, Side::kOutside))
      return fmt::format("street {} leaves the boundary", *street);
  }
  for (std::size_t i = 0; i < site.obstacles.size(); ++i) {
    if (const auto street = any_part(site.obstacles[i], Side::kInside))
      return fmt::format("street {} enters obstacle {}", *street, i);
  }
  return {};
}

bool are_same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

bool are_same_but_for_nodes(const Street& a, const Street& b) {
  return a.id == b.id && a.line == b.line && a.attributes == b.attributes &&
         are_same_bits(a.width_m, b.width_m) && a.width_source == b.width_source &&
         a.source_id == b.source_id;
}

std::string why_not_a_network(const GrowthSite& site, const Growth& growth) {
  const auto& network = growth.network;
  const std::size_t existing = site.existing.streets.size();
  if (network.streets.size() < existing) return "existing streets are missing";
  if (network.streets.size() - existing != growth.segments.size())
    return fmt::format("{} grown streets, {} segments", network.streets.size() - existing,
                       growth.segments.size());
  for (std::size_t i = 0; i < existing; ++i)
    if (!are_same_but_for_nodes(network.streets[i], site.existing.streets[i]))
      return fmt::format("existing street {} is another", i);
  for (std::size_t i = 1; i < network.nodes.size(); ++i)
    if (!(network.nodes[i - 1] < network.nodes[i])) return "nodes are not sorted";
  for (const Point node : site.existing.nodes)
    if (!std::ranges::binary_search(network.nodes, node)) return "an existing node is missing";
  for (std::size_t i = 0; i < network.streets.size(); ++i) {
    const Street& street = network.streets[i];
    if (street.id.value != i) return fmt::format("street {} has id {}", i, street.id.value);
    if (street.line.size() < 2) return fmt::format("street {} has no line", i);
    if (std::max(street.from, street.to) >= network.nodes.size() ||
        network.nodes[street.from] != street.line.front() ||
        network.nodes[street.to] != street.line.back())
      return fmt::format("street {} does not run from node to node", i);
  }
  return {};
}

/// Widths and levels; segments of one street hang together and have one level.
std::string why_not_styled(const GrowthSite& site, const Growth& growth) {
  std::map<std::uint32_t, int> level_of;
  std::map<std::uint32_t, std::vector<std::set<std::uint32_t>>> parts_of;
  for (std::size_t i = 0; i < growth.segments.size(); ++i) {
    const Street& street = growth.network.streets[site.existing.streets.size() + i];
    const auto& segment = growth.segments[i];
    if (!(street.width_m > 0.0) || !std::isfinite(street.width_m) ||
        street.width_source == streets::WidthSource::kNone)
      return fmt::format("grown street {} has no width", i);
    if (segment.hierarchy < 0) return fmt::format("grown street {} has no level", i);
    if (level_of.try_emplace(segment.street, segment.hierarchy).first->second != segment.hierarchy)
      return fmt::format("street number {} has two levels", segment.street);
    std::set<std::uint32_t> joined{street.from, street.to};
    auto& parts = parts_of[segment.street];
    std::erase_if(parts, [&](const std::set<std::uint32_t>& part) {
      if (!part.contains(street.from) && !part.contains(street.to)) return false;
      joined.insert(part.begin(), part.end());
      return true;
    });
    parts.push_back(std::move(joined));
  }
  for (const auto& [number, parts] : parts_of)
    if (parts.size() > 1) return fmt::format("street number {} is in two parts", number);
  return {};
}

std::string why_not_reached(const GrowthSite& site, const Growth& growth,
                            const std::vector<Place>& points, const std::vector<Line>& lines,
                            NewNodes new_nodes) {
  std::set<Place> ends;
  for (const Line& line : lines)
    if (line.is_grown) ends.insert({line.places.front(), line.places.back()});
  std::vector<std::uint32_t> left_alone;
  for (std::uint32_t i = 0; i < points.size(); ++i)
    if (!ends.contains(points[i])) left_alone.push_back(i);
  if (left_alone != growth.left_alone)
    return fmt::format("{} points are left alone, it says {}", left_alone.size(),
                       growth.left_alone.size());
  if (new_nodes == NewNodes::kAllowed) return {};
  std::set<Place> known(points.begin(), points.end());
  for (const Point node : site.existing.nodes) known.insert(*place_of(node));
  for (const Place end : ends)
    if (!known.contains(end)) return "a street ends at " + text_of(end) + ", where no point is";
  return {};
}

}  // namespace

std::string why_not_grown(const GrowthSite& site, const Growth& growth, NewNodes new_nodes) {
  if (auto wrong = why_not_a_network(site, growth); !wrong.empty()) return wrong;
  std::vector<Line> lines;
  for (const Street& street : growth.network.streets) {
    Line line{{}, lines.size() >= site.existing.streets.size()};
    for (const Point p : street.line) {
      const auto place = place_of(p);
      if (!place) return fmt::format("street {} is off the grid", lines.size());
      if (line.is_grown && !line.places.empty() && line.places.back() == *place)
        return fmt::format("street {} has a piece of zero length", lines.size());
      line.places.push_back(*place);
    }
    lines.push_back(std::move(line));
  }
  std::vector<Place> points;
  for (const auto& point : site.points) points.push_back(*place_of(point.place));
  std::vector<Place> stops = points;
  for (const Point node : growth.network.nodes) stops.push_back(*place_of(node));

  if (auto wrong = why_not_planar(lines); !wrong.empty()) return wrong;
  if (auto wrong = why_not_clear_of(stops, lines); !wrong.empty()) return wrong;
  if (auto wrong = why_not_within(lines, site); !wrong.empty()) return wrong;
  if (auto wrong = why_not_styled(site, growth); !wrong.empty()) return wrong;
  return why_not_reached(site, growth, points, lines, new_nodes);
}

bool are_same(const Growth& a, const Growth& b) {
  const auto is_same_street = [](const Street& s, const Street& t) {
    return s.from == t.from && s.to == t.to && are_same_but_for_nodes(s, t);
  };
  const auto is_same_segment = [](const auto& s, const auto& t) {
    return s.hierarchy == t.hierarchy && s.street == t.street;
  };
  return a.network.nodes == b.network.nodes && a.left_alone == b.left_alone &&
         std::ranges::equal(a.network.streets, b.network.streets, is_same_street) &&
         std::ranges::equal(a.segments, b.segments, is_same_segment);
}

}  // namespace plat::testing
