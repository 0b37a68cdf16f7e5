#include "core/planar_faces.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/failure.h"
#include "core/working_grid.h"

namespace plat {
namespace {

__extension__ using Wide = __int128;

bool is_upper(Point d) { return d.y > 0.0 || (d.y == 0.0 && d.x > 0.0); }

/// Counter-clockwise order of directions, from the positive x axis; exact on the working grid up to
/// 2^15 m.
bool is_before(Point d, Point e) {
  if (is_upper(d) != is_upper(e)) return is_upper(d);
  return cross(d, e) > 0.0;
}

/// The half-edge after each one on the boundary of the face on its left.
std::vector<HalfEdge> link_half_edges(const PlanarGraph& graph) {
  const std::size_t half_edges = 2 * graph.edges.size();
  std::vector<std::uint32_t> offsets(graph.nodes.size() + 1, 0);
  for (const auto& e : graph.edges) {
    ++offsets[e.from + 1];
    ++offsets[e.to + 1];
  }
  std::partial_sum(offsets.begin(), offsets.end(), offsets.begin());
  std::vector<HalfEdge> around(half_edges);
  std::vector<std::uint32_t> place(offsets.begin(), offsets.end() - 1);
  for (HalfEdge h = 0; h < half_edges; ++h) around[place[origin(graph, h)]++] = h;
  std::vector<HalfEdge> next(half_edges);
  for (std::size_t v = 0; v < graph.nodes.size(); ++v) {
    const auto begin = around.begin() + offsets[v];
    const auto end = around.begin() + offsets[v + 1];
    const auto direction = [&](HalfEdge h) {
      return graph.nodes[target(graph, h)] - graph.nodes[v];
    };
    std::sort(begin, end,
              [&](HalfEdge g, HalfEdge h) { return is_before(direction(g), direction(h)); });
    // Arriving along twin(h), turn to the next outgoing half-edge clockwise from h.
    for (auto it = begin; it != end; ++it) next[twin(*it)] = it == begin ? *(end - 1) : *(it - 1);
  }
  return next;
}

double walk_area_m2(const PlanarGraph& graph, std::span<const HalfEdge> walk) {
  const Point base = graph.nodes[origin(graph, walk.front())];
  double twice = 0.0;
  for (const HalfEdge h : walk)
    twice += cross(graph.nodes[origin(graph, h)] - base, graph.nodes[target(graph, h)] - base);
  return 0.5 * twice;
}

/// For a point, the edge straight below it; edges are filed by columns of x.
class EdgesBelow {
 public:
  explicit EdgesBelow(const PlanarGraph& graph) : graph_(graph) {
    const Box box = box_of(graph.nodes);
    left_ = box.min.x;
    const auto columns =
        static_cast<std::size_t>(std::sqrt(static_cast<double>(graph.edges.size()))) + 1;
    width_ = std::max(box.width() / static_cast<double>(columns), kGridStep_m);
    columns_.resize(columns);
    for (std::uint32_t e = 0; e < graph.edges.size(); ++e) {
      const auto [x0, x1] = std::minmax({a(e).x, b(e).x});
      if (x0 == x1) continue;
      for (std::size_t c = column(x0); c <= column(x1); ++c) columns_[c].push_back(e);
    }
  }

  /// The half-edge whose left side looks up at `p` from the nearest edge strictly below it that
  /// `is_wanted`; kNone where there is none.
  static constexpr HalfEdge kNone = 0xffffffffU;
  template <class IsWanted>
  HalfEdge find(Point p, IsWanted is_wanted) const {
    HalfEdge best = kNone;
    for (const std::uint32_t e : columns_[column(p.x)]) {
      const bool runs_right = a(e).x < b(e).x;
      const Point l = runs_right ? a(e) : b(e);
      const Point r = runs_right ? b(e) : a(e);
      if (!(l.x <= p.x && p.x < r.x) || orientation(l, r, p) <= 0.0 || !is_wanted(e)) continue;
      const HalfEdge h = 2 * e + (runs_right ? 0U : 1U);
      if (best == kNone || is_above(h, best, p.x)) best = h;
    }
    return best;
  }

 private:
  [[nodiscard]] Point a(std::uint32_t e) const { return graph_.nodes[graph_.edges[e].from]; }
  [[nodiscard]] Point b(std::uint32_t e) const { return graph_.nodes[graph_.edges[e].to]; }
  [[nodiscard]] std::size_t column(double x) const {
    return std::min(static_cast<std::size_t>((x - left_) / width_), columns_.size() - 1);
  }

