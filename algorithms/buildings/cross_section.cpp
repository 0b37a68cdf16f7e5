#include "buildings/cross_section.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "blocks/geos_internal.h"
#include "buildings/ring_chaining_internal.h"
#include "core/failure.h"
#include "core/working_grid.h"

namespace plat::buildings {
namespace {

using detail::DirectedEdge;

/// A vertex nearer to the line between its neighbours is taken off before the section is put on the
/// grid: meshes have vertices along straight edges, and the grid would bend the edges there. Above
/// what floats leave, below the grid.
constexpr double kStraight_m = 1.0 / 8192.0;

/// Points of the plane, each under its grid point: which edges are the same is told on the grid.
class PlanePoints {
 public:
  explicit PlanePoints(const CutPlane& plane) : plane_(plane) {}

  Point add(Point3 p) {
    const Point raw{dot(p - plane_.origin, plane_.across), dot(p - plane_.origin, plane_.up)};
    const Point key = snap(raw);
    raw_.try_emplace(key, raw);
    return key;
  }

  /// The ring of those keys, without vertices along straight edges, on the grid.
  [[nodiscard]] Ring ring(const Ring& keys) const {
    Ring out;
    for (const Point key : keys) out.push_back(raw_.at(key));
    for (std::size_t i = 0; i < out.size() && out.size() >= 3;) {
      const Point before = out[(i + out.size() - 1) % out.size()];
      const Point after = out[(i + 1) % out.size()];
      if (distance(Segment{before, after}, out[i]) < kStraight_m) {
        out.erase(out.begin() + static_cast<std::ptrdiff_t>(i));
        i = i > 0 ? i - 1 : 0;
      } else {
        ++i;
      }
    }
    return snap_ring(out);
  }

 private:
  const CutPlane& plane_;
  std::map<Point, Point> raw_;
};

/// Ports whose coordinates are seen from behind turn every ring around.
bool is_seen_from_behind(const CutPlane& plane) {
  return dot(cross(plane.across, plane.up), plane.outward) < 0.0;
}

void start_at_lowest(Ring& ring) {
  std::rotate(ring.begin(), std::min_element(ring.begin(), ring.end()), ring.end());
}

CrossSection canonical(std::vector<Polygon> regions) {
  for (Polygon& region : regions) {
    start_at_lowest(region.outer);
    for (Ring& hole : region.holes) start_at_lowest(hole);
    std::ranges::sort(region.holes);
  }
  std::ranges::sort(regions, {}, &Polygon::outer);
  return {std::move(regions)};
}

/// Edges of the inside's border, each with its reverse cancelled, put into sections.
std::optional<CrossSection> section_from(const std::vector<DirectedEdge>& edges,
                                         const PlanePoints& points) {
  std::map<DirectedEdge, int> surplus;
  for (const DirectedEdge& edge : edges) {
    if (edge.first == edge.second) continue;
    const DirectedEdge back{edge.second, edge.first};
    if (const auto at = surplus.find(back); at != surplus.end() && at->second > 0) {
      --at->second;
    } else {
      ++surplus[edge];
    }
  }
  std::vector<DirectedEdge> border;
  for (const auto& [edge, count] : surplus) {
    for (int i = 0; i < count; ++i) border.push_back(edge);
  }
  std::optional<std::vector<Ring>> rings = detail::chain_rings(border);
  if (!rings) return std::nullopt;
  for (Ring& ring : *rings) ring = points.ring(ring);
  return canonical(detail::regions_of(std::move(*rings)));
}

blocks::detail::GeosShape shape_of(const blocks::detail::Geos& geos, const CrossSection& section) {
  std::vector<blocks::detail::GeosShape> regions;
  for (const Polygon& region : section.regions) regions.push_back(geos.from(region));
  return geos.union_of(std::move(regions));
}

}  // namespace

double area_m2(const CrossSection& section) {
  double sum = 0.0;
  for (const Polygon& region : section.regions) sum += plat::area_m2(region);
  return sum;
}

CrossSection mirrored(const CrossSection& section) {
  const auto mirror = [](Ring& ring) {
    for (Point& p : ring) p.x = 0.0 - p.x;  // never -0
    std::ranges::reverse(ring);
  };
  CrossSection out = section;
  for (Polygon& region : out.regions) {
    mirror(region.outer);
    std::ranges::for_each(region.holes, mirror);
  }
  return canonical(std::move(out.regions));
}

double disagreement_m2(const CrossSection& a, const CrossSection& b) {
  if (a == b) return 0.0;
  const blocks::detail::Geos geos;
  const blocks::detail::GeosShape shape_a = shape_of(geos, a);
  const blocks::detail::GeosShape shape_b = shape_of(geos, b);
  const blocks::detail::GeosShape apart =
      geos.own(GEOSSymDifference_r(geos.context(), shape_a.get(), shape_b.get()));
  double area = 0.0;
  if (!apart || GEOSArea_r(geos.context(), apart.get(), &area) == 0)
    throw LogicError("GEOS could not overlay two cross sections");
  return area;
}

std::vector<std::size_t> cap_faces(const Mesh& mesh, const CutPlane& plane) {
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
    const bool is_in_plane = std::ranges::all_of(mesh.faces[i].vertices, [&](std::uint32_t v) {
      return std::abs(dot(mesh.vertices[v] - plane.origin, plane.outward)) <= kCapTolerance_m;
    });
    if (is_in_plane && dot(normal(mesh, mesh.faces[i]), plane.outward) > 0.0) out.push_back(i);
  }
  return out;
}

CrossSection cap_section(const Mesh& mesh, const CutPlane& plane) {
  PlanePoints points(plane);
  std::vector<DirectedEdge> edges;
  for (const std::size_t i : cap_faces(mesh, plane)) {
    std::array<Point, 3> corner;
    for (std::size_t k = 0; k < 3; ++k)
      corner[k] = points.add(mesh.vertices[mesh.faces[i].vertices[k]]);
    if (is_seen_from_behind(plane)) std::swap(corner[1], corner[2]);
    for (std::size_t k = 0; k < 3; ++k) edges.emplace_back(corner[k], corner[(k + 1) % 3]);
  }
  // The border of a set of triangles always closes.
  return section_from(edges, points).value_or(CrossSection{});
}

CrossSection slice_section(const Mesh& mesh, const CutPlane& plane) {
  const auto height = [&](std::uint32_t v) {
    return dot(mesh.vertices[v] - plane.origin, plane.outward) + kSliceDepth_m;
  };
  PlanePoints points(plane);
  // The same two vertices give the same point, whichever face asks.
  const auto crossing = [&](std::uint32_t a, std::uint32_t b) {
    const auto [low, high] = std::minmax(a, b);
    const double t = height(low) / (height(low) - height(high));
    return points.add(mesh.vertices[low] + t * (mesh.vertices[high] - mesh.vertices[low]));
  };
  std::vector<DirectedEdge> edges;
  for (const Face& face : mesh.faces) {
    std::optional<Point> down;  // where the face's border passes from before the slice to behind it
    std::optional<Point> up;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = face.vertices[k];
      const std::uint32_t b = face.vertices[(k + 1) % 3];
      if ((height(a) < 0.0) == (height(b) < 0.0)) continue;
      (height(a) < 0.0 ? up : down) = crossing(a, b);
    }
    if (!down || !up) continue;
    if (is_seen_from_behind(plane)) std::swap(down, up);
    edges.emplace_back(*down, *up);
  }
  std::optional<CrossSection> section = section_from(edges, points);
  if (!section) throw InputError("the slice at a port is not made of closed curves");
  return std::move(*section);
}

}  // namespace plat::buildings
