#include "buildings/assembly.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>

#include "buildings/joint_surface.h"
#include "core/failure.h"
#include "core/working_grid.h"

namespace plat::buildings {
namespace {

using VertexId = std::uint32_t;
using DirectedEdge = std::pair<VertexId, VertexId>;

/// An edge of a part where a cap was, or where the mesh is open at a port.
struct RimEdge {
  /// The face that remains; none where the caps of two ports touch: the two rim edges, one each
  /// way, are then all that remains.
  std::optional<std::size_t> face;
  VertexId from = 0;  ///< in the direction of that face
  VertexId to = 0;
  std::size_t port = 0;
};

bool lies_in(const CutPlane& plane, Point3 p) {
  return std::abs(dot(p - plane.origin, plane.outward)) <= kCapTolerance_m;
}

/// The rim of a part at all its ports.
std::vector<RimEdge> rim_of(const Part& part) {
  std::map<DirectedEdge, std::size_t> face_of;
  const auto& faces = part.mesh.faces;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    for (std::size_t i = 0; i < 3; ++i)
      face_of[{faces[f].vertices[i], faces[f].vertices[(i + 1) % 3]}] = f;
  }
  std::vector<RimEdge> rim;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    for (std::size_t i = 0; i < 3; ++i) {
      const VertexId from = faces[f].vertices[i];
      const VertexId to = faces[f].vertices[(i + 1) % 3];
      const auto twin = face_of.find({to, from});
      if (faces[f].port) {
        const auto other = twin == face_of.end() ? std::nullopt : faces[twin->second].port;
        if (other && *other != *faces[f].port)
          rim.push_back({std::nullopt, to, from, *faces[f].port});
        continue;
      }
      if (twin != face_of.end()) {
        if (faces[twin->second].port) rim.push_back({f, from, to, *faces[twin->second].port});
        continue;
      }
      for (std::size_t p = 0; p < part.ports.size(); ++p) {
        const CutPlane plane = cut_plane(part.ports[p]);
        if (lies_in(plane, part.mesh.vertices[from]) && lies_in(plane, part.mesh.vertices[to]))
          rim.push_back({f, from, to, p});
      }
    }
  }
  return rim;
}

/// Assembles one building; one building, one use.
class Assembler {
 public:
  Assembler(const PlacedBuilding& building, const PartDatabase& database)
      : building_(building), database_(database) {
    rims_.resize(building.parts.size());
    for (std::size_t i = 0; i < building.parts.size(); ++i) {
      const Part& part = part_at(i);
      auto known = rim_cache_.find(building.parts[i].part);
      if (known == rim_cache_.end())
        known = rim_cache_.emplace(building.parts[i].part, rim_of(part)).first;
      rims_[i] = known->second;
      chains_.emplace_back(rims_[i].size());
    }
  }

  AssembledBuilding assemble() {
    for (std::size_t j = 0; j < building_.joints.size(); ++j) close(j);
    for (std::size_t i = 0; i < building_.parts.size(); ++i) add_part(i);
    merge_vertices();
    return std::move(out_);
  }

 private:
  [[nodiscard]] const Part& part_at(std::size_t placed) const {
    return database_.parts()[building_.parts[placed].part];
  }

  /// The vertex of a joint at a point of its plane.
  VertexId joint_vertex(std::size_t joint, Point at) {
    const auto [known, is_new] =
        joint_vertices_.try_emplace({joint, at}, static_cast<VertexId>(out_.mesh.vertices.size()));
    if (is_new) {
      const CutPlane& plane = building_.joints[joint].plane;
      out_.mesh.vertices.push_back(plane.origin + at.x * plane.across + at.y * plane.up);
    }
    return known->second;
  }

  /// Where a vertex of a port lies in the plane of its joint: the port's own coordinates, turned
  /// over where the joint's axes run the other way.
  [[nodiscard]] Point in_joint(PlacedPort at, const CutPlane& joint, VertexId vertex) const {
    const Part& part = part_at(at.placed);
    const Port& port = part.ports[at.port];
    const CutPlane from = cut_plane(port);
    const PortTarget& target = building_.parts[at.placed].targets[at.port];
    const CutPlane to = cut_plane({port.role, target.origin, target.outward, port.arm_m, {}});
    const Point3 d = part.mesh.vertices[vertex] - from.origin;
    const double x = dot(to.across, joint.across) < 0.0 ? -1.0 : 1.0;
    const double y = dot(to.up, joint.up) < 0.0 ? -1.0 : 1.0;
    return {x * snap(dot(d, from.across)), y * snap(dot(d, from.up))};
  }

