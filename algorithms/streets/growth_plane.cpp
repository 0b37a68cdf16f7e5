#include "streets/growth_plane.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_set>
#include <utility>

#include "core/exact_orientation.h"
#include "core/validity.h"
#include "streets/growth_cells.h"
#include "streets/growth_region.h"
#include "streets/growth_site.h"

namespace plat::streets {
namespace {

/// Cells where the points say nothing about the length of streets.
constexpr double kFallbackCell_m = 100.0;
/// A cell is no smaller than this share of the plane, walls included, so that one long segment
/// meets a bounded number of them; nor than this, so that their numbers are small wherever the
/// plane lies.
constexpr double kSmallestCellShare = 0x1p-14;
constexpr double kSmallestCell_m = 0.5;
/// Noding (core/planar_graph.h) bends a segment through a node that is nearer than half the
/// diagonal of a grid cell; this is a little more.
constexpr double kNodingReach_m = 0.75 * kGridStep_m;

struct Item {
  enum class Kind : std::uint8_t { kExisting, kGrown, kVertex, kWall };
  Segment segment;
  Kind kind = Kind::kVertex;
  bool is_vertex_a = false;  ///< whether the segment's end is a vertex of the plane
  bool is_vertex_b = false;
  bool is_gone = false;
  bool is_crossed = false;
  std::uint32_t region = 0;  ///< of a wall
};

struct Barrier {
  GrowthRegion region;
  Side barred = Side::kInside;
};

/// A segment that asks to be admitted.
struct Candidate {
  Segment segment;
  bool is_vertex_a = true;
  bool is_vertex_b = true;
};

/// Whether a node at `p`, no end of the segment, would move it.
bool is_bent_by(const Segment& s, Point p) { return distance(s, p) < kNodingReach_m; }

/// Whether two segments without a common end meet, or would once they are noded.
bool meet_when_noded(const Segment& s, const Segment& t) {
  return cross_properly(s, t) || is_bent_by(s, t.a) || is_bent_by(s, t.b) || is_bent_by(t, s.a) ||
         is_bent_by(t, s.b);
}

/// Whether two segments from `end` run along each other, or would once they are noded.
bool overlap_when_noded(Point end, Point one, Point other) {
  return is_bent_by({end, one}, other) || is_bent_by({end, other}, one);
}

bool are_boxes_apart(const Segment& s, const Segment& t) {
  const auto is_below = [](double a, double b, double c, double d) {
    return std::max(a, b) + kNodingReach_m < std::min(c, d);
  };
  return is_below(s.a.x, s.b.x, t.a.x, t.b.x) || is_below(t.a.x, t.b.x, s.a.x, s.b.x) ||
         is_below(s.a.y, s.b.y, t.a.y, t.b.y) || is_below(t.a.y, t.b.y, s.a.y, s.b.y);
}

/// How a street's segment is met.
enum class Meeting { kApart, kCommonVertex, kCrossing, kTouching };

Meeting meeting(const Candidate& c, const Item& item) {
  const Segment& s = c.segment;
  const Segment& t = item.segment;
  if ((s.a == t.a && s.b == t.b) || (s.a == t.b && s.b == t.a)) return Meeting::kTouching;
  const auto at_common_end = [](Point end, Point mine, Point other, bool are_vertices) {
    return !are_vertices || overlap_when_noded(end, mine, other) ? Meeting::kTouching
                                                                 : Meeting::kCommonVertex;
  };
  if (s.a == t.a) return at_common_end(s.a, s.b, t.b, c.is_vertex_a && item.is_vertex_a);
  if (s.a == t.b) return at_common_end(s.a, s.b, t.a, c.is_vertex_a && item.is_vertex_b);
  if (s.b == t.a) return at_common_end(s.b, s.a, t.b, c.is_vertex_b && item.is_vertex_a);
  if (s.b == t.b) return at_common_end(s.b, s.a, t.a, c.is_vertex_b && item.is_vertex_b);
  if (are_boxes_apart(s, t)) return Meeting::kApart;
  if (cross_properly(s, t)) return Meeting::kCrossing;
  return meet_when_noded(s, t) ? Meeting::kTouching : Meeting::kApart;
}

/// Whether the candidate passes through the vertex, or bends at it.
bool passes_through(const Candidate& c, Point vertex) {
  if (vertex == c.segment.a) return !c.is_vertex_a;
  if (vertex == c.segment.b) return !c.is_vertex_b;
  return is_bent_by(c.segment, vertex);
}

Point crossing_place(const Segment& s, const Segment& t) {
  const Point d = s.b - s.a;
  const Point e = t.b - t.a;
  return snap(s.a + (cross(t.a - s.a, e) / cross(d, e)) * d);
}

std::uint64_t pair_key(std::uint32_t u, std::uint32_t v) {
  return (static_cast<std::uint64_t>(std::min(u, v)) << 32U) | std::max(u, v);
}

double cell_size_m(const GrowthSite& site, const Box& box) {
  std::vector<double> lengths;
  for (const IntersectionPoint& point : site.points) {
    for (const PassingStreet& street : streets_of(point)) {
      if (street.distance_mean_m > 0.0) lengths.push_back(street.distance_mean_m);
    }
  }
  double cell = kFallbackCell_m;
  if (!lengths.empty()) {
    const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
    std::nth_element(lengths.begin(), middle, lengths.end());
    cell = *middle;
  }
  return std::max(
      {cell, kSmallestCell_m, kSmallestCellShare * std::max(box.width(), box.height())});
}

}  // namespace

struct GrowthPlane::State {
  explicit State(double cell_m) : cells(cell_m) {}

