#include "similarity/candidate_search.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "made_measures.h"
#include "support/property.h"

namespace plat::similarity {
namespace {

using testing::clusters_of_rectangles;
using testing::made_measure;
using testing::random_rectangles;
using testing::rectangle;

/// Every allowed shape compared, no clusters.
std::vector<Candidate> brute_force(const std::vector<LabelledShape>& shapes,
                                   const LabelledShape& place, const CandidateOptions& options,
                                   const std::vector<std::uint32_t>& excluded,
                                   const AnyShapeSimilarity& measure) {
  const auto prepared = measure.prepare(place);
  std::vector<Candidate> all;
  for (std::uint32_t i = 0; i < shapes.size(); ++i) {
    if (std::find(excluded.begin(), excluded.end(), i) != excluded.end()) continue;
    if (options.zones == ZoneRule::kSame && !place.zone.empty() && shapes[i].zone != place.zone)
      continue;
    if (const auto candidate = measure.prepare(shapes[i]))
      all.push_back({i, measure.distance(*candidate, *prepared)});
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Candidate& a, const Candidate& b) { return a.distance < b.distance; });
  all.resize(std::min(all.size(), static_cast<std::size_t>(options.count)));
  return all;
}

TEST(CandidateSearch, WithAllClustersGivesWhatBruteForceGives) {
  ::plat::Rng rng = ::plat::testing::property_rng("CandidateSearchAll");
  int with_candidates = 0;
  for (int round = 0; round < ::plat::testing::iterations(60); ++round) {
    const auto shapes = random_rectangles(5 + rng.index(60), rng);
    const auto clusters = clusters_of_rectangles(shapes, 1 + rng.index(12), rng());
    const AnyShapeSimilarity measure = made_measure(round % 2);
    const CandidateSearch search(shapes, clusters, measure);
    const LabelledShape place =
        rectangle(rng.uniform(5, 60), rng.uniform(5, 60), std::string(round % 3 == 0 ? "" : "b"));
    const CandidateOptions options{.count = 1 + static_cast<int>(rng.index(20)),
                                   .clusters = static_cast<int>(clusters.members.size()),
                                   .zones = round % 4 == 0 ? ZoneRule::kAny : ZoneRule::kSame};
    const std::vector<std::uint32_t> excluded{static_cast<std::uint32_t>(rng.index(shapes.size())),
                                              0};
    const auto found = search.most_similar(place, options, excluded);
    ASSERT_TRUE(found);
    EXPECT_EQ(*found, brute_force(shapes, place, options, excluded, measure));
    with_candidates += found->size() > 1 ? 1 : 0;
  }
  EXPECT_GT(with_candidates, 30);
}

TEST(CandidateSearch, LooksOnlyIntoTheClusterOfTheNearestRepresentative) {
  // Two clusters; the nearest rectangle of all is a member of the farther one.
  const std::vector<LabelledShape> shapes{rectangle(10, 10), rectangle(10, 11), rectangle(10, 24),
                                          rectangle(10, 50), rectangle(10, 51), rectangle(10, 31)};
  const Clusters clusters{{1, 1, 1, 0, 0, 0}, {{3, 4, 5}, {0, 1, 2}}};
  const CandidateSearch search(shapes, clusters, made_measure());
  const LabelledShape place = rectangle(10, 29);
  const auto one = search.most_similar(place, {.count = 1, .clusters = 1});
  const auto two = search.most_similar(place, {.count = 1, .clusters = 2});
  ASSERT_TRUE(one && two);
  EXPECT_EQ(one->front().shape, 2U);
  EXPECT_EQ(two->front().shape, 5U);
}

TEST(CandidateSearch, LooksFurtherWhereAClusterHoldsTooFew) {
  const std::vector<LabelledShape> shapes{rectangle(10, 10, "a"), rectangle(10, 11, "b"),
                                          rectangle(10, 50, "b"), rectangle(10, 60, "b")};
  const Clusters clusters{{0, 0, 1, 2}, {{0, 1}, {2}, {3}}};
  const CandidateSearch search(shapes, clusters, made_measure());
  const auto found = search.most_similar(rectangle(10, 10, "b"), {.count = 2, .clusters = 1});
  ASSERT_TRUE(found);
  ASSERT_EQ(found->size(), 2U);
  EXPECT_EQ((*found)[0].shape, 1U);
  EXPECT_EQ((*found)[1].shape, 2U);
  EXPECT_EQ(search.most_similar(rectangle(9, 9, "b"), {.count = 10})->size(), 3U);
  EXPECT_TRUE(search.most_similar(rectangle(9, 9, "park"), {})->empty());
}

TEST(CandidateSearch, ShapesThatCannotBePreparedAreListedAndNeverCandidates) {
  const std::vector<LabelledShape> shapes{rectangle(0, 10), rectangle(10, 10), rectangle(0, 3)};
  const Clusters clusters{{0, 0, 1}, {{0, 1}, {2}}};
  const CandidateSearch search(shapes, clusters, made_measure());
  ASSERT_EQ(search.failures().size(), 2U);
  EXPECT_EQ(search.failures()[0].shape, 0U);
  EXPECT_EQ(search.failures()[1].failure.code, FailureCode::kTooSmall);
  const auto found = search.most_similar(rectangle(1, 1), {.count = 3, .clusters = 2});
  ASSERT_TRUE(found);
  ASSERT_EQ(found->size(), 1U);
  EXPECT_EQ(found->front().shape, 1U);
  EXPECT_EQ(search.most_similar(rectangle(0, 1), {}).error().code, FailureCode::kTooSmall);
}

TEST(CandidateSearch, DistanceIsThatOfTheCandidateLaidOnThePlace) {
  const std::vector<LabelledShape> shapes{rectangle(10, 20)};
  const CandidateSearch search(shapes, {{0}, {{0}}}, made_measure(1.0));
  EXPECT_DOUBLE_EQ(search.most_similar(rectangle(10, 10), {})->front().distance, 220.0);
  EXPECT_DOUBLE_EQ(search.most_similar(rectangle(10, 30), {})->front().distance, 120.0);
}

}  // namespace
}  // namespace plat::similarity
