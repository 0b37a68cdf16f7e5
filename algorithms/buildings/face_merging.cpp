#include "buildings/face_merging.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "blocks/geos_internal.h"
#include "buildings/ring_chaining_internal.h"

namespace plat::buildings {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// A region that cannot be triangulated anew keeps its triangles and all its vertices, and its
/// neighbours must know: a few rounds, as failures are rare.
constexpr int kMaxRounds = 8;
/// Share of a region's area by which its new triangles may miss it: rounding only.
constexpr double kAreaTolerance = 1e-9;
/// A new triangle thinner than this would be a line.
constexpr double kMinTriangle_m2 = 1e-10;

/// A plane, and its coordinates without the axis along which the plane is steepest: exact, as two
/// of the three coordinates are taken as they are.
struct Plane {
  Point3 point;
  Point3 normal;  ///< unit

  [[nodiscard]] bool has(Point3 p) const {
    return std::abs(dot(p - point, normal)) <= kSamePlane_m;
  }
  [[nodiscard]] Point flat(Point3 p) const {
    const double x = std::abs(normal.x);
    const double y = std::abs(normal.y);
    const double z = std::abs(normal.z);
    Point out;
    double sign = normal.z;
    if (x >= y && x >= z) {
      out = {p.y, p.z};
      sign = normal.x;
    } else if (y >= z) {
      out = {p.z, p.x};
      sign = normal.y;
    } else {
      out = {p.x, p.y};
    }
    return sign > 0.0 ? out : Point{out.y, out.x};
  }
};

class FaceMerging {
 public:
  explicit FaceMerging(const Mesh& mesh) : mesh_(mesh), is_kept_(mesh.vertices.size(), false) {
    find_regions();
    find_borders();
  }

  Mesh merged() {
    std::vector<std::vector<Face>> faces(regions_.size());
    for (int round = 0; round < kMaxRounds; ++round) {
      bool is_done = true;
      for (std::size_t i = 0; i < regions_.size(); ++i) {
        std::optional<std::vector<Face>> result = triangulated(i);
        if (!result) {
          keep_all_vertices(i);
          is_done = false;
        } else {
          faces[i] = std::move(*result);
        }
      }
      if (is_done) return with_faces(faces);
    }
    return mesh_;
  }

 private:
  struct Region {
    std::vector<std::size_t> faces;
    Plane plane;
    std::vector<Edge> border;
    bool is_left_alone = false;
  };

  void find_regions() {
    std::map<Edge, std::vector<std::size_t>> faces_at;
    for (std::size_t i = 0; i < mesh_.faces.size(); ++i) {
      for_each_edge(
          i, [&](Edge edge) { faces_at[std::minmax(edge.first, edge.second)].push_back(i); });
    }
    region_of_.assign(mesh_.faces.size(), mesh_.faces.size());
    for (std::size_t seed = 0; seed < mesh_.faces.size(); ++seed) {
      if (region_of_[seed] != mesh_.faces.size()) continue;
      const std::size_t index = regions_.size();
      Region& region = regions_.emplace_back();
      const Point3 across = normal(mesh_, mesh_.faces[seed]);
      region.plane = {mesh_.vertices[mesh_.faces[seed].vertices[0]],
                      (1.0 / length(across)) * across};
      region.faces.push_back(seed);
      region_of_[seed] = index;
      for (std::size_t at = 0; at < region.faces.size(); ++at) {
        for_each_edge(region.faces[at], [&](Edge edge) {
          const auto& neighbours = faces_at[std::minmax(edge.first, edge.second)];
          if (neighbours.size() != 2) return;
          for (const std::size_t other : neighbours) {
            if (region_of_[other] != mesh_.faces.size() || !belongs(other, seed, region.plane))
              continue;
            region_of_[other] = index;
            region.faces.push_back(other);
          }
        });
      }
    }
  }

  template <class Visit>
  void for_each_edge(std::size_t face, Visit visit) const {
    const auto& v = mesh_.faces[face].vertices;
    for (std::size_t k = 0; k < 3; ++k) visit(Edge{v[k], v[(k + 1) % 3]});
  }

  [[nodiscard]] bool belongs(std::size_t face, std::size_t seed, const Plane& plane) const {
    const Face& candidate = mesh_.faces[face];
    return candidate.material == mesh_.faces[seed].material &&
           candidate.port == mesh_.faces[seed].port &&
           dot(normal(mesh_, candidate), plane.normal) > 0.0 &&
           std::ranges::all_of(candidate.vertices,
                               [&](std::uint32_t v) { return plane.has(mesh_.vertices[v]); });
  }

  /// The edges where regions meet; and which vertices turn there, or belong to more than two of
  /// them.
  void find_borders() {
    std::vector<std::vector<std::uint32_t>> next(mesh_.vertices.size());
    std::vector<std::vector<std::uint32_t>> previous(mesh_.vertices.size());
    for (Region& region : regions_) {
      std::vector<Edge> edges;
      for (const std::size_t face : region.faces)
        for_each_edge(face, [&](Edge edge) { edges.push_back(edge); });
      std::ranges::sort(edges);
      for (const Edge& edge : edges) {
        if (std::ranges::binary_search(edges, Edge{edge.second, edge.first})) continue;
        region.border.push_back(edge);
        next[edge.first].push_back(edge.second);
        previous[edge.second].push_back(edge.first);
      }
    }
    for (std::size_t v = 0; v < next.size(); ++v)
      is_kept_[v] = !is_straight(v, next[v], previous[v]);
  }

