#include "buildings/mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace plat::buildings {
namespace {

/// The half-edge from -> to of a face; sorted by its undirected edge.
struct HalfEdge {
  std::uint32_t from = 0;
  std::uint32_t to = 0;
  std::size_t face = 0;

  [[nodiscard]] std::pair<std::uint32_t, std::uint32_t> edge() const {
    return std::minmax({from, to});
  }
};

std::string place_of(const Mesh& mesh, std::uint32_t vertex) {
  const Point3 p = mesh.vertices[vertex];
  return fmt::format("({:.3f}, {:.3f}, {:.3f})", p.x, p.y, p.z);
}

std::optional<MeshDefect> find_bad_face(const Mesh& mesh) {
  for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
    const auto& [a, b, c] = mesh.faces[i].vertices;
    if (std::max({a, b, c}) >= mesh.vertices.size() ||
        mesh.faces[i].material >= mesh.materials.size())
      return MeshDefect{MeshDefectKind::kBadIndex,
                        fmt::format("face {} names a vertex or material that is not there", i)};
    if (a == b || b == c || c == a)
      return MeshDefect{
          MeshDefectKind::kDegenerate,
          fmt::format("face {} has a vertex twice, at {}", i, place_of(mesh, a == b ? a : c))};
  }
  return std::nullopt;
}

std::vector<HalfEdge> sorted_half_edges(const Mesh& mesh) {
  std::vector<HalfEdge> out;
  out.reserve(3 * mesh.faces.size());
  for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
    const auto& v = mesh.faces[i].vertices;
    for (std::size_t k = 0; k < 3; ++k) out.push_back({v[k], v[(k + 1) % 3], i});
  }
  std::ranges::sort(out, [](const HalfEdge& a, const HalfEdge& b) {
    return std::pair(a.edge(), a.face) < std::pair(b.edge(), b.face);
  });
  return out;
}

/// Calls `visit(first, last)` for the half-edges of every undirected edge.
template <class Visit>
void for_each_edge_group(const std::vector<HalfEdge>& half_edges, Visit visit) {
  for (auto first = half_edges.begin(); first != half_edges.end();) {
    const auto last = std::find_if(first, half_edges.end(), [&](const HalfEdge& half_edge) {
      return half_edge.edge() != first->edge();
    });
    visit(first, last);
    first = last;
  }
}

/// The first bad edge, by kind: open before crowded before walked twice in one direction.
std::optional<MeshDefect> find_bad_edge(const Mesh& mesh, const std::vector<HalfEdge>& half_edges) {
  std::optional<MeshDefect> found;
  for_each_edge_group(half_edges, [&](auto first, auto last) {
    const auto count = last - first;
    std::optional<MeshDefectKind> kind;
    if (count == 1) kind = MeshDefectKind::kOpen;
    if (count > 2) kind = MeshDefectKind::kNotManifold;
    if (count == 2 && first->from == (first + 1)->from) kind = MeshDefectKind::kNotOriented;
    if (!kind || (found && found->kind <= *kind)) return;
    found = MeshDefect{*kind,
                       fmt::format("the edge {} - {} has {} face{}{}", place_of(mesh, first->from),
                                   place_of(mesh, first->to), count, count == 1 ? "" : "s",
                                   count == 2 ? " that look to different sides" : "")};
  });
  return found;
}

