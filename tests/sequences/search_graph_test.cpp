#include "sequences/search_graph.h"

#include <gtest/gtest.h>

#include "core/failure.h"

namespace plat::sequences {
namespace {

/// Two nodes, a zone each, joined by a link.
SearchGraph two_zones(Bounds first, Bounds second, bool resets) {
  SearchGraph graph;
  graph.dimension_count = 1;
  graph.zones = {{0, 1, std::nullopt, {first}, {false}}, {1, 1, std::nullopt, {second}, {resets}}};
  graph.node_uses = {2, 3};
  graph.entries = {{0, 0}};
  graph.exits = {{1, 0}};
  graph.links = {{0, 1, 0}};
  return graph;
}

TEST(SearchGraph, RefusesToAskForWhatAnEarlierZoneDidNotCount) {
  EXPECT_NO_THROW(validate(two_zones({0, 9}, {4, 5}, false)));
  EXPECT_NO_THROW(validate(two_zones({4, kUnbounded}, {4, kUnbounded}, false)));
  EXPECT_NO_THROW(validate(two_zones({0, kUnbounded}, {4, 5}, true)));
  EXPECT_THROW(validate(two_zones({0, kUnbounded}, {0, 5}, false)), LogicError);
  EXPECT_THROW(validate(two_zones({3, kUnbounded}, {4, kUnbounded}, false)), LogicError);
}

}  // namespace
}  // namespace plat::sequences
