#pragma once

#include <cstddef>
#include <cstdint>
#include <tuple>
#include <vector>

#include "core/options.h"
#include "similarity/shape_neighbourhood.h"
#include "similarity/shape_similarity.h"

namespace plat::similarity {

/// When shapes are merged with their neighbours, and how often [ABVA08, Sec. 5].
struct MergeOptions {
  double max_area_ratio = 10.0;  ///< of larger over smaller: beyond, nothing is merged
  double stop_area_ratio = 1.2;  ///< a union this much larger than the other side grows no further
  int max_shapes = 6;            ///< in a union
  int max_unions = 200;          ///< that are looked at
  static constexpr auto fields() {
    using O = MergeOptions;
    return std::tuple{
        Field{"max_area_ratio", &O::max_area_ratio, 1.0, 1e6,
              "Shapes whose areas differ by a larger factor are not merged."},
        Field{"stop_area_ratio", &O::stop_area_ratio, 1.0, 1e3,
              "A union larger than the other side by this factor grows no further."},
        Field{"max_shapes", &O::max_shapes, 1, 100, "Most shapes in a union."},
        Field{"max_unions", &O::max_unions, 1, 1e6, "Most unions that are looked at."}};
  }
};

/// One of a pair, or a union that grew from it.
struct MergedSide {
  std::vector<std::uint32_t> shapes;  ///< indices in the neighbourhood, ascending
  LabelledShape shape;                ///< their union
};

/// The best match of a shape, or of a union that it is part of, with another.
struct MergedComparison {
  MergedSide a;
  MergedSide b;
  ShapeComparison comparison;       ///< of a.shape with b.shape
  std::size_t unions_compared = 0;  ///< besides the pair itself
  std::size_t unions_refused = 0;   ///< not simple, or refused by the measure
  bool is_complete = true;          ///< false where max_unions ended the search
};

/// Compares two shapes, and the larger one with unions of the smaller one and its neighbours: one
/// tile for many, or many for one.
///
/// The smaller is merged with each adjacent shape in turn, and the union again, until it is
/// `stop_area_ratio` times as large as the larger; a union that is more than `max_area_ratio` times
/// as large is not compared, and where the two differ by more than that from the beginning nothing
/// is merged. The least distance is the answer; of equal ones the first: fewer shapes, then lower
/// indices.
///
/// Guarantees: 1. the distance is at most that of the pair;  2. a union is connected by edges,
/// holds the shape that it grew from, and is looked at once;  3. it has the area of its shapes
/// together, and their labels along its outline (union_of);  4. where both are of one
/// neighbourhood, no union holds the other shape.
/// @param a, b  indices in their neighbourhoods, which may be the same object
/// Failures: what the measure says of `a` or `b`
/// Complexity: at most max_unions unions and comparisons
/// Paper:      [ABVA08, Sec. 5], "similarity between 1-to-many tiles"
/// Deviation:  both ratios are options, the paper names none; unions are searched by number of
///             shapes, so that max_unions leaves out the largest
Expected<MergedComparison> compare_merged(const AnyShapeSimilarity& measure,
                                          const ShapeNeighbourhood& a_side, std::uint32_t a,
                                          const ShapeNeighbourhood& b_side, std::uint32_t b,
                                          const MergeOptions& options);

}  // namespace plat::similarity
