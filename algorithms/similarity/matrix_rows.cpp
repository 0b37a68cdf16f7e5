#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/failure.h"
#include "similarity/matrix_rows_internal.h"

namespace plat::similarity::detail {
namespace {

/// Failures of both measures: a shape is compared where both can prepare it.
std::vector<ShapeFailure> joined(const std::vector<ShapeFailure>& a,
                                 const std::vector<ShapeFailure>& b) {
  std::vector<ShapeFailure> out = a;
  out.insert(out.end(), b.begin(), b.end());
  std::stable_sort(out.begin(), out.end(),
                   [](const ShapeFailure& x, const ShapeFailure& y) { return x.shape < y.shape; });
  out.erase(
      std::unique(out.begin(), out.end(),
                  [](const ShapeFailure& x, const ShapeFailure& y) { return x.shape == y.shape; }),
      out.end());
  return out;
}

}  // namespace

PreparedInputs prepare_inputs(const MatrixInputs& inputs, Jobs jobs) {
  PreparedInputs out;
  out.measured = prepare_all(inputs.shapes, inputs.measure, jobs);
  if (inputs.pruning) out.cheap = prepare_all(inputs.shapes, inputs.pruning->cheap, jobs);
  out.failures = joined(out.measured.failures, out.cheap.failures);
  return out;
}

bool has_failed(const SimilarityMatrix& matrix, std::uint32_t shape) {
  const auto& failures = matrix.failures;
  const auto it =
      std::lower_bound(failures.begin(), failures.end(), shape,
                       [](const ShapeFailure& f, std::uint32_t s) { return f.shape < s; });
  return it != failures.end() && it->shape == shape;
}

std::vector<std::uint32_t> columns_of(const SimilarityMatrix& frame, const MatrixInputs& inputs,
                                      const PreparedInputs& prepared, std::uint32_t place) {
  const auto& cheap = prepared.cheap.shapes;
  std::vector<Candidate> others;
  for (const std::uint32_t i : frame.members[frame.cluster_of[place]]) {
    if (i != place) others.push_back({i, inputs.pruning->cheap.distance(*cheap[i], *cheap[place])});
  }
  if (others.size() > frame.keep) {
    std::nth_element(others.begin(), others.begin() + frame.keep, others.end(), is_nearer);
    others.resize(frame.keep);
  }
  std::vector<std::uint32_t> columns(others.size());
  std::transform(others.begin(), others.end(), columns.begin(),
                 [](const Candidate& c) { return c.shape; });
  std::sort(columns.begin(), columns.end());
  return columns;
}

float entry_value(MatrixLayout layout, const MatrixInputs& inputs, const PreparedInputs& prepared,
                  std::uint32_t place, std::uint32_t candidate) {
  if (layout == MatrixLayout::kTriangles && candidate < place) std::swap(place, candidate);
  const auto& shapes = prepared.measured.shapes;
  const auto distance =
      static_cast<float>(inputs.measure.distance(*shapes[candidate], *shapes[place]));
  expects(std::isfinite(distance) && distance >= 0.0F, "a distance is finite, not negative");
  return distance;
}

}  // namespace plat::similarity::detail
