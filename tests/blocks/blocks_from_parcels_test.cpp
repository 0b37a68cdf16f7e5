#include "blocks/blocks_from_parcels.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "blocks/edge_labels.h"
#include "core/validity.h"
#include "streets/network_cleaning.h"
#include "streets/street_width.h"

namespace plat::blocks {
namespace {

Polygon box(double x0, double y0, double x1, double y1) {
  return {{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, {}};
}

/// Two blocks of two parcels each, 14 m apart, with a survey's gap of 0.4 m between the first two.
std::vector<ObservedParcel> two_blocks() {
  return {{"a", box(0, 0, 20, 30)},
          {"b", box(20.4, 0, 40, 30)},
          {"c", box(54, 0, 74, 30)},
          {"d", box(74, 0, 94, 30)}};
}

TEST(BlocksFromParcels, UnionOfParcelsIsClosedAcrossSmallGaps) {
  const BlocksFromParcels found = blocks_from_parcels(two_blocks());
  ASSERT_EQ(found.blocks.size(), 2U);
  EXPECT_DOUBLE_EQ(area_m2(found.blocks[0].contour), 40.0 * 30.0);
  EXPECT_EQ(found.blocks[0].contour.outer.size(), 4U);
  EXPECT_EQ(found.blocks[0].source_id, "a");
}

TEST(BlocksFromParcels, EveryParcelKnowsItsBlock) {
  const BlocksFromParcels found = blocks_from_parcels(two_blocks());
  ASSERT_EQ(found.block_of.size(), 4U);
  EXPECT_EQ(found.block_of[0], found.block_of[1]);
  EXPECT_EQ(found.block_of[2], found.block_of[3]);
  EXPECT_NE(found.block_of[0], found.block_of[2]);
}

TEST(BlocksFromParcels, CornersStaySharp) {
  const BlocksFromParcels found = blocks_from_parcels(std::vector<ObservedParcel>{
      {"l", {{{0, 0}, {40, 0}, {40, 20}, {20, 20}, {20, 40}, {0, 40}}, {}}}});
  EXPECT_EQ(found.blocks.at(0).contour.outer.size(), 6U);
  EXPECT_DOUBLE_EQ(area_m2(found.blocks[0].contour), 1200.0);
}

TEST(BlocksFromParcels, ParcelInACourtyardOfAnotherIsABlockOfItsOwn) {
  Polygon ring = box(0, 0, 60, 60);
  ring.holes.push_back({{15, 15}, {15, 45}, {45, 45}, {45, 15}});
  const BlocksFromParcels found =
      blocks_from_parcels(std::vector<ObservedParcel>{{"ring", ring}, {"in", box(20, 20, 40, 40)}});
  ASSERT_EQ(found.blocks.size(), 2U);
  EXPECT_EQ(found.blocks[0].contour.holes.size(), 1U);
}

TEST(BlocksFromParcels, BlocksThatTouchInAPointAreSimple) {
  // Two parcels that share one corner: the union touches itself there.
  const BlocksFromParcels found = blocks_from_parcels(
      std::vector<ObservedParcel>{{"a", box(0, 0, 20, 20)}, {"b", box(20, 20, 40, 40)}});
  ASSERT_FALSE(found.blocks.empty());
  double total = 0.0;
  for (const Block& block : found.blocks) {
    EXPECT_FALSE(find_defect(block.contour));
    total += area_m2(block.contour);
  }
  EXPECT_NEAR(total, 800.0, 10.0);
}

TEST(BlocksFromParcels, BadParcelsBecomeRowsAndTheRestIsKept) {
  std::vector<ObservedParcel> parcels = two_blocks();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  parcels.push_back({"bow", {{{0, 100}, {10, 110}, {10, 100}, {0, 110}}, {}}});
  parcels.push_back({"nan", {{{0, 200}, {nan, 0}, {10, 210}}, {}}});
  parcels.push_back({"empty", {}});
  const BlocksFromParcels found = blocks_from_parcels(parcels);
  EXPECT_EQ(found.blocks.size(), 2U);
  ASSERT_EQ(found.failures.size(), 3U);
  EXPECT_EQ(found.failures[0].feature_id, "bow");
  EXPECT_EQ(found.failures[0].failure.code, FailureCode::kNotSimple);
  EXPECT_EQ(found.failures[1].failure.code, FailureCode::kNotFinite);
  EXPECT_EQ(found.failures[2].failure.code, FailureCode::kEmptyGeometry);
  EXPECT_FALSE(found.block_of[4].has_value());
}

TEST(BlocksFromParcels, ThreadCountDoesNotChangeTheResult) {
  const auto parcels = two_blocks();
  const BlocksFromParcels one = blocks_from_parcels(parcels, {}, Jobs{1});
  const BlocksFromParcels four = blocks_from_parcels(parcels, {}, Jobs{4});
  for (std::size_t b = 0; b < one.blocks.size(); ++b)
    EXPECT_EQ(one.blocks[b].contour, four.blocks[b].contour);
}

/// The label of the edge whose middle is at `middle`.
BlockEdge edge_at(const Block& block, Point middle) {
  for (std::size_t r = 0; r < block.edges.size(); ++r) {
    const Ring& ring = ring_at(block, r);
    for (std::size_t i = 0; i < ring.size(); ++i) {
      if (midpoint(ring[i], ring[(i + 1) % ring.size()]) == middle) return block.edges[r][i];
    }
  }
  ADD_FAILURE() << "no edge there";
  return {};
}

TEST(LabelEdges, WithoutCentrelineTheGapIsTheStreet) {
  auto found = blocks_from_parcels(two_blocks());
  label_edges(found.blocks, {});
  const BlockEdge facing = edge_at(found.blocks[0], {40, 15});
  EXPECT_TRUE(facing.is_street());
  EXPECT_FALSE(facing.street.has_value());
  EXPECT_DOUBLE_EQ(facing.street_width_m, 14.0);
  EXPECT_EQ(facing.width_source, WidthSource::kGap);
}

TEST(LabelEdges, OuterRimIsOpenLand) {
  auto found = blocks_from_parcels(two_blocks());
  label_edges(found.blocks, {});
  EXPECT_FALSE(edge_at(found.blocks[0], {0, 15}).is_street());
  EXPECT_FALSE(edge_at(found.blocks[0], {20, 0}).is_street());
}

TEST(LabelEdges, BlockWithoutAnyStreetIsTakenToHaveOneAround) {
  auto found = blocks_from_parcels(std::vector<ObservedParcel>{{"farm", box(0, 0, 50, 50)}});
  label_edges(found.blocks, {});
  for (const BlockEdge& edge : found.blocks[0].edges[0])
    EXPECT_EQ(edge.width_source, WidthSource::kAssumed);
}

TEST(LabelEdges, NearestParallelStreetInSightIsFronted) {
  auto found = blocks_from_parcels(two_blocks());
  // A street in the gap, one below the first block, one behind the second that is out of sight.
  streets::StreetNetwork network =
      streets::build_network(std::vector<streets::RawStreet>{{"gap", {{47, -6}, {47, 40}}, {}},
                                                             {"south", {{-20, -6}, {40, -6}}, {}},
                                                             {"east", {{100, -40}, {100, 60}}, {}}})
          .network;
  std::vector<Polygon> land;
  for (const Block& block : found.blocks) land.push_back(block.contour);
  streets::assign_widths(network, land);
  label_edges(found.blocks, network);
  const auto source_of = [&](Point middle) {
    const BlockEdge edge = edge_at(found.blocks[0], middle);
    return edge.street ? network.streets[edge.street->value].source_id : std::string();
  };
  EXPECT_EQ(source_of({40, 15}), "gap");
  EXPECT_EQ(edge_at(found.blocks[0], {40, 15}).width_source, WidthSource::kGap);
  EXPECT_DOUBLE_EQ(edge_at(found.blocks[0], {40, 15}).street_width_m, 14.0);
  EXPECT_EQ(source_of({20, 0}), "south");
  EXPECT_EQ(source_of({0, 15}), "");
}

TEST(LabelEdges, CourtyardFacesNoStreet) {
  Polygon ring = box(0, 0, 60, 60);
  ring.holes.push_back({{15, 15}, {15, 45}, {45, 45}, {45, 15}});
  auto found = blocks_from_parcels(
      std::vector<ObservedParcel>{{"ring", ring}, {"other", box(70, 0, 90, 60)}});
  label_edges(found.blocks, {});
  for (const BlockEdge& edge : found.blocks[0].edges.at(1)) EXPECT_FALSE(edge.is_street());
}

TEST(LabelEdges, MirroredCityHasTheSameLabels) {
  std::vector<ObservedParcel> parcels = two_blocks();
  parcels.push_back({"e", box(0, 41, 94, 70)});
  std::vector<ObservedParcel> twins = parcels;
  for (ObservedParcel& twin : twins) {
    for (Point& p : twin.shape.outer) p = {512.0 - p.x, p.y + 64.0};
  }
  const auto widths = [](std::span<const ObservedParcel> of) {
    BlocksFromParcels found = blocks_from_parcels(of);
    label_edges(found.blocks, {});
    std::multiset<double> out;
    for (const Block& block : found.blocks) {
      for (const BlockEdge& edge : block.edges[0]) out.insert(edge.street_width_m);
    }
    return out;
  };
  EXPECT_EQ(widths(parcels), widths(twins));
  EXPECT_EQ(widths(parcels).count(11.0), 3U);
}

}  // namespace
}  // namespace plat::blocks
