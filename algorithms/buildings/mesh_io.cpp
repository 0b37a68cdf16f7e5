#include <fmt/format.h>

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <algorithm>
#include <mutex>

#include "buildings/mesh.h"
#include "core/failure.h"

namespace plat::buildings {
namespace {

struct MeshTraits : OpenMesh::DefaultTraitsDouble {
  using Color = OpenMesh::Vec3uc;
};
using HalfEdgeMesh = OpenMesh::PolyMesh_ArrayKernelT<MeshTraits>;

/// OpenMesh passes coordinates as floats; 9 significant digits tell any two floats apart, and 12
/// leave no doubt.
constexpr int kDigits = 12;

/// OpenMesh reports to global streams: keeps them off the console for the time of one call. (To
/// listen to them instead would leak, as they never free what is connected.)
class QuietOpenMesh {
 public:
  QuietOpenMesh() : lock_(mutex()) {
    for (OpenMesh::mostream* stream : streams()) stream->disable();
  }
  ~QuietOpenMesh() {
    for (OpenMesh::mostream* stream : streams()) stream->enable();
  }
  QuietOpenMesh(const QuietOpenMesh&) = delete;
  QuietOpenMesh& operator=(const QuietOpenMesh&) = delete;

 private:
  static std::mutex& mutex() {
    static std::mutex instance;
    return instance;
  }
  static std::array<OpenMesh::mostream*, 3> streams() { return {&omerr(), &omout(), &omlog()}; }

  std::lock_guard<std::mutex> lock_;
};

void expect_known_ending(const std::filesystem::path& file) {
  const std::string ending = file.extension().string();
  if (ending != ".obj" && ending != ".ply" && ending != ".off")
    throw InputError(
        fmt::format("{}: meshes are .obj, .ply or .off, not \"{}\"", file.string(), ending));
}

std::uint32_t material_of(Mesh& mesh, const OpenMesh::Vec3uc& color) {
  const std::array<std::uint8_t, 3> rgb{color[0], color[1], color[2]};
  const auto at = std::ranges::find(mesh.materials, rgb, &Material::rgb);
  const auto index = static_cast<std::uint32_t>(at - mesh.materials.begin());
  if (at == mesh.materials.end())
    mesh.materials.push_back({fmt::format("{:02x}{:02x}{:02x}", rgb[0], rgb[1], rgb[2]), rgb});
  return index;
}

/// Adds a polygon as a fan of triangles. @returns whether it is convex, so that the fan is its
/// region.
bool add_fan(Mesh& mesh, const std::vector<std::uint32_t>& ring, std::uint32_t material) {
  Point3 total;
  const std::size_t first = mesh.faces.size();
  for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
    Face& face = mesh.faces.emplace_back();
    face.vertices = {ring[0], ring[i], ring[i + 1]};
    face.material = material;
    total = total + normal(mesh, face);
  }
  return std::all_of(mesh.faces.begin() + static_cast<std::ptrdiff_t>(first), mesh.faces.end(),
                     [&](const Face& face) { return dot(normal(mesh, face), total) >= 0.0; });
}

Mesh from_openmesh(const HalfEdgeMesh& source, bool has_colors, const std::filesystem::path& file) {
  Mesh mesh;
  mesh.vertices.reserve(source.n_vertices());
  for (const auto vertex : source.vertices()) {
    const auto& p = source.point(vertex);
    if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2]))
      throw InputError(
          fmt::format("{}: vertex {} is not finite", file.string(), mesh.vertices.size()));
    mesh.vertices.push_back({p[0], p[1], p[2]});
  }
  if (!has_colors) mesh.materials.push_back({"default", {200, 200, 200}});
  for (const auto face : source.faces()) {
    std::vector<std::uint32_t> ring;
    for (const auto vertex : source.fv_ccw_range(face))
      ring.push_back(static_cast<std::uint32_t>(vertex.idx()));
    const std::uint32_t material = has_colors ? material_of(mesh, source.color(face)) : 0;
    if (!add_fan(mesh, ring, material))
      throw InputError(fmt::format("{}: face {} is not convex; split it into triangles",
                                   file.string(), face.idx()));
  }
  return mesh;
}

}  // namespace

Mesh read_mesh(const std::filesystem::path& file) {
  expect_known_ending(file);
  if (!std::filesystem::is_regular_file(file))
    throw InputError(fmt::format("{}: no such file", file.string()));
  HalfEdgeMesh source;
  source.request_face_colors();
  OpenMesh::IO::Options options = OpenMesh::IO::Options::FaceColor;
  {
    const QuietOpenMesh quiet;
    if (!OpenMesh::IO::read_mesh(source, file.string(), options))
      throw InputError(fmt::format("{}: cannot be read as a mesh: not a {} file, or cut off",
                                   file.string(), file.extension().string()));
  }
  if (source.n_faces() == 0) throw InputError(fmt::format("{}: has no faces", file.string()));
  return from_openmesh(source, options.face_has_color(), file);
}

void write_mesh(const std::filesystem::path& file, const Mesh& mesh) {
  expect_known_ending(file);
  HalfEdgeMesh target;
  target.request_face_colors();
  for (const Point3 p : mesh.vertices) target.add_vertex({p.x, p.y, p.z});
  for (const Face& face : mesh.faces) {
    std::array<HalfEdgeMesh::VertexHandle, 3> ring;
    for (std::size_t k = 0; k < 3; ++k)
      ring[k] = target.vertex_handle(static_cast<unsigned>(face.vertices[k]));
    const auto handle = target.add_face(ring[0], ring[1], ring[2]);
    if (!handle.is_valid())
      throw InputError(
          fmt::format("{}: not a 2-manifold, so that OpenMesh cannot hold it: face {} does not fit",
                      file.string(), &face - mesh.faces.data()));
    const auto& rgb = mesh.materials[face.material].rgb;
    target.set_color(handle, {rgb[0], rgb[1], rgb[2]});
  }
  const QuietOpenMesh quiet;
  if (!OpenMesh::IO::write_mesh(target, file.string(), OpenMesh::IO::Options::FaceColor, kDigits))
    throw InputError(fmt::format("{}: cannot be written; is the folder there, and open to writing?",
                                 file.string()));
}

}  // namespace plat::buildings