  void put(const Item& item) {
    cells.add(item.segment, static_cast<std::uint32_t>(items.size()));
    items.push_back(item);
  }

  void put_line(std::span<const Point> line, Item::Kind kind) {
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      put({.segment = {line[i], line[i + 1]},
           .kind = kind,
           .is_vertex_a = i == 0,
           .is_vertex_b = i + 2 == line.size()});
    }
  }

  std::uint32_t put_vertex(Point place) {
    vertices.push_back(place);
    usable.push_back(std::none_of(barriers.begin(), barriers.end(), [&](const Barrier& barrier) {
      return barrier.region.locate(place) == barrier.barred;
    }));
    put({.segment = {place, place}, .kind = Item::Kind::kVertex});
    return static_cast<std::uint32_t>(vertices.size() - 1);
  }

  /// The existing nodes, then a vertex per distinct place of the points, in their order.
  void put_vertices(const GrowthSite& site) {
    for (const Point node : site.existing.nodes) put_vertex(node);
    existing_nodes = static_cast<std::uint32_t>(site.existing.nodes.size());
    std::vector<std::pair<Point, std::uint32_t>> places;
    for (std::uint32_t i = 0; i < existing_nodes; ++i) places.emplace_back(vertices[i], i);
    for (const IntersectionPoint& point : site.points)
      places.emplace_back(snap(point.place), static_cast<std::uint32_t>(places.size()));
    // The first of each place, as a number of `places`.
    std::vector<std::uint32_t> first(places.size());
    std::sort(places.begin(), places.end());
    for (std::size_t i = 0; i < places.size(); ++i) {
      const bool is_first = i == 0 || places[i].first != places[i - 1].first;
      first[places[i].second] = is_first ? places[i].second : first[places[i - 1].second];
    }
    std::vector<std::uint32_t> vertex_of(first.size());
    for (std::uint32_t i = 0; i < first.size(); ++i) {
      if (i < existing_nodes) {
        vertex_of[i] = first[i];
        continue;
      }
      const bool is_new = first[i] == i;
      vertex_of[i] =
          is_new ? put_vertex(snap(site.points[i - existing_nodes].place)) : vertex_of[first[i]];
      vertex_of_point.push_back(vertex_of[i]);
    }
  }

  void put_barrier(const Polygon& polygon, Side barred) {
    const auto region = static_cast<std::uint32_t>(barriers.size());
    barriers.push_back({GrowthRegion(polygon), barred});
    for (const Segment& edge : barriers.back().region.edges())
      put({.segment = edge, .kind = Item::Kind::kWall, .region = region});
  }

  /// Whether nothing bars the candidate; grown segments that it crosses are put into `crossed`
  /// where given, and then do not bar it.
  bool is_clear(const Candidate& candidate, std::vector<std::uint32_t>* crossed) const {
    return cells.for_each_near(candidate.segment, [&](std::uint32_t i) {
      const Item& item = items[i];
      if (item.is_gone) return true;
      if (item.kind == Item::Kind::kVertex) return !passes_through(candidate, item.segment.a);
      if (item.kind == Item::Kind::kWall) {
        const Barrier& barrier = barriers[item.region];
        return !meet(candidate.segment, item.segment) ||
               barrier.region.keeps_off(candidate.segment, barrier.barred);
      }
      const Meeting how = meeting(candidate, item);
      if (how == Meeting::kCrossing && item.kind == Item::Kind::kGrown && crossed != nullptr) {
        crossed->push_back(i);
        return true;
      }
      return how == Meeting::kApart || how == Meeting::kCommonVertex;
    });
  }

