#include "sequences/structure_decomposition.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "core/failure.h"
#include "sequences/support/structure_brute_force.h"
#include "support/property.h"

namespace plat::sequences {
namespace {

using plat::testing::iterations;
using plat::testing::property_rng;
using plat::testing::random_structure_problem;
using KeyPointIndex = std::uint32_t;

/// Key points of so many choices each, joined by segments; ports are given out in order.
struct StructureBuilder {
  Structure structure = {};
  std::vector<std::uint8_t> used_ports = {};

  explicit StructureBuilder(const std::vector<std::size_t>& choices) : used_ports(choices.size()) {
    for (const std::size_t count : choices) {
      structure.key_points.emplace_back();
      structure.key_points.back().allowed.resize(count);
    }
  }
  StructureBuilder& join(std::optional<KeyPointIndex> from, std::optional<KeyPointIndex> to,
                         Amount length = 0) {
    Segment segment;
    segment.from = from;
    segment.to = to;
    if (from) segment.from_port = static_cast<Port>(used_ports[*from]++);
    if (to) segment.to_port = static_cast<Port>(used_ports[*to]++);
    segment.bounds = {{length, length}};
    structure.segments.push_back(segment);
    return *this;
  }
};

std::vector<std::uint32_t> segments_of(const StructurePath& path) {
  std::vector<std::uint32_t> segments;
  for (const auto& directed : path.segments) segments.push_back(directed.segment);
  return segments;
}

using Numbers = std::vector<std::uint32_t>;

/// The tree of [Har, Fig. 3.3]: a trunk with two branches, one of which branches again.
///
///     0 --s0-- 1 --s1-- 2 --s2-- 3
///              |        |
///              s3       s4
///              4        5 --s5-- 6
///                       |
///                       s6
///                       7
Structure nested_tree() {
  return StructureBuilder({1, 2, 3, 1, 1, 4, 1, 1})
      .join(0, 1, 20)
      .join(1, 2, 20)
      .join(2, 3, 20)
      .join(1, 4, 5)
      .join(2, 5, 5)
      .join(5, 6, 4)
      .join(7, 5, 3)
      .structure;
}

TEST(StructureDecomposition, ExtractsTheLongestPathsOfATreeOneAfterTheOther) {
  const auto paths = decompose(nested_tree());
  ASSERT_EQ(paths.size(), 4U);
  EXPECT_EQ(segments_of(paths[0]), (Numbers{0, 1, 2}));
  EXPECT_EQ(segments_of(paths[1]), (Numbers{3}));
  EXPECT_EQ(segments_of(paths[2]), (Numbers{4, 5}));
  EXPECT_EQ(segments_of(paths[3]), (Numbers{6}));
  EXPECT_EQ(paths[2].start, 2U);
  EXPECT_EQ(paths[2].parent, 0U);
  EXPECT_EQ(paths[3].start, 5U);
  EXPECT_EQ(paths[3].parent, 2U);
  EXPECT_FALSE(paths[3].segments[0].is_forward);
}

TEST(StructureDecomposition, WalksABranchWhenItsElementIsPlacedAndRemembersItMeanwhile) {
  const Structure structure = nested_tree();
  const auto visits = visit_order(structure, decompose(structure));
  Numbers order;
  std::vector<Numbers> remembered;
  for (const Visit& visit : visits) {
    order.push_back(visit.directed.segment);
    remembered.push_back(visit.remembered);
    EXPECT_FALSE(visit.is_end_placed);
  }
  EXPECT_EQ(order, (Numbers{0, 3, 1, 4, 6, 5, 2}));
  EXPECT_EQ(remembered, (std::vector<Numbers>{{}, {1}, {}, {2}, {2, 5}, {2}, {}}));
  // One each of s0, s1, s2; s3 for 2 choices of T1, s4 and s5 for 3 of T2, s6 for 3 * 4.
  EXPECT_EQ(copy_count(structure, visits), 3.0 + 2.0 + 3.0 + 3.0 + 12.0);
}

TEST(StructureDecomposition, RemembersNothingInAChain) {
  const Structure chain = StructureBuilder({3, 3, 3})
                              .join(std::nullopt, 0)
                              .join(0, 1)
                              .join(2, 1)
                              .join(2, std::nullopt)
                              .structure;
  for (const Visit& visit : visit_order(chain, decompose(chain)))
    EXPECT_TRUE(visit.remembered.empty());
}

/// Corners of 5, 3, 4 and 6 choices in a ring, and two more key points.
StructureBuilder ring() {
  return StructureBuilder({5, 3, 4, 6, 2, 2}).join(0, 1).join(1, 2).join(2, 3).join(3, 0);
}

TEST(StructureDecomposition, SplitsACycleWhereTheFewestCopiesAreMade) {
  StructureBuilder builder = ring();
  builder.structure.key_points.resize(4);
  const auto paths = decompose(builder.structure);
  ASSERT_EQ(paths.size(), 1U);
  EXPECT_EQ(paths[0].start, 1U);
  const auto visits = visit_order(builder.structure, paths);
  EXPECT_EQ(copy_count(builder.structure, visits), 4 * 3.0);
  EXPECT_TRUE(visits.back().is_end_placed);
}

TEST(StructureDecomposition, SplitsACycleAtItsBranchWhereThatCopiesLess) {
  const Structure structure = ring().join(3, 4, 50).join(4, 5, 50).structure;
  const auto paths = decompose(structure);
  ASSERT_EQ(paths.size(), 2U);
  EXPECT_EQ(paths[0].segments.size(), 4U);
  // At 3: 4 + 2 segments for 6 choices; at 1: 4 for 3 choices and the branch's 2 for 3 * 6.
  EXPECT_EQ(paths[0].start, 3U);
  EXPECT_EQ(copy_count(structure, visit_order(structure, paths)), 6 * 6.0);
}

TEST(StructureDecomposition, WalksALoopOnABranchAndLoopsThatShareKeyPoints) {
  // A loop of 1 and 2 at the end of a branch, a longer one of 3, 4 and 5, which has a chord.
  const Structure structure = StructureBuilder({2, 2, 2, 2, 2, 2})
                                  .join(0, 1, 2)
                                  .join(1, 2, 3)
                                  .join(2, 1, 3)
                                  .join(0, 3, 2)
                                  .join(3, 4, 9)
                                  .join(4, 5, 9)
                                  .join(5, 3, 9)
                                  .join(4, 5, 1)
                                  .structure;
  const auto paths = decompose(structure);
  ASSERT_EQ(paths.size(), 3U);
  EXPECT_EQ(paths[0].segments.size(), 3U);
  const auto visits = visit_order(structure, paths);
  EXPECT_EQ(std::ranges::count(visits, true, &Visit::is_end_placed), 3);
}

TEST(StructureDecomposition, RefusesMoreCyclesThanItCanTry) {
  const auto ladder = [](KeyPointIndex rungs) {
    StructureBuilder builder(std::vector<std::size_t>(2 * rungs, 2));
    for (KeyPointIndex r = 0; r < rungs; ++r) {
      builder.join(2 * r, 2 * r + 1);
      if (r == 0) continue;
      builder.join(2 * r - 2, 2 * r).join(2 * r - 1, 2 * r + 1);
    }
    return builder.structure;
  };
  EXPECT_EQ(decompose(ladder(7)).size(), 6U);
  EXPECT_THROW(decompose(ladder(8)), InputError);
}

struct Length {
  std::int64_t primary = 0;
  std::size_t segments = 0;
  friend auto operator<=>(const Length&, const Length&) = default;
};

Length length_of(const Structure& structure, const StructurePath& path) {
  Length length;
  for (const auto& directed : path.segments) {
    const auto& bounds = structure.segments[directed.segment].bounds;
    length.primary += bounds.empty() ? 0 : bounds[0].min;
    ++length.segments;
  }
  return length;
}

/// The longest way from a segment's end on, not back: in a tree there is but one way anywhere.
Length longest_from(const Structure& structure, std::uint32_t segment, bool is_forward) {
  const Segment& walked = structure.segments[segment];
  Length on;
  const auto end = is_forward ? walked.to : walked.from;
  for (std::uint32_t s = 0; end && s < structure.segments.size(); ++s) {
    if (s == segment) continue;
    if (structure.segments[s].from == end) on = std::max(on, longest_from(structure, s, true));
    if (structure.segments[s].to == end) on = std::max(on, longest_from(structure, s, false));
  }
  return {on.primary + (walked.bounds.empty() ? 0 : walked.bounds[0].min), on.segments + 1};
}

TEST(StructureDecomposition, HasNoLongerPathInATreeThanThePrimaryOne) {
  Rng rng = property_rng("decomposition.trees");
  int branching = 0;
  for (int i = 0; i < iterations(300); ++i) {
    const auto structure =
        random_structure_problem(rng, {.segments = 12, .has_cycles = false}).structure;
    Length longest;
    for (std::uint32_t s = 0; s < structure.segments.size(); ++s)
      for (const bool is_forward : {true, false})
        longest = std::max(longest, longest_from(structure, s, is_forward));
    const auto paths = decompose(structure);
    branching += paths.size() > 1 ? 1 : 0;
    ASSERT_EQ(length_of(structure, paths[0]), longest) << i;
  }
  EXPECT_GT(branching, iterations(300) / 3);
}

/// Puts a path's key points to those met before; false where a segment does not begin where the
/// last one ended, or the path goes on behind a key point that was met.
bool follow(const Structure& structure, const StructurePath& path, std::set<KeyPointIndex>& met) {
  auto at = path.start;
  if (at && path.parent && !met.contains(*at)) return false;
  if (at) met.insert(*at);
  bool is_closed = false;
  for (const auto& [s, is_forward] : path.segments) {
    const Segment& segment = structure.segments[s];
    if (is_closed || (is_forward ? segment.from : segment.to) != at) return false;
    at = is_forward ? segment.to : segment.from;
    is_closed = !at || !met.insert(*at).second;
  }
  return true;
}

TEST(StructureDecomposition, PutsEverySegmentOnOnePathThatEndsAtAnEndOrAtAnotherPath) {
  Rng rng = property_rng("decomposition.paths");
  int with_cycles = 0;
  for (int i = 0; i < iterations(300); ++i) {
    const auto structure = random_structure_problem(rng, {.segments = 9}).structure;
    const auto paths = decompose(structure);
    std::multiset<std::uint32_t> seen;
    std::set<KeyPointIndex> met;
    for (const auto& path : paths) {
      for (const auto& directed : path.segments) seen.insert(directed.segment);
      EXPECT_TRUE(follow(structure, path, met)) << i;
    }
    ASSERT_EQ(seen.size(), structure.segments.size());
    ASSERT_EQ(std::set<std::uint32_t>(seen.begin(), seen.end()).size(), seen.size());
    EXPECT_EQ(met.size(), structure.key_points.size());
    const auto& last = paths[0].segments.back();
    const Segment& segment = structure.segments[last.segment];
    if (paths[0].start && (last.is_forward ? segment.to : segment.from) == paths[0].start)
      ++with_cycles;
  }
  EXPECT_GT(with_cycles, iterations(300) / 4);
}

}  // namespace
}  // namespace plat::sequences
