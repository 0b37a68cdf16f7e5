#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "buildings/mesh.h"

namespace plat::buildings {

/// An axis-aligned box, metres.
struct Box3 {
  Point3 low;
  Point3 high;
};

/// A solid made of boxes that are filled and carved out one after the other, as on a grid whose
/// lines are the sides of all boxes.
///
/// Guarantees: 1. its surface is closed and consistently oriented, with no vertex inside an edge of
/// another face;
/// 2. 2-manifold, where no two of its cells touch in an edge or a corner alone.
class CellSolid {
 public:
  using Placement = std::function<Point3(Point3)>;

  /// Later boxes take the place of earlier ones. Boxes without volume do nothing.
  void fill(const Box3& box, std::uint32_t material);
  void carve(const Box3& box);

  /// A grid line at this coordinate, though no box ends there.
  void add_x(double x) { extra_x_.push_back(x); }
  void add_y(double y) { extra_y_.push_back(y); }
  /// All grid lines, ascending.
  [[nodiscard]] std::vector<double> xs() const;
  [[nodiscard]] std::vector<double> ys() const;

  /// The surface, every vertex moved by `place`; a four-sided face that `place` bends is split
  /// along the diagonal that is nearer to where `place` puts its middle. The mesh has no materials
  /// yet.
  [[nodiscard]] Mesh surface(const Placement& place) const;

 private:
  struct Step {
    Box3 box;
    std::uint32_t cell = 0;  ///< what the cells become: 0 empty, else 1 + material
  };
  std::vector<Step> steps_;
  std::vector<double> extra_x_;
  std::vector<double> extra_y_;
};

}  // namespace plat::buildings
