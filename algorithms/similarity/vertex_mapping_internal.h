#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "similarity/affine_vertex_similarity.h"

namespace plat::similarity::detail {

/// A choice of corners of one outline, laid on all corners of another: the k-th chosen one on
/// corner (k + offset) mod count.
struct VertexMapping {
  double error = std::numeric_limits<double>::infinity();
  std::uint32_t chosen = 0;
  std::size_t offset = 0;
  /// From the first outline's frame to that of the second, each about the mean of its mapped
  /// corners.
  Affine linear;
  Point from_mean;  ///< of the chosen corners, in the frame
  Point to_mean;
  bool is_least_squares = true;  ///< false where the affine map was given up
};

/// The mapping of least error, rules given up one by one where all are rejected.
/// Pre: from.count >= to.count >= 3; choices are found.
VertexMapping best_vertex_mapping(const CornerOutline& from, const CornerOutline& to,
                                  const AffineVertexSimilarity::Options& options);

/// The affine map that carries the first points to the second ones with the least sum of squared
/// distances; nullopt where the first ones lie on a line.
std::optional<Affine> least_squares_map(const std::vector<std::pair<Point, Point>>& pairs);

}  // namespace plat::similarity::detail
