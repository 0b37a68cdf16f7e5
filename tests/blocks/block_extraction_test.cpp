#include "blocks/block_extraction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "core/validity.h"
#include "core/working_grid.h"
#include "streets/network_cleaning.h"
#include "streets/street_width.h"
#include "support/property.h"
#include "support/street_map.h"

namespace plat::blocks {
namespace {

using plat::testing::ascii_points;
using plat::testing::streets_on;
using streets::RawStreet;
using streets::StreetNetwork;

/// A network in which the width of a street is what its name says, else 10 m.
StreetNetwork network_of(const std::vector<RawStreet>& raw) {
  StreetNetwork network = streets::build_network(raw).network;
  for (streets::Street& street : network.streets) {
    const std::string& name = street.attributes.name;
    street.width_m = name.empty() ? 10.0 : std::stod(name);
    street.width_source = WidthSource::kAttribute;
  }
  return network;
}

RawStreet street(std::string name, Polyline line) {
  RawStreet out;
  out.source_id = name;
  out.attributes.name = std::move(name);
  out.attributes.street_class = "residential";
  out.line = std::move(line);
  return out;
}

/// Four streets of different widths around 100 x 60 m.
std::vector<RawStreet> four_streets() {
  return {street("10", {{-20, 0}, {120, 0}}), street("20", {{100, -20}, {100, 80}}),
          street("8", {{-20, 60}, {120, 60}}), street("4", {{0, -20}, {0, 80}})};
}

TEST(ExtractBlocks, ContourIsInsetByEachStreetsOwnHalfWidth) {
  const BlocksOfNetwork found = extract_blocks(network_of(four_streets()));
  ASSERT_EQ(found.blocks.size(), 1U);
  const std::set<Point> corners(found.blocks[0].contour.outer.begin(),
                                found.blocks[0].contour.outer.end());
  EXPECT_EQ(corners, (std::set<Point>{{2, 5}, {90, 5}, {90, 56}, {2, 56}}));
}

TEST(ExtractBlocks, EveryEdgeCarriesTheStreetItFronts) {
  const StreetNetwork network = network_of(four_streets());
  const BlocksOfNetwork found = extract_blocks(network);
  const Block& block = found.blocks.at(0);
  for (std::size_t i = 0; i < 4; ++i) {
    const BlockEdge& edge = block.edges[0][i];
    const Point middle = midpoint(block.contour.outer[i], block.contour.outer[(i + 1) % 4]);
    const double expected = middle.y == 5 ? 10 : middle.y == 56 ? 8 : middle.x == 2 ? 4 : 20;
    EXPECT_EQ(edge.street_width_m, expected);
    EXPECT_EQ(network.streets.at(edge.street->value).width_m, expected);
    EXPECT_EQ(edge.width_source, WidthSource::kAttribute);
  }
  std::set<std::uint32_t> logical;
  for (const BlockEdge& edge : block.edges[0]) logical.insert(*edge.logical_street);
  EXPECT_EQ(logical.size(), 4U);
}

TEST(ExtractBlocks, ContourStepsWhereTheWidthChangesAlongALine) {
  auto raw = four_streets();
  raw[0] = street("10", {{-20, 0}, {40, 0}});
  raw.push_back(street("16", {{40, 0}, {120, 0}}));
  const Block block = extract_blocks(network_of(raw)).blocks.at(0);
  const std::set<Point> corners(block.contour.outer.begin(), block.contour.outer.end());
  EXPECT_TRUE(corners.contains({40, 5}) && corners.contains({40, 8}));
  EXPECT_EQ(corners.size(), 6U);
}

TEST(ExtractBlocks, DeadEndCutsASlitOfItsWidth) {
  auto raw = four_streets();
  raw.push_back(street("6", {{50, 0}, {50, 30}}));
  const BlocksOfNetwork found = extract_blocks(network_of(raw));
  ASSERT_EQ(found.blocks.size(), 1U);
  EXPECT_NEAR(area_m2(found.blocks[0].contour), 88.0 * 51.0 - 6.0 * 25.0, 0.01);
  int fronting = 0;
  for (const BlockEdge& edge : found.blocks[0].edges[0]) fronting += edge.street_width_m == 6.0;
  EXPECT_EQ(fronting, 3);  // both sides and the flat end
}

TEST(ExtractBlocks, IslandOfStreetsIsAHoleWithABlockInIt) {
  auto raw = four_streets();
  raw.push_back(street("2", {{40, 20}, {60, 20}, {60, 40}, {40, 40}, {40, 20}}));
  const BlocksOfNetwork found = extract_blocks(network_of(raw));
  ASSERT_EQ(found.blocks.size(), 2U);
  const bool first_is_outer = area_m2(found.blocks[0].contour) > area_m2(found.blocks[1].contour);
  const Block& outer = found.blocks[first_is_outer ? 0 : 1];
  const Block& inner = found.blocks[first_is_outer ? 1 : 0];
  ASSERT_EQ(outer.contour.holes.size(), 1U);
  EXPECT_NEAR(area_m2(outer.contour), 88.0 * 51.0 - 22.0 * 22.0, 0.01);
  EXPECT_NEAR(area_m2(inner.contour), 18.0 * 18.0, 0.01);
  for (const BlockEdge& edge : outer.edges.at(1)) EXPECT_EQ(edge.street_width_m, 2.0);
}

TEST(ExtractBlocks, FaceWithANeckFallsApart) {
  //   two squares of 100 m joined by a neck 8 m wide
  const std::vector<RawStreet> raw{street("10", {{0, 0},
                                                 {100, 0},
                                                 {100, 46},
                                                 {140, 46},
                                                 {140, 0},
                                                 {240, 0},
                                                 {240, 100},
                                                 {140, 100},
                                                 {140, 54},
                                                 {100, 54},
                                                 {100, 100},
                                                 {0, 100},
                                                 {0, 0}})};
  EXPECT_EQ(extract_blocks(network_of(raw)).blocks.size(), 2U);
}

TEST(ExtractBlocks, FaceWithinItsStreetsIsAFailureRow) {
  auto raw = four_streets();
  raw.push_back(street("30", {{-20, 20}, {120, 20}}));
  const BlocksOfNetwork found = extract_blocks(network_of(raw));
  EXPECT_EQ(found.blocks.size(), 1U);
  ASSERT_EQ(found.failures.size(), 1U);
  EXPECT_EQ(found.failures[0].failure.code, FailureCode::kTooSmall);
  EXPECT_FALSE(found.failures[0].feature_id.empty());
}

TEST(ExtractBlocks, ReflexCornerOfTheBlockIsMitred) {
  const std::vector<RawStreet> raw{
      street("10", {{0, 0}, {100, 0}, {100, 50}, {50, 50}, {50, 100}, {0, 100}, {0, 0}})};
  const Block block = extract_blocks(network_of(raw)).blocks.at(0);
  const std::set<Point> corners(block.contour.outer.begin(), block.contour.outer.end());
  EXPECT_EQ(corners, (std::set<Point>{{5, 5}, {95, 5}, {95, 45}, {45, 45}, {45, 95}, {5, 95}}));
}

TEST(ExtractBlocks, FootwayAndTunnelDoNotDivide) {
  auto raw = four_streets();
  raw.push_back(street("3", {{30, 0}, {30, 60}}));
  raw.back().attributes.street_class = "footway";
  raw.push_back(street("10", {{-20, 30}, {120, 30}}));
  raw.back().attributes.level = -1;
  raw.back().attributes.structure = streets::Structure::kTunnel;
  EXPECT_EQ(extract_blocks(network_of(raw)).blocks.size(), 1U);
  ExtractionOptions all;
  all.bounding = streets::BoundingClasses::kAll;
  EXPECT_EQ(extract_blocks(network_of(raw), all).blocks.size(), 2U);
}

std::vector<RawStreet> grid(int columns, int rows, double step_m) {
  std::vector<RawStreet> raw;
  for (int r = 0; r <= rows; ++r)
    raw.push_back(street("", {{0, step_m * r}, {step_m * columns, step_m * r}}));
  for (int c = 0; c <= columns; ++c)
    raw.push_back(street("", {{step_m * c, 0}, {step_m * c, step_m * rows}}));
  return raw;
}

TEST(DualGraph, OfAGridJoinsBlocksAcrossStreets) {
  const BlocksOfNetwork found = extract_blocks(network_of(grid(3, 3, 80.0)));
  ASSERT_EQ(found.blocks.size(), 9U);
  EXPECT_EQ(found.dual.size(), 12U);
  const auto neighbours = neighbours_of(found.dual, found.blocks.size());
  std::multiset<std::size_t> degrees;
  for (const auto& row : neighbours) degrees.insert(row.size());
  EXPECT_EQ(degrees, (std::multiset<std::size_t>{2, 2, 2, 2, 3, 3, 3, 3, 4}));
  for (const DualEdge& edge : found.dual) EXPECT_DOUBLE_EQ(edge.length_m, 80.0);
}

TEST(ExtractBlocks, NamedStreetAroundACornerIsOneLogicalStreet) {
  const std::vector<RawStreet> raw{street("12", {{0, 0}, {100, 0}, {100, 60}}),
                                   street("14", {{100, 60}, {0, 60}, {0, 0}})};
  const Block block = extract_blocks(network_of(raw)).blocks.at(0);
  std::set<std::uint32_t> logical;
  for (const BlockEdge& edge : block.edges[0]) logical.insert(*edge.logical_street);
  EXPECT_EQ(logical.size(), 2U);
}

/// Wavy lines: random, with dead ends and narrow faces.
std::vector<RawStreet> random_streets(Rng& rng) {
  std::vector<RawStreet> raw;
  for (int i = 0; i < 40; ++i) {
    Point p{rng.uniform(0, 500), rng.uniform(0, 500)};
    Polyline line;
    const double heading = rng.uniform(0, 6.28);
    for (int k = 0; k < 8; ++k) {
      line.push_back(snap(p));
      const double turn = heading + rng.uniform(-0.5, 0.5);
      p = p + rng.uniform(20, 60) * Point{std::cos(turn), std::sin(turn)};
    }
    raw.push_back(street(std::to_string(4 + static_cast<int>(rng.index(20))), line));
  }
  return raw;
}

double total_area_m2(const BlocksOfNetwork& found) {
  double total = 0.0;
  for (const Block& block : found.blocks) total += area_m2(block.contour);
  return total;
}

TEST(ExtractBlocks, RandomNetworksGiveValidBlocksApartFromTheirStreets) {
  Rng rng = plat::testing::property_rng("RandomNetworksGiveValidBlocksApartFromTheirStreets");
  std::size_t blocks = 0;
  std::size_t checked = 0;
  for (int i = 0; i < plat::testing::iterations(20); ++i) {
    const StreetNetwork network = network_of(random_streets(rng));
    const BlocksOfNetwork found = extract_blocks(network);
    blocks += found.blocks.size();
    for (const Block& block : found.blocks) {
      ASSERT_FALSE(find_defect(block.contour));
      ASSERT_EQ(block.edges.size(), 1 + block.contour.holes.size());
      for (const BlockEdge& edge : block.edges[0]) ASSERT_TRUE(edge.is_street());
      // A street around the block keeps its half width (streets beyond those do not count).
      std::set<std::uint32_t> around;
      for (const BlockEdge& edge : block.edges[0]) around.insert(edge.street->value);
      for (const std::uint32_t id : around) {
        const streets::Street& s = network.streets[id];
        for (std::size_t k = 1; k < s.line.size(); ++k) {
          if (distance(s.line[k - 1], s.line[k]) < s.width_m) continue;
          const Point p = midpoint(s.line[k - 1], s.line[k]);
          ASSERT_EQ(locate(block.contour, p), Side::kOutside);
          ASSERT_GT(boundary_distance_m(block.contour, p), 0.5 * s.width_m - 0.05);
          ++checked;
        }
      }
    }
  }
  EXPECT_GT(blocks, 200U);
  EXPECT_GT(checked, 500U);
}

TEST(ExtractBlocks, MirroredAndTranslatedNetworkGivesTheSameAreas) {
  Rng rng = plat::testing::property_rng("MirroredAndTranslatedNetworkGivesTheSameAreas");
  const auto raw = random_streets(rng);
  auto twin = raw;
  for (RawStreet& s : twin) {
    for (Point& p : s.line) p = {1024.0 - p.y, 2048.0 - p.x};
  }
  const BlocksOfNetwork a = extract_blocks(network_of(raw));
  const BlocksOfNetwork b = extract_blocks(network_of(twin));
  EXPECT_EQ(a.face_count, b.face_count);
  EXPECT_NEAR(total_area_m2(a), total_area_m2(b), 1e-4 * total_area_m2(a));
}

TEST(ExtractBlocks, ThreadCountDoesNotChangeTheResult) {
  Rng rng = plat::testing::property_rng("ThreadCountDoesNotChangeTheResult");
  const StreetNetwork network = network_of(random_streets(rng));
  const BlocksOfNetwork one = extract_blocks(network, {}, Jobs{1});
  const BlocksOfNetwork four = extract_blocks(network, {}, Jobs{4});
  ASSERT_EQ(one.blocks.size(), four.blocks.size());
  for (std::size_t i = 0; i < one.blocks.size(); ++i) {
    EXPECT_EQ(one.blocks[i].contour, four.blocks[i].contour);
    EXPECT_EQ(one.blocks[i].edges, four.blocks[i].edges);
  }
  EXPECT_EQ(one.dual, four.dual);
}

}  // namespace
}  // namespace plat::blocks
