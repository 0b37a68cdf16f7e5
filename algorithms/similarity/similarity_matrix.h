#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/parallel.h"
#include "core/progress.h"
#include "similarity/candidate_search.h"
#include "similarity/labelled_shape.h"
#include "similarity/prepared_shapes.h"
#include "similarity/shape_similarity.h"
#include "similarity/weighted_k_means.h"

namespace plat::similarity {

/// Which distances are kept for each row, where not all of a cluster are.
struct MatrixPruning {
  AnyShapeSimilarity cheap;  ///< chooses them
  std::uint32_t keep = 50;   ///< per row
};

/// What a matrix is a function of.
struct MatrixInputs {
  std::span<const LabelledShape> shapes;
  const Clusters& clusters;  ///< of these shapes
  AnyShapeSimilarity measure;
  std::optional<MatrixPruning> pruning{};
};

enum class MatrixLayout : std::uint8_t {
  kSquares = 1,    ///< per cluster all ordered pairs
  kTriangles = 2,  ///< per cluster all unordered pairs, of a measure that is symmetric
  kNearest = 3,    ///< per shape those that pruning keeps
};

/// Why there is no distance, or that there is one.
enum class EntryState {
  kComputed,
  kOtherCluster,  ///< the two are not in one cluster
  kPruned,        ///< not among those kept
  kFailed,        ///< one of the two cannot be prepared
};

/// Distances between the shapes of each cluster. The row is the place, the column is the candidate:
/// entry (place, candidate) is measure.distance(candidate, place), rounded to a float; of
/// kTriangles it is distance(the larger index, the smaller one) for both, as symmetry holds up to
/// rounding.
///
/// Memory layout. A cluster's members are those that the measure can prepare, by index; r and c are
/// the places of two of them among the m members. `entries` holds, cluster after cluster:
///   kSquares    m x m floats, row r at r * m, the diagonal 0;
///   kTriangles  m (m - 1) / 2 floats: rows r = 0, 1, ..., of each c = r + 1 .. m - 1;
///               (r, c) is at r * m - r (r + 1) / 2 + (c - r - 1);
///   kNearest    per shape, by index, min(keep, m - 1) floats, and in `columns` whose they are, by
///               index; nothing for a shape that failed.
/// `first_entry` says where each cluster (kNearest: each shape) begins; its last is the end.
///
/// Guarantees: 1. every entry is the float next to what the measure says, asked in that order;  2.
/// pruned: the entries of a row are those of the `keep` members that are nearest by the cheap
/// measure, among equals the lower index; nothing is promised of those left out;  3. no shape is
/// dropped silently: a pair without distance says why;  4. the same bytes for any number of
/// threads. Paper: [ABVA08, Sec. 5 and 6]
struct SimilarityMatrix {
  MatrixLayout layout = MatrixLayout::kSquares;
  std::uint32_t keep = 0;                           ///< of kNearest
  std::vector<std::uint32_t> cluster_of;            ///< per shape
  std::vector<ShapeFailure> failures;               ///< by shape
  std::vector<std::vector<std::uint32_t>> members;  ///< per cluster
  std::vector<std::uint32_t> rank;                  ///< per shape its place among the members
  std::vector<std::uint64_t> first_entry;
  std::vector<std::uint32_t> columns;
  std::vector<float> entries;

  [[nodiscard]] std::size_t size() const { return cluster_of.size(); }
  [[nodiscard]] EntryState state(std::uint32_t place, std::uint32_t candidate) const;
  /// None where state() is not kComputed.
  [[nodiscard]] std::optional<double> distance(std::uint32_t place, std::uint32_t candidate) const;
  /// The entries of a row but for the place itself: nearest first, among equals the lower index.
  [[nodiscard]] std::vector<Candidate> nearest(std::uint32_t place, std::size_t count) const;
};

/// kNearest with pruning, else kTriangles where the measure claims to be symmetric, else kSquares.
MatrixLayout layout_of(const MatrixInputs& inputs);

/// Everything but the distances, which are 0: where each will be. `columns` is of the right size.
/// @param clusters  how many there are; some may have no member left
SimilarityMatrix matrix_frame(std::vector<std::uint32_t> cluster_of, std::size_t clusters,
                              std::vector<ShapeFailure> failures, MatrixLayout layout,
                              std::uint32_t keep);

/// Compares the shapes of each cluster, once.
/// Complexity: per cluster of m members m^2 distances (half where symmetric); with pruning m^2
/// cheap ones and keep m.
SimilarityMatrix compute_matrix(const MatrixInputs& inputs, Jobs jobs = {},
                                Progress::Style style = Progress::Style::kQuiet);

/// The share of the full matrix's nearest `count` per row that the pruned one has, 0..1: the mean
/// over rows with at least one other member. Pre: of the same clusters.
double recall_01(const SimilarityMatrix& pruned, const SimilarityMatrix& full, std::size_t count);

}  // namespace plat::similarity
