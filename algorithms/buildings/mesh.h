#pragma once

#include <array>
#include <cmath>
#include <compare>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace plat::buildings {

/// A point or a vector of space, metres, z up.
struct Point3 {
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;

  friend bool operator==(const Point3&, const Point3&) = default;
  friend std::partial_ordering operator<=>(const Point3&, const Point3&) = default;
};

constexpr Point3 operator+(Point3 a, Point3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
constexpr Point3 operator-(Point3 a, Point3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
constexpr Point3 operator*(double s, Point3 a) { return {s * a.x, s * a.y, s * a.z}; }
constexpr double dot(Point3 a, Point3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr Point3 cross(Point3 a, Point3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(Point3 a) { return std::sqrt(dot(a, a)); }

struct Material {
  std::string name;
  std::array<std::uint8_t, 3> rgb{200, 200, 200};

  friend bool operator==(const Material&, const Material&) = default;
};

/// A triangle, counter-clockwise seen from outside.
struct Face {
  std::array<std::uint32_t, 3> vertices{};
  std::uint32_t material = 0;
  /// Where the face lies in the cut plane of a port: the port's place in Part::ports. Such faces
  /// are the caps, which go where two parts with the same section meet.
  std::optional<std::uint32_t> port;

  friend bool operator==(const Face&, const Face&) = default;
};

/// Triangles with shared vertices; `materials` is not empty where there are faces.
struct Mesh {
  std::vector<Point3> vertices;
  std::vector<Face> faces;
  std::vector<Material> materials;

  friend bool operator==(const Mesh&, const Mesh&) = default;
};

enum class MeshDefectKind {
  kBadIndex,     ///< a face names a vertex or a material that is not there
  kDegenerate,   ///< a face has two equal vertices
  kOpen,         ///< an edge has one face
  kNotManifold,  ///< an edge has more than two faces, or a vertex more than one fan
  kNotOriented,  ///< two faces walk an edge in the same direction
  kInsideOut,    ///< the volume is not positive
};

struct MeshDefect {
  MeshDefectKind kind;
  std::string message;  ///< one line, with the place
};

/// Why `mesh` does not bound a solid: nullopt where it is closed, a 2-manifold, consistently
/// oriented, and of positive volume. The first defect in the order of MeshDefectKind.
std::optional<MeshDefect> find_defect(const Mesh& mesh);

/// Signed, positive where the faces look outwards.
double volume_m3(const Mesh& mesh);
double area_m2(const Mesh& mesh, const Face& face);
/// Twice the area along the outward normal.
Point3 normal(const Mesh& mesh, const Face& face);

/// The point on a grid of 2^-16 m, which mesh files hold exactly up to 128 m: they are made of
/// floats.
Point3 as_stored(Point3 p);

/// Appends `other` (its own vertices, not welded); materials of the same name and colour become
/// one. Port tags are kept.
void append(Mesh& mesh, const Mesh& other);

/// Leaves the materials that faces have, in the order in which faces first have them.
void drop_unused_materials(Mesh& mesh);

/// Reads OBJ, PLY or OFF, by the file's ending. Polygons are split into triangles. Face colours
/// become materials; where the file has none, there is one material "default".
/// @throws InputError with the file and the reason
Mesh read_mesh(const std::filesystem::path& file);

/// Writes OBJ (with the colours in FILE.mat beside it), PLY or OFF, by the file's ending, with face
/// colours and 12 significant digits; port tags are not written.
/// @throws InputError with the file and the reason
void write_mesh(const std::filesystem::path& file, const Mesh& mesh);

}  // namespace plat::buildings