  /// Whether half-edge g is above h on the vertical line at x; both run right and do not cross.
  [[nodiscard]] bool is_above(HalfEdge g, HalfEdge h, double x) const {
    // Compared as exact fractions: y = (ly * dx + (x - lx) * dy) / dx, in grid units.
    const auto fraction = [&](HalfEdge k) {
      const Point l = graph_.nodes[origin(graph_, k)];
      const Point r = graph_.nodes[target(graph_, k)];
      const Wide dx = to_grid(r.x) - to_grid(l.x);
      const Wide dy = to_grid(r.y) - to_grid(l.y);
      return std::tuple(to_grid(l.y) * dx + (to_grid(x) - to_grid(l.x)) * dy, dx, dy);
    };
    const auto [ng, dg, slope_g] = fraction(g);
    const auto [nh, dh, slope_h] = fraction(h);
    if (ng * dh != nh * dg) return ng * dh > nh * dg;
    return slope_g * dh >
           slope_h * dg;  // they leave the same node: the steeper one is above to its right
  }

  const PlanarGraph& graph_;
  double left_ = 0.0;
  double width_ = 1.0;
  std::vector<std::vector<std::uint32_t>> columns_;
};

/// The loops of a closed walk whose i-th step runs from origin_of(i) to target_of(i).
template <class Step, class OriginOf, class TargetOf>
std::vector<std::vector<Step>> split_walk(std::span<const Step> walk, OriginOf origin_of,
                                          TargetOf target_of) {
  std::vector<std::vector<Step>> rings;
  std::vector<std::size_t> open;
  for (std::size_t step = 0; step < walk.size(); ++step) {
    open.push_back(step);
    const auto reached = target_of(step);
    // The loop that just closed, if any, starts at the last open step that left this place.
    for (std::size_t i = open.size(); i-- > 0;) {
      if (origin_of(open[i]) != reached) continue;
      std::vector<Step> ring;
      for (std::size_t k = i; k < open.size(); ++k) ring.push_back(walk[open[k]]);
      open.resize(i);
      if (ring.size() >= 3) rings.push_back(std::move(ring));
      break;
    }
  }
  return rings;
}

}  // namespace

PlanarFaces find_faces(const PlanarGraph& graph) {
  PlanarFaces out;
  const std::size_t half_edges = 2 * graph.edges.size();
  const std::vector<HalfEdge> next = link_half_edges(graph);

  // Boundary walks: counter-clockwise ones are the outer boundaries of faces, the others those of
  // components.
  std::vector<std::uint32_t> walk_of(half_edges, PlanarFaces::kUnbounded);
  std::vector<std::vector<HalfEdge>> walks;
  for (HalfEdge start = 0; start < half_edges; ++start) {
    if (walk_of[start] != PlanarFaces::kUnbounded) continue;
    std::vector<HalfEdge> walk;
    for (HalfEdge h = start; walk_of[h] == PlanarFaces::kUnbounded; h = next[h]) {
      walk_of[h] = static_cast<std::uint32_t>(walks.size());
      walk.push_back(h);
    }
    walks.push_back(std::move(walk));
  }
  std::vector<std::uint32_t> face_of_walk(walks.size(), PlanarFaces::kUnbounded);
  std::vector<std::uint32_t> component_walks;
  for (std::uint32_t w = 0; w < walks.size(); ++w) {
    if (walk_area_m2(graph, walks[w]) > 0.0) {
      face_of_walk[w] = static_cast<std::uint32_t>(out.faces.size());
      out.faces.push_back({walks[w], {}});
    } else {
      component_walks.push_back(w);
    }
  }

  // Nesting: the lowest edge under a component's leftmost node tells which face it lies in, or
  // which other component it lies above, whose answer is then its own.
  if (component_walks.size() > 1) {
    std::vector<std::uint32_t> component(graph.nodes.size());
    std::iota(component.begin(), component.end(), 0U);
    const auto root = [&](std::uint32_t v) {
      while (component[v] != v) v = component[v] = component[component[v]];
      return v;
    };
    for (const auto& e : graph.edges) component[root(e.from)] = root(e.to);

    const EdgesBelow edges_below(graph);
    std::vector<std::pair<Point, std::uint32_t>> by_leftmost;
    for (const std::uint32_t w : component_walks) {
      std::uint32_t leftmost = origin(graph, walks[w].front());
      for (const HalfEdge h : walks[w])
        leftmost = std::min(leftmost, origin(graph, h));  // nodes are sorted
      by_leftmost.emplace_back(graph.nodes[leftmost], w);
    }
    std::sort(by_leftmost.begin(), by_leftmost.end());
    for (const auto& [p, w] : by_leftmost) {
      const std::uint32_t own = root(origin(graph, walks[w].front()));
      const HalfEdge below =
          edges_below.find(p, [&](std::uint32_t e) { return root(graph.edges[e].from) != own; });
      // A component below starts further left, so its own face is known already.
      const std::uint32_t face =
          below == EdgesBelow::kNone ? PlanarFaces::kUnbounded : face_of_walk[walk_of[below]];
      face_of_walk[w] = face;
      if (face != PlanarFaces::kUnbounded) out.faces[face].islands.push_back(walks[w]);
    }
  }
  out.face_of.resize(half_edges);
  for (HalfEdge h = 0; h < half_edges; ++h) out.face_of[h] = face_of_walk[walk_of[h]];
  return out;
}

std::vector<bool> find_dead_ends(const PlanarGraph& graph) {
  std::vector<std::uint32_t> degree(graph.nodes.size(), 0);
  std::vector<std::vector<std::uint32_t>> at(graph.nodes.size());
  for (std::uint32_t e = 0; e < graph.edges.size(); ++e) {
    for (const std::uint32_t v : {graph.edges[e].from, graph.edges[e].to}) {
      ++degree[v];
      at[v].push_back(e);
    }
  }
  std::vector<bool> is_dead(graph.edges.size(), false);
  std::vector<std::uint32_t> ends;
  for (std::uint32_t v = 0; v < graph.nodes.size(); ++v) {
    if (degree[v] == 1) ends.push_back(v);
  }
  while (!ends.empty()) {
    const std::uint32_t v = ends.back();
    ends.pop_back();
    for (const std::uint32_t e : at[v]) {
      if (is_dead[e]) continue;
      is_dead[e] = true;
      const std::uint32_t other =
          graph.edges[e].from == v ? graph.edges[e].to : graph.edges[e].from;
      if (--degree[other] == 1) ends.push_back(other);
    }
  }
  return is_dead;
}

PlanarGraph without_edges(const PlanarGraph& graph, const std::vector<bool>& is_removed) {
  expects(is_removed.size() == graph.edges.size(), "one mark per edge");
  PlanarGraph out;
  out.nodes = graph.nodes;
  std::vector<std::uint32_t> new_index(graph.edges.size(), 0);
  for (std::uint32_t e = 0; e < graph.edges.size(); ++e) {
    new_index[e] = static_cast<std::uint32_t>(out.edges.size());
    if (!is_removed[e]) out.edges.push_back(graph.edges[e]);
  }
  for (const auto& overlap : graph.overlaps) {
    if (!is_removed[overlap.edge])
      out.overlaps.push_back({new_index[overlap.edge], overlap.source});
  }
  return out;
}

std::vector<std::vector<HalfEdge>> split_at_repeated_nodes(const PlanarGraph& graph,
                                                           std::span<const HalfEdge> walk) {
  return split_walk(
      walk, [&](std::size_t i) { return origin(graph, walk[i]); },
      [&](std::size_t i) { return target(graph, walk[i]); });
}

Ring ring_of(const PlanarGraph& graph, std::span<const HalfEdge> walk) {
  Ring ring;
  ring.reserve(walk.size());
  for (const HalfEdge h : walk) ring.push_back(graph.nodes[origin(graph, h)]);
  return ring;
}

Polygon polygon_of(const PlanarGraph& graph, std::span<const std::vector<HalfEdge>> walks) {
  std::vector<Ring> rings;
  rings.reserve(walks.size());
  for (const auto& walk : walks) rings.push_back(ring_of(graph, walk));
  return polygon_of_walks(rings);
}

Polygon polygon_of_walks(std::span<const Ring> walks) {
  Polygon polygon;
  double outer_area = 0.0;
  for (const Ring& walk : walks) {
    const auto target_of = [&](std::size_t i) { return walk[i + 1 == walk.size() ? 0 : i + 1]; };
    for (Ring& ring : split_walk(
             std::span<const Point>(walk), [&](std::size_t i) { return walk[i]; }, target_of)) {
      const double area = signed_area_m2(ring);
      if (area < 0.0) {
        polygon.holes.push_back(std::move(ring));
      } else if (area > outer_area) {
        outer_area = area;
        polygon.outer = std::move(ring);
      }
    }
  }
  return polygon;
}

Polygon polygon_of(const PlanarGraph& graph, const Face& face) {
  std::vector<std::vector<HalfEdge>> walks{face.outer};
  walks.insert(walks.end(), face.islands.begin(), face.islands.end());
  return polygon_of(graph, walks);
}

}  // namespace plat
