#include "synthesis/network_cut.h"

#include <gtest/gtest.h>

#include "core/working_grid.h"
#include "support/property.h"

namespace plat::synthesis {
namespace {

streets::StreetNetwork network_of(const std::vector<Polyline>& lines) {
  streets::StreetNetwork out;
  for (const Polyline& line : lines) {
    out.nodes.push_back(line.front());
    out.nodes.push_back(line.back());
  }
  std::ranges::sort(out.nodes);
  out.nodes.erase(std::ranges::unique(out.nodes).begin(), out.nodes.end());
  for (const Polyline& line : lines) {
    streets::Street street;
    street.id = StreetId{static_cast<std::uint32_t>(out.streets.size())};
    const auto number = [&](Point p) {
      return static_cast<std::uint32_t>(std::ranges::lower_bound(out.nodes, p) - out.nodes.begin());
    };
    street.from = number(line.front());
    street.to = number(line.back());
    street.line = line;
    street.width_m = 10.0;
    street.source_id = std::to_string(out.streets.size());
    out.streets.push_back(street);
  }
  return out;
}

const Polygon kSquare{{{0, 0}, {100, 0}, {100, 100}, {0, 100}}, {}};

TEST(CutOut, LeavesStreetsOutsideAndAlongTheBoundaryUnchanged) {
  const streets::StreetNetwork network =
      network_of({{{-50, -50}, {200, -50}}, {{0, 0}, {100, 0}}, {{-20, 0}, {0, 0}}});
  const NetworkCut cut = cut_out(network, kSquare);
  EXPECT_EQ(cut.cut_streets, 0u);
  EXPECT_EQ(cut.network.nodes, network.nodes);
  ASSERT_EQ(cut.network.streets.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(cut.network.streets[i].line, network.streets[i].line);
  }
  EXPECT_EQ(cut.region, kSquare);
}

TEST(CutOut, CutsAStreetThatCrossesIntoTwo) {
  const NetworkCut cut = cut_out(network_of({{{-50, 40}, {200, 40}}}), kSquare);
  ASSERT_EQ(cut.network.streets.size(), 2u);
  EXPECT_EQ(cut.network.streets[0].line, (Polyline{{-50, 40}, {0, 40}}));
  EXPECT_EQ(cut.network.streets[1].line, (Polyline{{100, 40}, {200, 40}}));
  EXPECT_EQ(cut.network.streets[1].source_id, "0");
  EXPECT_EQ(cut.network.streets[1].id.value, 1u);
  EXPECT_EQ(cut.cut_streets, 1u);
  ASSERT_EQ(cut.cut_nodes.size(), 2u);
  EXPECT_EQ(cut.network.nodes[cut.cut_nodes[0]], (Point{0, 40}));
  EXPECT_EQ(cut.region.outer.size(), 6u) << "a vertex at each cut";
}

TEST(CutOut, TakesAwayWhatLiesInside) {
  const NetworkCut cut = cut_out(
      network_of({{{10, 10}, {90, 90}}, {{0, 0}, {50, 20}, {100, 0}}, {{50, 50}, {50, 150}}}),
      kSquare);
  ASSERT_EQ(cut.network.streets.size(), 1u);
  EXPECT_EQ(cut.network.streets[0].line, (Polyline{{50, 100}, {50, 150}}));
  EXPECT_EQ(cut.network.nodes.size(), 2u);
  EXPECT_EQ(cut.cut_streets, 3u);
}

TEST(CutOut, KeepsStreetsInAHole) {
  Polygon ring = kSquare;
  ring.holes = {{{40, 40}, {40, 60}, {60, 60}, {60, 40}}};
  const NetworkCut cut = cut_out(network_of({{{-50, 50}, {150, 50}}}), ring);
  ASSERT_EQ(cut.network.streets.size(), 3u);
  EXPECT_EQ(cut.network.streets[1].line, (Polyline{{40, 50}, {60, 50}}));
}

TEST(CutOut, AStreetThatTouchesOnlyIsNotCut) {
  const streets::StreetNetwork network =
      network_of({{{-50, 0}, {0, 50}, {-50, 100}}, {{-50, 100}, {50, 100}, {50, 200}}});
  const NetworkCut cut = cut_out(network, kSquare);
  EXPECT_EQ(cut.cut_streets, 0u);
  EXPECT_EQ(cut.network.streets.size(), 2u);
}

TEST(CutOut, RunsAlongAndTouchingAreKeptWhereAStreetAlsoEnters) {
  // Along the west side, then in, then out at the top.
  const NetworkCut cut = cut_out(network_of({{{0, -50}, {0, 60}, {50, 60}, {50, 150}}}), kSquare);
  ASSERT_EQ(cut.network.streets.size(), 2u);
  EXPECT_EQ(cut.network.streets[0].line.front(), (Point{0, -50}));
  EXPECT_EQ(cut.network.streets[0].line.back(), (Point{0, 60}));
  EXPECT_EQ(cut.network.streets[1].line, (Polyline{{50, 100}, {50, 150}}));
}

TEST(CutOut, LengthsAddUpForRandomStreets) {
  Rng rng = plat::testing::property_rng("CutOut.Lengths");
  const Polygon region{{{0, 0}, {300, 40}, {260, 300}, {140, 120}, {-40, 280}}, {}};
  int cut_ones = 0;
  for (int trial = 0; trial < plat::testing::iterations(300); ++trial) {
    Polyline line;
    for (int i = 0; i < 6; ++i) {
      line.push_back(snap(Point{rng.uniform(-200, 450), rng.uniform(-200, 450)}));
    }
    const streets::StreetNetwork network = network_of({line});
    const NetworkCut cut = cut_out(network, region);
    cut_ones += cut.cut_streets > 0 ? 1 : 0;
    double kept_m = 0.0;
    for (const streets::Street& street : cut.network.streets) {
      kept_m += length_m(street.line);
      ASSERT_EQ(cut.network.nodes[street.from], street.line.front());
      ASSERT_EQ(cut.network.nodes[street.to], street.line.back());
    }
    // An independent measure: samples along the line.
    double outside_m = 0.0;
    constexpr int kSamples = 2000;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      const double step_m = distance(line[i], line[i + 1]) / kSamples;
      for (int k = 0; k < kSamples; ++k) {
        const Point p = lerp(line[i], line[i + 1], (k + 0.5) / kSamples);
        outside_m += locate(region, p) == Side::kInside ? 0.0 : step_m;
      }
    }
    ASSERT_NEAR(kept_m, outside_m, 5.0);
    for (const std::uint32_t node : cut.cut_nodes) {
      ASSERT_EQ(locate(cut.region, cut.network.nodes[node]), Side::kBoundary);
    }
  }
  EXPECT_GT(cut_ones, 200);
}

}  // namespace
}  // namespace plat::synthesis