  /// The items of the straight grown segment between two vertices: one, or none.
  std::optional<std::uint32_t> find_straight(const Segment& segment) const {
    std::optional<std::uint32_t> found;
    cells.for_each_near(segment, [&](std::uint32_t i) {
      const Item& item = items[i];
      const bool is_it = !item.is_gone && item.kind == Item::Kind::kGrown &&
                         (item.segment == segment || item.segment == Segment{segment.b, segment.a});
      if (is_it) found = i;
      return !is_it;
    });
    return found;
  }

  [[nodiscard]] Segment between(std::uint32_t from, std::uint32_t to) const {
    return {vertices[from], vertices[to]};
  }

  std::vector<Point> vertices;
  std::vector<bool> usable;  ///< per vertex
  std::vector<std::uint32_t> vertex_of_point;
  std::uint32_t existing_nodes = 0;
  std::unordered_set<std::uint64_t> connected;  ///< pairs of vertices; asked, never iterated
  std::vector<Item> items;
  GrowthCells cells;
  std::vector<Barrier> barriers;
  bool has_crossings = false;
};

GrowthPlane::GrowthPlane(std::unique_ptr<State> state) : state_(std::move(state)) {}
GrowthPlane::GrowthPlane(GrowthPlane&&) noexcept = default;
GrowthPlane& GrowthPlane::operator=(GrowthPlane&&) noexcept = default;
GrowthPlane::~GrowthPlane() = default;

Expected<GrowthPlane> GrowthPlane::over(const GrowthSite& site) {
  if (auto defect = find_defect(site)) return tl::unexpected(std::move(*defect));
  Box box = box_of(site.existing.nodes);
  for (const IntersectionPoint& point : site.points) box.add(point.place);
  if (site.boundary) box.add(box_of(*site.boundary));
  for (const Polygon& obstacle : site.obstacles) box.add(box_of(obstacle));
  auto state = std::make_unique<State>(cell_size_m(site, box));

  if (site.boundary) {
    auto boundary = admit_polygon(*site.boundary, std::numeric_limits<std::size_t>::max());
    if (!boundary) {
      return fail(boundary.error().code, "boundary: " + boundary.error().message);
    }
    state->put_barrier(*boundary, Side::kOutside);
  }
  for (const Polygon& obstacle : site.obstacles) {
    const Polygon snapped = snap_polygon(obstacle);
    if (snapped.outer.size() >= 3) state->put_barrier(snapped, Side::kInside);
  }

  state->put_vertices(site);
  for (const Street& street : site.existing.streets) {
    state->put_line(street.line, Item::Kind::kExisting);
    state->connected.insert(pair_key(street.from, street.to));
  }
  return GrowthPlane(std::move(state));
}

std::span<const Point> GrowthPlane::vertices() const { return state_->vertices; }
std::uint32_t GrowthPlane::vertex_of_point(std::uint32_t point) const {
  return state_->vertex_of_point.at(point);
}
std::uint32_t GrowthPlane::existing_nodes() const { return state_->existing_nodes; }
bool GrowthPlane::is_usable(std::uint32_t vertex) const { return state_->usable.at(vertex); }
bool GrowthPlane::has_crossings() const { return state_->has_crossings; }

bool GrowthPlane::admits(std::uint32_t from, std::uint32_t to) const {
  const State& state = *state_;
  if (from == to || !state.usable[from] || !state.usable[to]) return false;
  if (state.connected.contains(pair_key(from, to))) return false;
  return state.is_clear({state.between(from, to)}, nullptr);
}

bool GrowthPlane::admits_line(std::span<const Point> line) const {
  const std::size_t last = line.size() - 1;
  for (std::size_t i = 0; i < last; ++i) {
    const Segment piece{line[i], line[i + 1]};
    if (piece.a == piece.b) return false;
    for (std::size_t k = 0; k + 1 < i; ++k) {
      // A closed line would have its first and last piece meet in its end.
      if (meet_when_noded(piece, {line[k], line[k + 1]})) return false;
    }
    if (i > 0 && overlap_when_noded(piece.a, line[i - 1], piece.b)) return false;
    if (!state_->is_clear({piece, i == 0, i + 1 == last}, nullptr)) return false;
  }
  return true;
}