/// A vertex where the faces form more than one fan. Pre: every edge has two faces, both ways.
std::optional<MeshDefect> find_bad_vertex(const Mesh& mesh,
                                          const std::vector<HalfEdge>& half_edges) {
  // Faces that share an edge at a vertex are one fan: union by (face, corner), counted per vertex.
  std::vector<std::size_t> parent(3 * mesh.faces.size());
  for (std::size_t i = 0; i < parent.size(); ++i) parent[i] = i;
  const auto root = [&](std::size_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  const auto corner = [&](std::size_t face, std::uint32_t vertex) {
    const auto& v = mesh.faces[face].vertices;
    return 3 * face + static_cast<std::size_t>(std::ranges::find(v, vertex) - v.begin());
  };
  for_each_edge_group(half_edges, [&](auto first, auto) {
    const HalfEdge& other = *(first + 1);
    for (const std::uint32_t vertex : {first->from, first->to})
      parent[root(corner(first->face, vertex))] = root(corner(other.face, vertex));
  });
  std::vector<std::size_t> fan_of(mesh.vertices.size(), parent.size());
  for (std::size_t i = 0; i < parent.size(); ++i) {
    const std::uint32_t vertex = mesh.faces[i / 3].vertices[i % 3];
    if (fan_of[vertex] == parent.size()) fan_of[vertex] = root(i);
    if (fan_of[vertex] != root(i))
      return MeshDefect{
          MeshDefectKind::kNotManifold,
          fmt::format("more than one fan of faces meets at {}", place_of(mesh, vertex))};
  }
  return std::nullopt;
}

}  // namespace

std::optional<MeshDefect> find_defect(const Mesh& mesh) {
  if (auto defect = find_bad_face(mesh)) return defect;
  const std::vector<HalfEdge> half_edges = sorted_half_edges(mesh);
  if (auto defect = find_bad_edge(mesh, half_edges)) return defect;
  if (auto defect = find_bad_vertex(mesh, half_edges)) return defect;
  const double volume = volume_m3(mesh);
  if (volume > 0.0) return std::nullopt;
  return MeshDefect{MeshDefectKind::kInsideOut, fmt::format("the volume is {} m3", volume)};
}

double volume_m3(const Mesh& mesh) {
  if (mesh.vertices.empty()) return 0.0;
  const Point3 origin = mesh.vertices.front();  // near the faces, so that no digits are lost
  double sum = 0.0;
  for (const Face& face : mesh.faces) {
    const auto& [a, b, c] = face.vertices;
    sum +=
        dot(mesh.vertices[a] - origin, cross(mesh.vertices[b] - origin, mesh.vertices[c] - origin));
  }
  return sum / 6.0;
}

Point3 normal(const Mesh& mesh, const Face& face) {
  const auto& [a, b, c] = face.vertices;
  return cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a]);
}

double area_m2(const Mesh& mesh, const Face& face) { return 0.5 * length(normal(mesh, face)); }

Point3 as_stored(Point3 p) {
  constexpr double kUnitsPerMetre = 65536.0;
  const auto round = [](double v) { return std::floor(v * kUnitsPerMetre + 0.5) / kUnitsPerMetre; };
  return {round(p.x), round(p.y), round(p.z)};
}

void append(Mesh& mesh, const Mesh& other) {
  const auto first_vertex = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
  std::vector<std::uint32_t> material_of;
  for (const Material& material : other.materials) {
    const auto at = std::ranges::find(mesh.materials, material);
    material_of.push_back(static_cast<std::uint32_t>(at - mesh.materials.begin()));
    if (at == mesh.materials.end()) mesh.materials.push_back(material);
  }
  for (Face face : other.faces) {
    for (std::uint32_t& vertex : face.vertices) vertex += first_vertex;
    face.material = material_of[face.material];
    mesh.faces.push_back(face);
  }
}

void drop_unused_materials(Mesh& mesh) {
  const auto unseen = static_cast<std::uint32_t>(mesh.materials.size());
  std::vector<std::uint32_t> new_index(mesh.materials.size(), unseen);
  std::vector<Material> used;
  for (Face& face : mesh.faces) {
    std::uint32_t& index = new_index[face.material];
    if (index == unseen) {
      index = static_cast<std::uint32_t>(used.size());
      used.push_back(mesh.materials[face.material]);
    }
    face.material = index;
  }
  mesh.materials = std::move(used);
}

}  // namespace plat::buildings
