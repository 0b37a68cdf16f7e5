#pragma once

#include <cstdint>
#include <vector>

#include "core/parallel.h"
#include "similarity/prepared_shapes.h"
#include "similarity/similarity_matrix.h"

/// What a row of a matrix is a function of: said once, for computing and for checking a file.
namespace plat::similarity::detail {

/// The shapes of a matrix, prepared by its measures.
struct PreparedInputs {
  PreparedShapes measured;
  PreparedShapes cheap;                ///< by the cheap measure; nothing without pruning
  std::vector<ShapeFailure> failures;  ///< of both, once per shape, by shape
};

PreparedInputs prepare_inputs(const MatrixInputs& inputs, Jobs jobs);

bool has_failed(const SimilarityMatrix& matrix, std::uint32_t shape);

/// The members of the place's cluster that the cheap measure finds nearest, by index.
/// @param frame  its members and how many it keeps are looked at
/// Pre: pruning; the place has not failed.
std::vector<std::uint32_t> columns_of(const SimilarityMatrix& frame, const MatrixInputs& inputs,
                                      const PreparedInputs& prepared, std::uint32_t place);

/// What the matrix holds for two different shapes that have not failed. Triangles hold one number
/// for both orders, and it is of the larger index as the candidate: a measure is symmetric up to
/// rounding only.
float entry_value(MatrixLayout layout, const MatrixInputs& inputs, const PreparedInputs& prepared,
                  std::uint32_t place, std::uint32_t candidate);

}  // namespace plat::similarity::detail
