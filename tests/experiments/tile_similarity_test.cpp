#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "core/validity.h"
#include "harness/tile_shapes.h"
#include "support/property.h"
#include "tile_similarity/block_statistics.h"
#include "tile_similarity/perturbation.h"
#include "tile_similarity/retrieval.h"

namespace plat::tile_similarity {
namespace {

using similarity::EdgeLabel;
using similarity::LabelledShape;

LabelledShape rectangle(double width, double height) {
  return {{{{0, 0}, {width, 0}, {width, height}, {0, height}}, {}},
          {EdgeLabel::kStreet, EdgeLabel::kProperty, EdgeLabel::kProperty, EdgeLabel::kProperty},
          ""};
}

TEST(EdgeLabels, AnEdgeIsAStreetWhereHalfOfItIsFront) {
  const Ring ring{{0, 0}, {10, 0}, {10, 20}, {0, 20}};
  const std::vector<Segment> fronts{{{0, 0}, {10, 0}}, {{10, 0}, {10, 9}}, {{0, 12}, {0, 0}}};
  EXPECT_EQ(harness::edge_labels(ring, fronts),
            (std::vector<EdgeLabel>{EdgeLabel::kStreet, EdgeLabel::kProperty, EdgeLabel::kProperty,
                                    EdgeLabel::kStreet}));
}

TEST(Perturbation, GivesValidShapesWithALabelPerEdge) {
  Rng rng = testing::property_rng("PerturbationValid");
  for (const Perturbation& how : perturbations()) {
    for (int round = 0; round < 50; ++round) {
      const auto out = perturbed(rectangle(25, 12), how, rng);
      ASSERT_TRUE(out) << how.name;
      EXPECT_FALSE(find_ogc_defect(out->polygon));
      EXPECT_EQ(out->edges.size(), out->polygon.outer.size());
      EXPECT_EQ(out->polygon.outer.size(),
                4 + static_cast<std::size_t>(how.added) - static_cast<std::size_t>(how.dropped));
    }
  }
}

TEST(Perturbation, AddedVerticesLieOnEdgesAndKeepTheirLabels) {
  Rng rng = testing::property_rng("PerturbationAdded");
  const auto out = perturbed(rectangle(25, 12), {.name = "added", .added = 3}, rng);
  ASSERT_TRUE(out);
  EXPECT_NEAR(area_m2(out->polygon), 300.0, 0.1);
  double street_m = 0.0;
  for (std::size_t i = 0; i < out->edges.size(); ++i) {
    if (out->edges[i] == EdgeLabel::kStreet)
      street_m +=
          distance(out->polygon.outer[i], out->polygon.outer[(i + 1) % out->polygon.outer.size()]);
  }
  EXPECT_NEAR(street_m, 25.0, 0.01);
}

TEST(Perturbation, ATriangleCannotLoseAVertex) {
  Rng rng(1);
  const LabelledShape triangle{{{{0, 0}, {9, 0}, {0, 9}}, {}}, {}, ""};
  EXPECT_FALSE(perturbed(triangle, {.name = "dropped", .dropped = 1}, rng));
}

TEST(BlockMean, IsOverQueriesAndItsIntervalOverBlocks) {
  const std::vector<std::uint32_t> blocks{7, 7, 3, 9};
  const std::vector<std::optional<double>> values{1.0, 0.0, 1.0, std::nullopt};
  const auto sums = block_sums(blocks, values);
  ASSERT_EQ(sums.size(), 2U);
  const auto mean = block_mean(sums, 200, 1);
  ASSERT_TRUE(mean);
  EXPECT_DOUBLE_EQ(mean->mean, 2.0 / 3.0);
  EXPECT_EQ(mean->queries, 3U);
  EXPECT_EQ(mean->blocks, 2U);
  EXPECT_DOUBLE_EQ(mean->interval.low, 0.5);
  EXPECT_DOUBLE_EQ(mean->interval.high, 1.0);
  EXPECT_FALSE(block_mean({}, 200, 1));
}

TEST(BlockDifference, TellsABetterSideFromAnEqualOne) {
  std::vector<BlockSum> good(30, {9.0, 10.0});
  std::vector<BlockSum> bad(30, {3.0, 10.0});
  const auto found = block_difference(good, bad, 200, 999, 1);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->difference, 0.6, 1e-12);
  EXPECT_DOUBLE_EQ(found->p_value, 0.001);
  EXPECT_DOUBLE_EQ(found->effect_size, 1.0);
  EXPECT_DOUBLE_EQ(block_difference(good, good, 200, 999, 1)->p_value, 1.0);
}

TEST(Retrieval, CopiesAreFoundFirstByAMeasureThatCanAndCountedOnce) {
  TileGallery gallery;
  for (int i = 0; i < 30; ++i) {
    gallery.shapes.push_back(rectangle(10.0 + i, 80.0 - i));
    gallery.ids.push_back(std::to_string(i));
    gallery.blocks.push_back(static_cast<std::uint32_t>(i / 10));
    gallery.shapes.back().zone = i < 15 ? "a" : "";
  }
  gallery.queries = {2, 20};
  SimilarityConfig config;
  const auto measure = similarity::shape_similarities().make("box");
  const MeasureResult one = run_retrieval(gallery, measure, config, "made", Jobs{1});
  const MeasureResult two = run_retrieval(gallery, measure, config, "made", Jobs{2});
  ASSERT_EQ(one.tasks.size(), 2 + perturbations().size());
  for (std::size_t t = 0; t < one.tasks.size(); ++t) {
    for (std::size_t q = 0; q < 2; ++q)
      EXPECT_EQ(one.tasks[t].queries[q].at_10, two.tasks[t].queries[q].at_10);
  }
  // Zone "a" is known of the first query alone; 14 of 29 others are of it.
  EXPECT_NEAR(*one.tasks[0].queries[0].chance, 14.0 / 29.0, 1e-12);
  EXPECT_FALSE(one.tasks[0].queries[1].at_1);
  EXPECT_NEAR(*one.tasks[1].queries[1].chance, 9.0 / 29.0, 1e-12);
  // Ten copies among 29 others; a box does not notice vertices on its edges.
  EXPECT_DOUBLE_EQ(*one.tasks[6].queries[0].at_10, 1.0);
  EXPECT_NEAR(*one.tasks[6].queries[0].chance, 10.0 / 39.0, 1e-12);
}

}  // namespace
}  // namespace plat::tile_similarity