bool GrowthPlane::passes_over(std::uint32_t from, std::uint32_t to, double clearance_m) const {
  if (!(clearance_m > 0.0)) return false;
  const Segment way = state_->between(from, to);
  const Point along = way.b - way.a;
  Box box{way.a, way.a};
  box.add(way.b);
  return !state_->cells.for_each_in(box.expanded(clearance_m), [&](std::uint32_t i) {
    const Item& item = state_->items[i];
    if (item.kind != Item::Kind::kVertex) return true;
    const double t = dot(item.segment.a - way.a, along);
    const bool is_beside = t > 0.0 && t < squared_length(along);
    return !is_beside || distance(way, item.segment.a) >= clearance_m;
  });
}

void GrowthPlane::add(std::uint32_t from, std::uint32_t to) {
  const Segment segment = state_->between(from, to);
  state_->put_line(std::vector<Point>{segment.a, segment.b}, Item::Kind::kGrown);
  state_->connected.insert(pair_key(from, to));
}

bool GrowthPlane::bend(std::uint32_t from, std::uint32_t to, std::span<const Point> line) {
  State& state = *state_;
  expects(
      line.size() >= 2 && line.front() == state.vertices[from] && line.back() == state.vertices[to],
      "a curve runs from vertex to vertex");
  const auto straight = state.find_straight(state.between(from, to));
  expects(straight.has_value(), "a curve takes the place of a straight segment");
  Item& old = state.items[*straight];
  if (old.is_crossed) return false;
  old.is_gone = true;
  if (!admits_line(line)) {
    old.is_gone = false;
    return false;
  }
  state.put_line(line, Item::Kind::kGrown);
  return true;
}

std::optional<std::vector<Point>> GrowthPlane::crossings(std::uint32_t from,
                                                         std::uint32_t to) const {
  const State& state = *state_;
  if (from == to || !state.usable[from] || !state.usable[to]) return std::nullopt;
  if (state.connected.contains(pair_key(from, to))) return std::nullopt;
  const Candidate candidate{state.between(from, to)};
  std::vector<std::uint32_t> crossed;
  if (!state.is_clear(candidate, &crossed)) return std::nullopt;
  std::sort(crossed.begin(), crossed.end());
  crossed.erase(std::unique(crossed.begin(), crossed.end()), crossed.end());

  std::vector<Point> places;
  for (const std::uint32_t i : crossed) {
    const Segment& other = state.items[i].segment;
    const Point place = crossing_place(candidate.segment, other);
    const Point reach{kCrossingClearance_m, kCrossingClearance_m};
    const bool has_clearance =
        distance(place, candidate.segment.a) >= kCrossingClearance_m &&
        distance(place, candidate.segment.b) >= kCrossingClearance_m &&
        state.cells.for_each_in(Box{place - reach, place + reach}, [&](std::uint32_t k) {
          const Item& item = state.items[k];
          return k == i || item.is_gone || item.kind == Item::Kind::kWall ||
                 distance(item.segment, place) >= kCrossingClearance_m;
        });
    if (!has_clearance) return std::nullopt;
    places.push_back(place);
  }
  std::sort(places.begin(), places.end(), [&](Point p, Point q) {
    return squared_length(p - candidate.segment.a) < squared_length(q - candidate.segment.a);
  });
  return places;
}

void GrowthPlane::add_across(std::uint32_t from, std::uint32_t to,
                             std::span<const Point> crossings) {
  State& state = *state_;
  if (!crossings.empty()) {
    std::vector<std::uint32_t> crossed;
    state.is_clear({state.between(from, to)}, &crossed);
    for (const std::uint32_t i : crossed) state.items[i].is_crossed = true;
    state.has_crossings = true;
  }
  for (const Point place : crossings) state.put_vertex(place);
  add(from, to);
  state.items.back().is_crossed = !crossings.empty();
}

std::uint32_t GrowthPlane::add_up_to(std::uint32_t from, std::uint32_t to,
                                     std::span<const Point> crossings) {
  expects(!crossings.empty(), "a segment ends at a crossing");
  State& state = *state_;
  std::vector<std::uint32_t> crossed;
  state.is_clear({state.between(from, to)}, &crossed);
  for (const std::uint32_t i : crossed) {
    const bool is_first =
        crossing_place(state.between(from, to), state.items[i].segment) == crossings.front();
    if (is_first) state.items[i].is_crossed = true;
  }
  const std::uint32_t vertex = state.put_vertex(crossings.front());
  add(from, vertex);
  state.items.back().is_crossed = true;
  state.has_crossings = true;
  return vertex;
}

}  // namespace plat::streets
