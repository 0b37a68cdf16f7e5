#include "similarity/shape_neighbourhood.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

#include "core/validity.h"

namespace plat::similarity {
namespace {

/// An edge of a ring, with its label where it is of an outer ring.
struct Edge {
  Point from;
  Point to;
  EdgeLabel label = EdgeLabel::kUnknown;
  std::uint32_t shape = 0;

  [[nodiscard]] auto ends() const { return std::tuple(from, to); }
};

bool is_before(const Edge& a, const Edge& b) { return a.ends() < b.ends(); }

void add_edges(const LabelledShape& shape, std::uint32_t index, std::vector<Edge>& out) {
  const auto add = [&](const Ring& ring, std::span<const EdgeLabel> labels) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      out.push_back({ring[i], ring[i + 1 == ring.size() ? 0 : i + 1],
                     labels.empty() ? EdgeLabel::kUnknown : labels[i], index});
    }
  };
  add(shape.polygon.outer, shape.edges);
  for (const Ring& hole : shape.polygon.holes) add(hole, {});
}

/// The edges, sorted, that run from `to` to `from`.
std::span<const Edge> opposite(const std::vector<Edge>& sorted, const Edge& edge) {
  const auto [begin, end] =
      std::equal_range(sorted.begin(), sorted.end(), Edge{edge.to, edge.from}, is_before);
  return {begin, end};
}

std::string place(Point p) { return fmt::format("({:.3f}, {:.3f})", p.x, p.y); }

/// The zone of the largest area; empty where none is known.
std::string zone_of(std::span<const LabelledShape* const> shapes) {
  std::map<std::string, double> area_of;
  for (const LabelledShape* shape : shapes) {
    if (!shape->zone.empty()) area_of[shape->zone] += area_m2(shape->polygon);
  }
  std::string zone;
  double largest_m2 = 0.0;
  for (const auto& [name, area] : area_of) {
    if (area > largest_m2) {
      zone = name;
      largest_m2 = area;
    }
  }
  return zone;
}

/// What is left of the edges when those that run both ways are taken out; sorted.
Expected<std::vector<Edge>> boundary_of(std::span<const LabelledShape* const> shapes) {
  std::vector<Edge> edges;
  for (const LabelledShape* shape : shapes) add_edges(*shape, 0, edges);
  std::ranges::sort(edges, is_before);
  std::vector<Edge> left;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (i > 0 && edges[i].ends() == edges[i - 1].ends())
      return fail(FailureCode::kTilesOverlap,
                  "two shapes lie on the same side of the edge at " + place(edges[i].from));
    if (opposite(edges, edges[i]).empty()) left.push_back(edges[i]);
  }
  for (std::size_t i = 1; i < left.size(); ++i) {
    if (left[i].from == left[i - 1].from)
      return fail(FailureCode::kNotSimple, "the union touches itself at " + place(left[i].from));
  }
  if (left.empty()) return fail(FailureCode::kNotSimple, "nothing bounds the union");
  return left;
}

/// Rings of edges of which each vertex begins one, each ring from its first vertex on.
std::vector<std::vector<Edge>> rings_of(const std::vector<Edge>& boundary) {
  std::vector<std::vector<Edge>> rings;
  std::vector<bool> is_used(boundary.size(), false);
  for (std::size_t first = 0; first < boundary.size(); ++first) {
    std::vector<Edge> ring;
    for (std::size_t i = first; !is_used[i];) {
      is_used[i] = true;
      ring.push_back(boundary[i]);
      const auto next = std::ranges::lower_bound(boundary, boundary[i].to, {}, &Edge::from);
      expects(next != boundary.end() && next->from == boundary[i].to, "closed rings");
      i = static_cast<std::size_t>(next - boundary.begin());
    }
    if (!ring.empty()) rings.push_back(std::move(ring));
  }
  return rings;
}

}  // namespace

ShapeNeighbourhood::ShapeNeighbourhood(std::vector<LabelledShape> shapes)
    : shapes_(std::move(shapes)), neighbours_(shapes_.size()) {
  std::vector<Edge> edges;
  for (std::uint32_t i = 0; i < shapes_.size(); ++i) add_edges(shapes_[i], i, edges);
  std::ranges::sort(edges, is_before);
  for (const Edge& edge : edges) {
    for (const Edge& other : opposite(edges, edge)) {
      if (other.shape != edge.shape) neighbours_[edge.shape].push_back(other.shape);
    }
  }
  for (auto& list : neighbours_) {
    std::ranges::sort(list);
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
}

Expected<LabelledShape> union_of(std::span<const LabelledShape* const> shapes) {
  const auto boundary = boundary_of(shapes);
  if (!boundary) return tl::unexpected(boundary.error());
  LabelledShape out;
  out.zone = zone_of(shapes);
  const bool has_labels =
      std::ranges::any_of(shapes, [](const LabelledShape* shape) { return !shape->edges.empty(); });
  for (const std::vector<Edge>& edges : rings_of(*boundary)) {
    Ring ring;
    for (const Edge& edge : edges) ring.push_back(edge.from);
    if (signed_area_m2(ring) <= 0.0) {
      out.polygon.holes.push_back(std::move(ring));
      continue;
    }
    if (!out.polygon.outer.empty())
      return fail(FailureCode::kNotSimple, "the union is in pieces, one at " + place(ring.front()));
    out.polygon.outer = std::move(ring);
    for (std::size_t i = 0; i < edges.size() && has_labels; ++i)
      out.edges.push_back(edges[i].label);
  }
  if (const auto defect = find_defect(out.polygon))
    return fail(FailureCode::kTilesOverlap, "the union is not simple: " + defect->message);
  return out;
}

}  // namespace plat::similarity
