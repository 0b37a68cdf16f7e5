#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/failure.h"
#include "core/parallel.h"
#include "similarity/labelled_shape.h"
#include "similarity/shape_similarity.h"

namespace plat::similarity {

/// A shape that the measure cannot prepare, and why.
struct ShapeFailure {
  std::uint32_t shape = 0;  ///< index
  Failure failure;
};

struct PreparedShapes {
  std::vector<std::optional<AnyPreparedShape>> shapes;  ///< in order; none: it failed
  std::vector<ShapeFailure> failures;                   ///< by shape
};

/// Prepares every shape; the same result for any number of threads.
PreparedShapes prepare_all(std::span<const LabelledShape> shapes, const AnyShapeSimilarity& measure,
                           Jobs jobs = {});

}  // namespace plat::similarity
