#include "buildings/solids.h"

#include <array>
#include <cmath>
#include <numbers>

namespace plat::buildings {
namespace {

std::uint32_t add_vertex(Mesh& mesh, Point3 p) {
  mesh.vertices.push_back(p);
  return static_cast<std::uint32_t>(mesh.vertices.size() - 1);
}

void add_face(Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c,
              std::uint32_t material) {
  Face& face = mesh.faces.emplace_back();
  face.vertices = {a, b, c};
  face.material = material;
}

/// Quads and convex rings need no middle vertex.
void add_cap(Mesh& mesh, std::uint32_t first, std::size_t count, bool is_top,
             std::uint32_t material) {
  const auto n = static_cast<std::uint32_t>(count);
  for (std::uint32_t i = 1; i + 1 < n; ++i) {
    if (is_top) {
      add_face(mesh, first, first + i, first + i + 1, material);
    } else {
      add_face(mesh, first, first + i + 1, first + i, material);
    }
  }
}

}  // namespace

void add_loft(Mesh& mesh, std::span<const std::vector<Point3>> rings,
              std::span<const std::uint32_t> band_materials, std::uint32_t cap_material) {
  const auto base = static_cast<std::uint32_t>(mesh.vertices.size());
  const auto n = static_cast<std::uint32_t>(rings.front().size());
  for (const std::vector<Point3>& ring : rings) {
    for (const Point3 p : ring) add_vertex(mesh, p);
  }
  for (std::uint32_t band = 0; band + 1 < rings.size(); ++band) {
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t low = base + band * n;
      const std::uint32_t next = (i + 1) % n;
      add_face(mesh, low + i, low + next, low + n + next, band_materials[band]);
      add_face(mesh, low + i, low + n + next, low + n + i, band_materials[band]);
    }
  }
  add_cap(mesh, base, n, false, cap_material);
  add_cap(mesh, base + static_cast<std::uint32_t>(rings.size() - 1) * n, n, true, cap_material);
}

void add_prism(Mesh& mesh, std::span<const Point> ring, double low_m, double high_m,
               std::uint32_t material) {
  std::array<std::vector<Point3>, 2> rings;
  for (const Point p : ring) {
    rings[0].push_back({p.x, p.y, low_m});
    rings[1].push_back({p.x, p.y, high_m});
  }
  const std::array<std::uint32_t, 1> bands{material};
  add_loft(mesh, rings, bands, material);
}

void add_box(Mesh& mesh, const Box3& box, std::uint32_t material) {
  const std::array<Point, 4> ring{Point{box.low.x, box.low.y}, Point{box.high.x, box.low.y},
                                  Point{box.high.x, box.high.y}, Point{box.low.x, box.high.y}};
  add_prism(mesh, ring, box.low.z, box.high.z, material);
}

void add_column(Mesh& mesh, Point at, double radius_m, double low_m, double high_m, int sides,
                std::uint32_t material) {
  std::vector<Point> ring;
  for (int i = 0; i < sides; ++i) {
    const double angle_rad = 2.0 * std::numbers::pi * i / sides;
    ring.push_back(at + radius_m * Point{std::cos(angle_rad), std::sin(angle_rad)});
  }
  add_prism(mesh, ring, low_m, high_m, material);
}

void add_lying_prism(Mesh& mesh, std::span<const Point> profile, Point3 from, Point3 to,
                     Point3 across, std::uint32_t material) {
  std::array<std::vector<Point3>, 2> rings;
  for (const Point p : profile) {
    const Point3 offset = p.x * across + Point3{0, 0, p.y};
    rings[0].push_back(to + offset);
    rings[1].push_back(from + offset);
  }
  const std::array<std::uint32_t, 1> bands{material};
  add_loft(mesh, rings, bands, material);
}

}  // namespace plat::buildings