  /// Welds the two sides of a joint and closes what differs.
  void close(std::size_t j) {
    const Joint& joint = building_.joints[j];
    std::vector<Segment> rim;
    std::vector<std::pair<std::size_t, std::size_t>> source;  // placed part, index into its rim
    const auto add = [&](PlacedPort at) {
      for (std::size_t r = 0; r < rims_[at.placed].size(); ++r) {
        const RimEdge& edge = rims_[at.placed][r];
        if (edge.port != at.port) continue;
        rim.push_back({in_joint(at, joint.plane, edge.from), in_joint(at, joint.plane, edge.to)});
        source.emplace_back(at.placed, r);
      }
    };
    add(joint.before);
    if (joint.after) add(*joint.after);
    const JointSurface surface = joint_surface(rim);
    for (std::size_t i = 0; i < source.size(); ++i) {
      auto& chain = chains_[source[i].first][source[i].second];
      for (const Point at : surface.chains[i]) chain.push_back(joint_vertex(j, at));
    }
    for (const auto& [corners, is_outward] : surface.walls) {
      Face face;
      for (std::size_t i = 0; i < 3; ++i) face.vertices[i] = joint_vertex(j, corners[i]);
      if (!is_outward) std::swap(face.vertices[1], face.vertices[2]);
      face.material = cap_material(is_outward || !joint.after ? joint.before : *joint.after);
      out_.mesh.faces.push_back(face);
      if (joint.after)
        out_.wall_area_m2 += 0.5 * std::abs(orientation(corners[0], corners[1], corners[2]));
    }
  }

  std::uint32_t material(const Material& wanted) {
    auto& known = out_.mesh.materials;
    const auto at = std::ranges::find(known, wanted);
    if (at == known.end()) known.push_back(wanted);
    return static_cast<std::uint32_t>(std::ranges::find(known, wanted) - known.begin());
  }

  /// Of a port's cap; where it has none, of the part's first face.
  std::uint32_t cap_material(PlacedPort at) {
    const Mesh& mesh = part_at(at.placed).mesh;
    const auto cap = std::ranges::find(
        mesh.faces, std::optional(static_cast<std::uint32_t>(at.port)), &Face::port);
    return material(mesh.materials[(cap == mesh.faces.end() ? mesh.faces.front() : *cap).material]);
  }

  void add_part(std::size_t placed) {
    const Part& part = part_at(placed);
    const std::vector<Point3> fitted = fitted_vertices(part, building_.parts[placed]);
    std::vector<std::optional<VertexId>> id(fitted.size());
    std::map<std::size_t, std::vector<std::size_t>> rim_of_face;
    for (std::size_t r = 0; r < rims_[placed].size(); ++r) {
      const RimEdge& edge = rims_[placed][r];
      const auto& chain = chains_[placed][r];
      expects(!chain.empty(), "every port of a placed part is at a joint");
      for (const auto& [vertex, at] :
           {std::pair(edge.from, chain.front()), std::pair(edge.to, chain.back())}) {
        // Where two ports of a part touch, a vertex is at two joints.
        if (id[vertex] && *id[vertex] != at) same_.emplace_back(*id[vertex], at);
        id[vertex] = at;
      }
      if (edge.face) rim_of_face[*edge.face].push_back(r);
    }
    // One name for a vertex at two joints: faces find their rim edges by it.
    for (std::size_t r = 0; r < rims_[placed].size(); ++r) {
      chains_[placed][r].front() = *id[rims_[placed][r].from];
      chains_[placed][r].back() = *id[rims_[placed][r].to];
    }
    close_touching_caps(placed);
    for (std::size_t f = 0; f < part.mesh.faces.size(); ++f) {
      const Face& face = part.mesh.faces[f];
      if (face.port) continue;
      std::array<VertexId, 3> corners{};
      for (std::size_t i = 0; i < 3; ++i) {
        auto& known = id[face.vertices[i]];
        if (!known) {
          known = static_cast<VertexId>(out_.mesh.vertices.size());
          out_.mesh.vertices.push_back(fitted[face.vertices[i]]);
        }
        corners[i] = *known;
      }
      const auto rims = rim_of_face.find(f);
      add_face(corners, rims == rim_of_face.end() ? std::vector<std::size_t>{} : rims->second,
               placed, material(part.mesh.materials[face.material]));
    }
  }

  /// Where the caps of two ports touch, the neighbours' points on one side of the edge are not on
  /// the other: faces without area join them.
  void close_touching_caps(std::size_t placed) {
    const auto& rims = rims_[placed];
    for (std::size_t r = 0; r < rims.size(); ++r) {
      for (std::size_t q = r + 1; q < rims.size(); ++q) {
        if (rims[r].face || rims[q].face) continue;
        if (rims[r].from != rims[q].to || rims[r].to != rims[q].from) continue;
        std::vector<VertexId> loop = chains_[placed][r];
        const auto& back = chains_[placed][q];
        for (std::size_t i = 1; i + 1 < back.size(); ++i) loop.push_back(back[i]);
        for (std::size_t i = 1; i + 1 < loop.size(); ++i)
          out_.mesh.faces.push_back({{loop[0], loop[i], loop[i + 1]}, 0, std::nullopt});
      }
    }
  }

