#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/box.h"
#include "core/polygon.h"
#include "imagery/box_grid.h"

namespace plat::imagery {

/// What a surface is made of: how its colour varies from pixel to pixel.
enum class Material : std::uint8_t {
  kSoil,
  kGrass,
  kMeadow,
  kAsphalt,
  kConcrete,
  kGravel,
  kPaint,
  kFlatRoof,
  kPitchedRoof,
  kWater,
  kMetal,
  kCount
};

/// A colour before light, shadow and texture, 0..1 a channel.
struct Tint {
  double red = 0.0;
  double green = 0.0;
  double blue = 0.0;
};

constexpr Tint operator*(double s, Tint t) { return {s * t.red, s * t.green, s * t.blue}; }
constexpr Tint mix(Tint a, Tint b, double t) {
  return {a.red + t * (b.red - a.red), a.green + t * (b.green - a.green),
          a.blue + t * (b.blue - a.blue)};
}

/// One surface seen from above: a region, or a line of some width with round ends.
struct Shape {
  std::vector<Ring> rings;    ///< of a region: outer and holes; of a line: one open chain
  double line_width_m = 0.0;  ///< 0: a region
  Tint tint;
  Material material = Material::kSoil;
  double height_m = 0.0;  ///< of the surface above the ground: casts a shadow
};

/// How far a crown's ragged edge may reach, as a multiple of its radius.
inline constexpr double kCrownReach = 1.3;

struct Tree {
  Point place;
  double radius_m = 0.0;
  double height_m = 0.0;
  Tint tint;
  std::uint32_t variation = 0;  ///< which part of the noise its crown has
};

/// What the orthophoto shows, as a painter has it: later shapes cover earlier ones, trees cover
/// shapes.
class Scene {
 public:
  /// What lies beneath everything, and beyond the map.
  void set_ground(Tint tint, Material material);
  void add(Shape shape);
  void add(const Tree& tree);
  /// Finds things near a place from now on. Call it once, after everything was added.
  void index();

  [[nodiscard]] const Shape& ground() const { return ground_; }
  [[nodiscard]] const std::vector<Shape>& shapes() const { return shapes_; }
  [[nodiscard]] const std::vector<Tree>& trees() const { return trees_; }
  /// Those whose box meets `box`, in painter's order.
  [[nodiscard]] std::vector<std::uint32_t> shapes_near(const Box& box) const;
  [[nodiscard]] std::vector<std::uint32_t> trees_near(const Box& box) const;
  /// The height of the highest thing whose box meets `box`, metres.
  [[nodiscard]] double highest_m(const Box& box) const;
  [[nodiscard]] double highest_m() const { return highest_m_; }

 private:
  Shape ground_;  ///< without a ring
  std::vector<Shape> shapes_;
  std::vector<Tree> trees_;
  BoxGrid shape_grid_;
  BoxGrid tree_grid_;
  double highest_m_ = 0.0;
};

/// A filled polygon.
Shape region(const Polygon& polygon, Tint tint, Material material, double height_m = 0.0);
Shape region(Ring ring, Tint tint, Material material, double height_m = 0.0);
Shape line(Polyline points, double width_m, Tint tint, Material material);

/// The rectangle about `center` with half extents along the unit vector `along` and across it.
Ring rectangle(Point center, Point along, double half_length_m, double half_width_m);

}  // namespace plat::imagery
