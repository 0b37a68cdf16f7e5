#include "similarity/similarity_matrix.h"

#include <algorithm>
#include <utility>

#include "core/failure.h"
#include "similarity/matrix_rows_internal.h"

namespace plat::similarity {
namespace {

using detail::columns_of;
using detail::entry_value;
using detail::has_failed;
using detail::PreparedInputs;

std::uint64_t triangle_offset(std::uint64_t m, std::uint64_t r, std::uint64_t c) {
  return r * m - r * (r + 1) / 2 + (c - r - 1);
}

/// Where the entry of two different members of a cluster is; none where it is pruned.
std::optional<std::uint64_t> entry_of(const SimilarityMatrix& matrix, std::uint32_t place,
                                      std::uint32_t candidate) {
  const std::uint32_t cluster = matrix.cluster_of[place];
  const std::uint64_t m = matrix.members[cluster].size();
  std::uint64_t r = matrix.rank[place];
  std::uint64_t c = matrix.rank[candidate];
  switch (matrix.layout) {
    case MatrixLayout::kSquares:
      return matrix.first_entry[cluster] + r * m + c;
    case MatrixLayout::kTriangles:
      if (r > c) std::swap(r, c);
      return matrix.first_entry[cluster] + triangle_offset(m, r, c);
    case MatrixLayout::kNearest: {
      const auto begin =
          matrix.columns.begin() + static_cast<std::ptrdiff_t>(matrix.first_entry[place]);
      const auto end =
          matrix.columns.begin() + static_cast<std::ptrdiff_t>(matrix.first_entry[place + 1]);
      const auto it = std::lower_bound(begin, end, candidate);
      if (it == end || *it != candidate) return std::nullopt;
      return static_cast<std::uint64_t>(it - matrix.columns.begin());
    }
  }
  throw LogicError("a layout without a rule");
}

std::uint64_t entries_of_cluster(MatrixLayout layout, std::uint64_t m) {
  return layout == MatrixLayout::kSquares ? m * m : m * (m - (m > 0 ? 1 : 0)) / 2;
}

/// Writes what belongs to one row, and nothing else.
void write_row(SimilarityMatrix& matrix, const MatrixInputs& inputs, const PreparedInputs& prepared,
               std::uint32_t place) {
  if (matrix.layout == MatrixLayout::kNearest) {
    std::uint64_t entry = matrix.first_entry[place];
    for (const std::uint32_t column : columns_of(matrix, inputs, prepared, place)) {
      matrix.columns[entry] = column;
      matrix.entries[entry++] = entry_value(matrix.layout, inputs, prepared, place, column);
    }
    return;
  }
  for (const std::uint32_t candidate : matrix.members[matrix.cluster_of[place]]) {
    if (candidate > place || (candidate < place && matrix.layout == MatrixLayout::kSquares))
      matrix.entries[*entry_of(matrix, place, candidate)] =
          entry_value(matrix.layout, inputs, prepared, place, candidate);
  }
}

}  // namespace

EntryState SimilarityMatrix::state(std::uint32_t place, std::uint32_t candidate) const {
  expects(place < size() && candidate < size(), "shapes of the matrix");
  if (has_failed(*this, place) || has_failed(*this, candidate)) return EntryState::kFailed;
  if (cluster_of[place] != cluster_of[candidate]) return EntryState::kOtherCluster;
  if (place == candidate || entry_of(*this, place, candidate)) return EntryState::kComputed;
  return EntryState::kPruned;
}

std::optional<double> SimilarityMatrix::distance(std::uint32_t place,
                                                 std::uint32_t candidate) const {
  if (state(place, candidate) != EntryState::kComputed) return std::nullopt;
  if (place == candidate) return 0.0;
  return static_cast<double>(entries[*entry_of(*this, place, candidate)]);
}

std::vector<Candidate> SimilarityMatrix::nearest(std::uint32_t place, std::size_t count) const {
  expects(place < size(), "a shape of the matrix");
  std::vector<Candidate> row;
  if (has_failed(*this, place)) return row;
  for (const std::uint32_t i : members[cluster_of[place]]) {
    if (i == place) continue;
    if (const auto entry = entry_of(*this, place, i))
      row.push_back({i, static_cast<double>(entries[*entry])});
  }
  const std::size_t wanted = std::min(count, row.size());
  std::partial_sort(row.begin(), row.begin() + static_cast<std::ptrdiff_t>(wanted), row.end(),
                    is_nearer);
  row.resize(wanted);
  return row;
}

MatrixLayout layout_of(const MatrixInputs& inputs) {
  if (inputs.pruning) return MatrixLayout::kNearest;
  return inputs.measure.claims().is_symmetric ? MatrixLayout::kTriangles : MatrixLayout::kSquares;
}

SimilarityMatrix matrix_frame(std::vector<std::uint32_t> cluster_of, std::size_t clusters,
                              std::vector<ShapeFailure> failures, MatrixLayout layout,
                              std::uint32_t keep) {
  SimilarityMatrix out;
  out.layout = layout;
  out.keep = layout == MatrixLayout::kNearest ? keep : 0;
  out.cluster_of = std::move(cluster_of);
  out.failures = std::move(failures);
  out.members.resize(clusters);
  out.rank.resize(out.size(), 0);
  for (std::uint32_t i = 0; i < out.size(); ++i) {
    auto& members = out.members[out.cluster_of[i]];
    if (has_failed(out, i)) continue;
    out.rank[i] = static_cast<std::uint32_t>(members.size());
    members.push_back(i);
  }
  out.first_entry.push_back(0);
  if (layout == MatrixLayout::kNearest) {
    for (std::uint32_t i = 0; i < out.size(); ++i) {
      const std::uint64_t others =
          has_failed(out, i) ? 0 : out.members[out.cluster_of[i]].size() - 1;
      out.first_entry.push_back(out.first_entry.back() + std::min<std::uint64_t>(keep, others));
    }
    out.columns.resize(out.first_entry.back());
  } else {
    for (const auto& members : out.members)
      out.first_entry.push_back(out.first_entry.back() +
                                entries_of_cluster(layout, members.size()));
  }
  out.entries.resize(out.first_entry.back(), 0.0F);
  return out;
}

SimilarityMatrix compute_matrix(const MatrixInputs& inputs, Jobs jobs, Progress::Style style) {
  const auto& [shapes, clusters, measure, pruning] = inputs;
  expects(clusters.cluster_of.size() == shapes.size(), "a cluster per shape");
  const PreparedInputs prepared = detail::prepare_inputs(inputs, jobs);
  SimilarityMatrix matrix =
      matrix_frame(clusters.cluster_of, clusters.members.size(), prepared.failures,
                   layout_of(inputs), pruning ? pruning->keep : 0);
  Progress progress("similarity of shapes", shapes.size(), style);
  parallel_for(shapes.size(), jobs, [&](std::size_t i) {
    const auto place = static_cast<std::uint32_t>(i);
    if (!has_failed(matrix, place)) write_row(matrix, inputs, prepared, place);
    progress.step();
  });
  return matrix;
}

double recall_01(const SimilarityMatrix& pruned, const SimilarityMatrix& full, std::size_t count) {
  expects(pruned.cluster_of == full.cluster_of, "matrices of the same clusters");
  double sum = 0.0;
  std::size_t rows = 0;
  for (std::uint32_t i = 0; i < full.size(); ++i) {
    const std::vector<Candidate> wanted = full.nearest(i, count);
    if (wanted.empty()) continue;
    const auto found = std::count_if(wanted.begin(), wanted.end(), [&](const Candidate& candidate) {
      return pruned.distance(i, candidate.shape).has_value();
    });
    sum += static_cast<double>(found) / static_cast<double>(wanted.size());
    ++rows;
  }
  return rows == 0 ? 1.0 : sum / static_cast<double>(rows);
}

}  // namespace plat::similarity