  /// A face, cut up where a rim edge of it has points between its ends.
  void add_face(std::array<VertexId, 3> corners, const std::vector<std::size_t>& rims,
                std::size_t placed, std::uint32_t material) {
    std::vector<std::array<VertexId, 3>> pieces{corners};
    for (const std::size_t r : rims) {
      const auto& chain = chains_[placed][r];
      if (chain.size() < 3) continue;
      for (std::size_t p = 0; p < pieces.size(); ++p) {
        auto& piece = pieces[p];
        std::size_t i = 0;
        while (i < 3 && (piece[i] != chain.front() || piece[(i + 1) % 3] != chain.back())) ++i;
        if (i == 3) continue;
        const VertexId apex = piece[(i + 2) % 3];
        pieces.erase(pieces.begin() + static_cast<std::ptrdiff_t>(p));
        for (std::size_t c = 0; c + 1 < chain.size(); ++c)
          pieces.push_back({chain[c], chain[c + 1], apex});
        break;
      }
    }
    for (const auto& [a, b, c] : pieces) {
      // A face whose ends fell on one point of the grid takes no room.
      if (a == b || b == c || c == a) continue;
      out_.mesh.faces.push_back({{a, b, c}, material, std::nullopt});
    }
  }

  /// Makes one vertex of those that are the same, and leaves out those that no face has.
  void merge_vertices() {
    std::vector<VertexId> root(out_.mesh.vertices.size());
    std::iota(root.begin(), root.end(), VertexId{0});
    const auto find = [&](VertexId vertex) {
      while (root[vertex] != vertex) vertex = root[vertex] = root[root[vertex]];
      return vertex;
    };
    for (const auto& [a, b] : same_) {
      const VertexId one = find(a);
      const VertexId other = find(b);
      root[std::max(one, other)] = std::min(one, other);
    }
    std::vector<std::optional<VertexId>> kept(root.size());
    std::vector<Point3> vertices;
    for (Face& face : out_.mesh.faces) {
      for (VertexId& vertex : face.vertices) {
        auto& id = kept[find(vertex)];
        if (!id) {
          id = static_cast<VertexId>(vertices.size());
          vertices.push_back(out_.mesh.vertices[find(vertex)]);
        }
        vertex = *id;
      }
    }
    out_.mesh.vertices = std::move(vertices);
    std::erase_if(out_.mesh.faces, [](const Face& face) {
      const auto& [a, b, c] = face.vertices;
      return a == b || b == c || c == a;
    });
  }

  const PlacedBuilding& building_;
  const PartDatabase& database_;
  AssembledBuilding out_;
  std::vector<std::pair<VertexId, VertexId>> same_;
  std::map<std::size_t, std::vector<RimEdge>> rim_cache_;   ///< by part
  std::vector<std::vector<RimEdge>> rims_;                  ///< by placed part
  std::vector<std::vector<std::vector<VertexId>>> chains_;  ///< by placed part and rim edge
  std::map<std::pair<std::size_t, Point>, VertexId> joint_vertices_;
};

std::size_t count_shells(const Mesh& mesh) {
  std::vector<std::size_t> root(mesh.faces.size());
  std::iota(root.begin(), root.end(), std::size_t{0});
  const auto find = [&](std::size_t face) {
    while (root[face] != face) face = root[face] = root[root[face]];
    return face;
  };
  std::map<DirectedEdge, std::size_t> face_of;
  std::size_t count = mesh.faces.size();
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    for (std::size_t i = 0; i < 3; ++i) {
      const auto edge = std::minmax(mesh.faces[f].vertices[i], mesh.faces[f].vertices[(i + 1) % 3]);
      const auto [known, is_new] = face_of.try_emplace(edge, f);
      const std::size_t a = find(known->second);
      const std::size_t b = find(f);
      if (is_new || a == b) continue;
      root[b] = a;
      --count;
    }
  }
  return count;
}

}  // namespace

AssembledBuilding assemble(const PlacedBuilding& building, const PartDatabase& database) {
  return Assembler(building, database).assemble();
}

SurfaceReport inspect_surface(const Mesh& mesh) {
  SurfaceReport report{mesh.faces.size(), count_shells(mesh), 0, 0, volume_m3(mesh)};
  std::map<DirectedEdge, std::size_t> uses;
  for (const Face& face : mesh.faces) {
    for (std::size_t i = 0; i < 3; ++i) ++uses[{face.vertices[i], face.vertices[(i + 1) % 3]}];
  }
  for (const auto& [edge, count] : uses) {
    const auto back = uses.find({edge.second, edge.first});
    const std::size_t count_back = back == uses.end() ? 0 : back->second;
    if (count_back != count) ++report.unmatched_edge_count;
    if (count > 1 && edge.first < edge.second) ++report.shared_edge_count;
  }
  return report;
}

}  // namespace plat::buildings
