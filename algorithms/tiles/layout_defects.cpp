#include "tiles/layout_defects.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "core/exact_orientation.h"
#include "core/validity.h"
#include "tiles/cell_index_internal.h"

namespace plat::tiles {
namespace {

/// About the size of a lot: what the index of tiles is divided by.
constexpr double kCell_m = 30.0;

/// The angle that a polygon has at a point of its boundary: counter-clockwise from `from` to `to`.
struct Sector {
  Point from;
  Point to;
};

/// Whether the ray from `at` to `p` runs strictly inside the sector.
bool is_within(Point at, const Sector& sector, Point p) {
  const int width = orientation_sign(at, sector.from, sector.to);
  if (width > 0) {
    return orientation_sign(at, sector.from, p) > 0 && orientation_sign(at, p, sector.to) > 0;
  }
  if (width == 0) return orientation_sign(at, sector.from, p) > 0;  // half a turn
  // More than half a turn: what the complement, its rays included, does not hold.
  return orientation_sign(at, sector.to, p) < 0 || orientation_sign(at, p, sector.from) < 0;
}

bool is_same_ray(Point at, Point p, Point q) {
  return orientation_sign(at, p, q) == 0 && dot(p - at, q - at) > 0.0;
}

bool overlap(Point at, const Sector& a, const Sector& b) {
  return is_same_ray(at, a.from, b.from) || is_within(at, a, b.from) || is_within(at, b, a.from);
}

struct Side {
  Point before;  ///< the corner before the edge
  Segment edge;
  Point after;
};

struct Shape {
  Polygon polygon;
  Box box;
  std::vector<Side> sides;
};

Shape shape_from(Polygon polygon) {
  Shape out{std::move(polygon), {}, {}};
  out.box = box_of(out.polygon);
  const auto add = [&](const Ring& ring) {
    const std::size_t n = ring.size();
    for (std::size_t i = 0; i < n; ++i) {
      out.sides.push_back({ring[(i + n - 1) % n], {ring[i], ring[(i + 1) % n]}, ring[(i + 2) % n]});
    }
  };
  add(out.polygon.outer);
  for (const Ring& hole : out.polygon.holes) add(hole);
  return out;
}

/// The angle at `p`, which lies on the side.
Sector sector_at(const Side& side, Point p) {
  if (p == side.edge.a) return {side.edge.b, side.before};
  if (p == side.edge.b) return {side.after, side.edge.a};
  return {side.edge.b, side.edge.a};
}

/// Where the two sides show that their polygons overlap.
std::optional<Point> overlap_at(const Side& s, const Side& t) {
  if (cross_properly(s.edge, t.edge)) return s.edge.a;
  for (const Point p : {s.edge.a, s.edge.b, t.edge.a, t.edge.b}) {
    if (lies_on(s.edge, p) && lies_on(t.edge, p) && overlap(p, sector_at(s, p), sector_at(t, p))) {
      return p;
    }
  }
  return std::nullopt;
}

Box box_of(const Segment& s) {
  Box box;
  box.add(s.a);
  box.add(s.b);
  return box;
}

/// A corner of `a` where it lies inside `b`. Outlines tell: a hole inside `b` whose outline is not,
/// and that nothing touches, has the outline of `b` around it, inside `a`.
std::optional<Point> corner_inside(const Shape& a, const Shape& b) {
  const Point corner = a.polygon.outer.front();
  if (!b.box.contains(corner) || locate(b.polygon, corner) != plat::Side::kInside)
    return std::nullopt;
  return corner;
}

std::optional<Point> overlap_of(const Shape& a, const Shape& b) {
  Box common{{std::max(a.box.min.x, b.box.min.x), std::max(a.box.min.y, b.box.min.y)},
             {std::min(a.box.max.x, b.box.max.x), std::min(a.box.max.y, b.box.max.y)}};
  std::vector<const Side*> near;
  for (const Side& t : b.sides) {
    if (box_of(t.edge).intersects(common)) near.push_back(&t);
  }
  for (const Side& s : a.sides) {
    const Box box = box_of(s.edge);
    if (!box.intersects(common)) continue;
    for (const Side* t : near) {
      if (!box.intersects(box_of(t->edge))) continue;
      if (const auto at = overlap_at(s, *t)) return at;
    }
  }
  if (const auto at = corner_inside(a, b)) return at;
  return corner_inside(b, a);
}

Failure overlapping(std::string what, Point at) {
  return {FailureCode::kTilesOverlap, fmt::format("{} near ({:.3f}, {:.3f})", what, at.x, at.y)};
}

std::string name_of(const Tile& tile) {
  return fmt::format("tile {} ({})", tile.id.value, tile.source_id);
}

std::optional<Failure> find_broken_invariant(const TileLayout& layout) {
  std::set<TileId> ids;
  std::vector<std::optional<std::uint32_t>> block_of(layout.vertices.size());
  const auto is_finite = [](Point p) { return std::isfinite(p.x) && std::isfinite(p.y); };
  for (const Tile& tile : layout.tiles) {
    if (!ids.insert(tile.id).second || tile.id.value >= layout.next_id)
      return Failure{FailureCode::kUnknownEntity, name_of(tile) + ": the id is not its own"};
    if (tile.rings.empty())
      return Failure{FailureCode::kEmptyGeometry, name_of(tile) + " has no ring"};
    if (!tile.placement.is_finite())
      return Failure{FailureCode::kNotFinite, name_of(tile) + ": placement"};
    for (const auto& ring : tile.rings) {
      for (const Corner& corner : ring) {
        if (corner.vertex >= layout.vertices.size())
          return Failure{FailureCode::kUnknownEntity,
                         fmt::format("{} has a corner at vertex {} of {}", name_of(tile),
                                     corner.vertex, layout.vertices.size())};
        if (!is_finite(corner.rest) || !is_finite(layout.vertices[corner.vertex].at))
          return Failure{FailureCode::kNotFinite,
                         fmt::format("{}: vertex {}", name_of(tile), corner.vertex)};
        std::optional<std::uint32_t>& block = block_of[corner.vertex];
        if (block && *block != tile.block)
          return Failure{
              FailureCode::kUnknownEntity,
              fmt::format("vertex {} is of blocks {} and {}", corner.vertex, *block, tile.block)};
        block = tile.block;
      }
    }
  }
  for (const StreetLink& link : layout.links) {
    if (link.a >= layout.tiles.size() || link.b >= layout.tiles.size())
      return Failure{FailureCode::kUnknownEntity, fmt::format("a link joins tiles {} and {} of {}",
                                                              link.a, link.b, layout.tiles.size())};
    if (!is_finite(link.rest_a) || !is_finite(link.rest_b) || !std::isfinite(link.width_m))
      return Failure{FailureCode::kNotFinite,
                     fmt::format("the link of tiles {} and {}", link.a, link.b)};
  }
  return std::nullopt;
}

}  // namespace

std::vector<TileDefect> find_tile_defects(const TileLayout& layout) {
  std::vector<TileDefect> defects;
  std::vector<Shape> shapes;
  std::vector<Box> boxes;
  for (std::uint32_t t = 0; t < layout.tiles.size(); ++t) {
    Polygon polygon = shape_of(layout, layout.tiles[t]);
    const auto defect = find_defect(polygon);
    if (defect) {
      defects.push_back(
          {t,
           std::nullopt,
           {FailureCode::kTilesOverlap, name_of(layout.tiles[t]) + ": " + defect->message}});
    }
    // A tile with a defect of its own is not held against others: it would fail with all of them.
    shapes.push_back(defect ? Shape{} : shape_from(std::move(polygon)));
    boxes.push_back(shapes.back().box);
  }
  const CellIndex index(boxes, kCell_m);
  for (std::uint32_t a = 0; a < shapes.size(); ++a) {
    if (boxes[a].is_empty()) continue;
    for (const std::uint32_t b : index.near(boxes[a])) {
      if (b <= a) continue;
      if (const auto at = overlap_of(shapes[a], shapes[b])) {
        defects.push_back(
            {a, b,
             overlapping(name_of(layout.tiles[a]) + " overlaps " + name_of(layout.tiles[b]), *at)});
      }
    }
  }
  std::ranges::stable_sort(defects, {}, &TileDefect::tile);
  return defects;
}

std::optional<Failure> find_layout_defect(const TileLayout& layout) {
  if (auto broken = find_broken_invariant(layout)) return broken;
  std::vector<TileDefect> defects = find_tile_defects(layout);
  if (defects.empty()) return std::nullopt;
  return std::move(defects.front().failure);
}

}  // namespace plat::tiles