  /// Two regions that pass a vertex along one straight line, each the other way.
  [[nodiscard]] bool is_straight(std::size_t v, const std::vector<std::uint32_t>& next,
                                 const std::vector<std::uint32_t>& previous) const {
    if (next.empty()) return true;  // inside a region
    if (next.size() != 2 || previous.size() != 2 || next[0] == next[1]) return false;
    if (!std::ranges::is_permutation(next, previous)) return false;
    const Point3 a = mesh_.vertices[next[0]];
    const Point3 b = mesh_.vertices[next[1]];
    const Point3 to = mesh_.vertices[v] - a;
    const double along = dot(to, b - a) / dot(b - a, b - a);
    return along > 0.0 && along < 1.0 && length(to - along * (b - a)) <= kSamePlane_m;
  }

  void keep_all_vertices(std::size_t region) {
    regions_[region].is_left_alone = true;
    for (const std::size_t face : regions_[region].faces)
      for (const std::uint32_t v : mesh_.faces[face].vertices) is_kept_[v] = true;
  }

  [[nodiscard]] std::vector<Face> original_faces(const Region& region) const {
    std::vector<Face> out;
    for (const std::size_t face : region.faces) out.push_back(mesh_.faces[face]);
    return out;
  }

  /// nullopt where GEOS finds no triangulation of just these vertices.
  std::optional<std::vector<Face>> triangulated(std::size_t index) {
    const Region& region = regions_[index];
    const bool is_small =
        region.faces.size() == 1 || (region.faces.size() == 2 && region.border.size() == 4);
    const bool keeps_all = std::ranges::all_of(
        region.border, [&](const Edge& edge) { return bool(is_kept_[edge.first]); });
    if (region.is_left_alone || (is_small && keeps_all)) return original_faces(region);
    std::map<Point, std::uint32_t> vertex_at;
    std::vector<detail::DirectedEdge> edges;
    for (const auto& [from, to] : region.border) {
      const Point a = region.plane.flat(mesh_.vertices[from]);
      vertex_at[a] = from;
      edges.emplace_back(a, region.plane.flat(mesh_.vertices[to]));
    }
    std::optional<std::vector<Ring>> rings = detail::chain_rings(edges);
    if (!rings) return std::nullopt;
    for (Ring& ring : *rings) {
      std::erase_if(ring, [&](Point p) { return !is_kept_[vertex_at.at(p)]; });
      if (ring.size() < 3) return std::nullopt;
    }
    std::vector<Face> out;
    for (const Polygon& polygon : detail::regions_of(std::move(*rings))) {
      if (!add_triangles(polygon, vertex_at, mesh_.faces[region.faces.front()], out))
        return std::nullopt;
    }
    return out;
  }

  bool add_triangles(const Polygon& polygon, const std::map<Point, std::uint32_t>& vertex_at,
                     const Face& like, std::vector<Face>& out) {
    const auto shape = geos_.from(polygon);
    const auto triangles =
        geos_.own(GEOSConstrainedDelaunayTriangulation_r(geos_.context(), shape.get()));
    std::size_t expected = polygon.outer.size() - 2;
    for (const Ring& hole : polygon.holes) expected += hole.size() + 2;
    const std::vector<Polygon> found = geos_.polygons_of(triangles.get());
    double area = 0.0;
    for (const Polygon& triangle : found) {
      if (triangle.outer.size() != 3 || area_m2(triangle) < kMinTriangle_m2) return false;
      area += area_m2(triangle);
      Face& face = out.emplace_back(like);
      for (std::size_t k = 0; k < 3; ++k) {
        const auto at = vertex_at.find(triangle.outer[k]);
        if (at == vertex_at.end()) return false;
        face.vertices[k] = at->second;
      }
    }
    return found.size() == expected &&
           std::abs(area - area_m2(polygon)) <= kAreaTolerance * area_m2(polygon);
  }

  [[nodiscard]] Mesh with_faces(const std::vector<std::vector<Face>>& faces) const {
    Mesh out;
    out.materials = mesh_.materials;
    std::vector<std::uint32_t> new_index(mesh_.vertices.size(),
                                         static_cast<std::uint32_t>(mesh_.vertices.size()));
    for (const std::vector<Face>& region : faces) {
      for (Face face : region) {
        for (std::uint32_t& v : face.vertices) {
          if (new_index[v] == mesh_.vertices.size()) {
            new_index[v] = static_cast<std::uint32_t>(out.vertices.size());
            out.vertices.push_back(mesh_.vertices[v]);
          }
          v = new_index[v];
        }
        out.faces.push_back(face);
      }
    }
    return out;
  }

  const Mesh& mesh_;
  blocks::detail::Geos geos_;
  std::vector<Region> regions_;
  std::vector<std::size_t> region_of_;
  std::vector<bool> is_kept_;
};

}  // namespace

Mesh merge_faces(const Mesh& mesh) {
  if (mesh.faces.empty()) return mesh;
  return FaceMerging(mesh).merged();
}

}  // namespace plat::buildings
