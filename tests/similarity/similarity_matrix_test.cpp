#include "similarity/similarity_matrix.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/failure.h"
#include "made_measures.h"
#include "support/property.h"

namespace plat::similarity {
namespace {

using testing::clusters_of_rectangles;
using testing::made_measure;
using testing::random_rectangles;
using testing::rectangle;

/// By width alone: what pruning chooses by.
AnyShapeSimilarity area_only() {
  return AnyShapeSimilarity(testing::MadeMeasure({.perimeter_weight = 0.0}));
}

struct Case {
  std::vector<LabelledShape> shapes;
  Clusters clusters;
};

Case random_case(Rng& rng, std::size_t most = 60) {
  Case out{random_rectangles(1 + rng.index(most), rng), {}};
  // A shape that no measure can prepare, here and there.
  for (LabelledShape& shape : out.shapes) {
    if (rng.uniform_01() < 0.05) shape = rectangle(0.0, 10.0);
  }
  out.clusters = clusters_of_rectangles(out.shapes, 1 + rng.index(6), rng());
  return out;
}

double said(const AnyShapeSimilarity& measure, const LabelledShape& candidate,
            const LabelledShape& place) {
  return static_cast<float>(measure.distance(*measure.prepare(candidate), *measure.prepare(place)));
}

TEST(SimilarityMatrix, EveryEntryIsWhatTheMeasureSaysOrSaysWhyThereIsNone) {
  Rng rng = ::plat::testing::property_rng("SimilarityMatrixEntries");
  int computed = 0;
  int failed = 0;
  for (int round = 0; round < ::plat::testing::iterations(40); ++round) {
    const Case c = random_case(rng);
    const AnyShapeSimilarity measure = made_measure(round % 2);
    const SimilarityMatrix matrix = compute_matrix({c.shapes, c.clusters, measure});
    EXPECT_EQ(matrix.layout, round % 2 == 1 ? MatrixLayout::kSquares : MatrixLayout::kTriangles);
    for (std::uint32_t a = 0; a < c.shapes.size(); ++a) {
      for (std::uint32_t b = 0; b < c.shapes.size(); ++b) {
        const bool has_failed = !measure.prepare(c.shapes[a]) || !measure.prepare(c.shapes[b]);
        const bool is_together = c.clusters.cluster_of[a] == c.clusters.cluster_of[b];
        ASSERT_EQ(matrix.state(a, b), has_failed     ? EntryState::kFailed
                                      : !is_together ? EntryState::kOtherCluster
                                                     : EntryState::kComputed);
        ASSERT_EQ(matrix.distance(a, b).has_value(), !has_failed && is_together);
        failed += has_failed ? 1 : 0;
        if (has_failed || !is_together) continue;
        ASSERT_EQ(*matrix.distance(a, b), said(measure, c.shapes[b], c.shapes[a]));
        ++computed;
      }
    }
  }
  EXPECT_GT(computed, 2000);
  EXPECT_GT(failed, 200);
}

TEST(SimilarityMatrix, LaysSquaresAndTrianglesOutAsSaid) {
  const std::vector<LabelledShape> shapes{rectangle(10, 10), rectangle(10, 40), rectangle(10, 11),
                                          rectangle(10, 13), rectangle(10, 41)};
  const Clusters clusters{{0, 1, 0, 0, 1}, {{0, 2, 3}, {1, 4}}};
  const auto squares = compute_matrix({shapes, clusters, made_measure(1.0)});
  EXPECT_EQ(squares.first_entry, (std::vector<std::uint64_t>{0, 9, 13}));
  // Areas 100, 110, 130: the larger one as a candidate costs its difference once more.
  EXPECT_EQ(squares.entries, (std::vector<float>{0, 22, 66, 12, 0, 44, 36, 24, 0, 0, 22, 12, 0}));
  const auto triangles = compute_matrix({shapes, clusters, made_measure()});
  EXPECT_EQ(triangles.first_entry, (std::vector<std::uint64_t>{0, 3, 4}));
  EXPECT_EQ(triangles.entries, (std::vector<float>{12, 36, 24, 12}));
}

TEST(SimilarityMatrix, PrunedRowsHoldTheNearestByTheCheapMeasure) {
  Rng rng = ::plat::testing::property_rng("SimilarityMatrixPruned");
  int pruned_entries = 0;
  for (int round = 0; round < ::plat::testing::iterations(40); ++round) {
    const Case c = random_case(rng);
    const AnyShapeSimilarity measure = made_measure(1.0);
    const auto keep = static_cast<std::uint32_t>(1 + rng.index(8));
    const auto matrix =
        compute_matrix({c.shapes, c.clusters, measure, MatrixPruning{area_only(), keep}});
    const auto cheap = compute_matrix({c.shapes, c.clusters, area_only()});
    EXPECT_EQ(matrix.layout, MatrixLayout::kNearest);
    for (std::uint32_t place = 0; place < c.shapes.size(); ++place) {
      std::vector<std::uint32_t> kept;
      for (std::uint32_t other = 0; other < c.shapes.size(); ++other) {
        if (other == place || matrix.state(place, other) != EntryState::kComputed) {
          pruned_entries += matrix.state(place, other) == EntryState::kPruned ? 1 : 0;
          continue;
        }
        kept.push_back(other);
        EXPECT_EQ(*matrix.distance(place, other), said(measure, c.shapes[other], c.shapes[place]));
      }
      std::vector<std::uint32_t> nearest;
      for (const Candidate& candidate : cheap.nearest(place, keep))
        nearest.push_back(candidate.shape);
      std::sort(nearest.begin(), nearest.end());
      EXPECT_EQ(kept, nearest);
    }
  }
  EXPECT_GT(pruned_entries, 1000);
}

TEST(SimilarityMatrix, NearestIsTheSortedRow) {
  Rng rng = ::plat::testing::property_rng("SimilarityMatrixNearest");
  for (int round = 0; round < ::plat::testing::iterations(20); ++round) {
    const Case c = random_case(rng);
    const auto matrix = compute_matrix({c.shapes, c.clusters, made_measure(1.0)});
    for (std::uint32_t place = 0; place < c.shapes.size(); ++place) {
      std::vector<Candidate> row;
      for (std::uint32_t other = 0; other < c.shapes.size(); ++other) {
        if (other != place && matrix.distance(place, other))
          row.push_back({other, *matrix.distance(place, other)});
      }
      std::stable_sort(row.begin(), row.end(), [](const Candidate& a, const Candidate& b) {
        return a.distance < b.distance;
      });
      row.resize(std::min<std::size_t>(row.size(), 5));
      EXPECT_EQ(matrix.nearest(place, 5), row);
    }
  }
}

TEST(SimilarityMatrix, ListsFailuresWithTheirReason) {
  const std::vector<LabelledShape> shapes{rectangle(10, 10), rectangle(0, 5), rectangle(3, 3)};
  const Clusters clusters{{0, 0, 0}, {{0, 1, 2}}};
  const auto matrix = compute_matrix({shapes, clusters, made_measure()});
  ASSERT_EQ(matrix.failures.size(), 1U);
  EXPECT_EQ(matrix.failures[0].shape, 1U);
  EXPECT_EQ(matrix.failures[0].failure.code, FailureCode::kTooSmall);
  EXPECT_TRUE(matrix.nearest(1, 3).empty());
  EXPECT_EQ(matrix.nearest(0, 3).size(), 1U);
}

TEST(SimilarityMatrix, IsTheSameForAnyNumberOfThreads) {
  Rng rng = ::plat::testing::property_rng("SimilarityMatrixThreads");
  const Case c = random_case(rng, 400);
  for (const bool is_pruned : {false, true}) {
    MatrixInputs inputs{c.shapes, c.clusters, made_measure(1.0)};
    if (is_pruned) inputs.pruning = MatrixPruning{area_only(), 7};
    const auto one = compute_matrix(inputs, Jobs{1});
    const auto two = compute_matrix(inputs, Jobs{2});
    EXPECT_EQ(one.entries, two.entries);
    EXPECT_EQ(one.columns, two.columns);
  }
}

TEST(SimilarityMatrix, RecallIsTheShareOfTheNearestThatPruningLeft) {
  const std::vector<LabelledShape> shapes{rectangle(10, 10), rectangle(10, 12), rectangle(1, 101)};
  const Clusters clusters{{0, 0, 0}, {{0, 1, 2}}};
  const auto full = compute_matrix({shapes, clusters, made_measure()});
  // By area the third is nearest to the first (100, 120, 101), by both the second is.
  const auto pruned =
      compute_matrix({shapes, clusters, made_measure(), MatrixPruning{area_only(), 1}});
  EXPECT_DOUBLE_EQ(recall_01(full, full, 2), 1.0);
  EXPECT_DOUBLE_EQ(recall_01(pruned, full, 2), 0.5);
  EXPECT_FALSE(pruned.distance(0, 1));
  EXPECT_LT(recall_01(pruned, full, 1), 1.0);
}

TEST(SimilarityMatrix, RefusesADistanceThatIsNotFinite) {
  const std::vector<LabelledShape> shapes{rectangle(1e20, 1e20), rectangle(1, 1)};
  const Clusters clusters{{0, 0}, {{0, 1}}};
  EXPECT_THROW((void)compute_matrix({shapes, clusters, made_measure()}), LogicError);
}

}  // namespace
}  // namespace plat::similarity
