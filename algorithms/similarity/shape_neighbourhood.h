#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/failure.h"
#include "similarity/labelled_shape.h"

namespace plat::similarity {

/// Shapes, and which of them have an edge in common: tiles of a block, parcels of a city.
///
/// Two shapes are neighbours where an edge of one is an edge of the other, in reverse, with the
/// same end points to the last bit.
class ShapeNeighbourhood {
 public:
  /// Complexity: O(n log n) of all edges
  explicit ShapeNeighbourhood(std::vector<LabelledShape> shapes);

  [[nodiscard]] const std::vector<LabelledShape>& shapes() const { return shapes_; }
  [[nodiscard]] const LabelledShape& shape(std::uint32_t index) const { return shapes_.at(index); }
  /// Ascending, without the shape itself.
  [[nodiscard]] std::span<const std::uint32_t> neighbours(std::uint32_t index) const {
    return neighbours_.at(index);
  }

 private:
  std::vector<LabelledShape> shapes_;
  std::vector<std::vector<std::uint32_t>> neighbours_;
};

/// The union of shapes that share edges, exactly: an edge that two of them have, in opposite
/// directions, is taken out, and what is left is the boundary.
///
/// Guarantees: 1. the area is the sum of the areas;  2. every edge of the outer ring keeps its
/// label; of shapes of which some have no labels, those edges are unknown; where none has any, nor
/// has the union;  3. no vertex is added, moved or taken away but those between cancelled
/// edges;  4. the outer ring begins with its lexicographically first vertex: the order of the
/// shapes does not matter. The zone is the one with the largest area among those known, the first
/// by name if two have it.
///
/// Failures: kNotSimple where the union is in pieces or touches itself in a point; kTilesOverlap
/// where two shapes have an edge in the same direction or the rings cross.
///
/// Complexity: O(n log n)
Expected<LabelledShape> union_of(std::span<const LabelledShape* const> shapes);

}  // namespace plat::similarity
