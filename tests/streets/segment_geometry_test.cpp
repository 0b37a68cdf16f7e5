#include "streets/segment_geometry.h"

#include <set>

#include "core/planar_graph.h"

#include "core/working_grid.h"
#include "support/property.h"

namespace plat::streets {
namespace {

GrowthSite site_of(const std::vector<Point>& places) {
  GrowthSite site;
  PassingStreet street;
  street.distance_mean_m = 100.0;
  for (const Point p : places) site.points.push_back({p, street, {}, {}});
  return site;
}

double tortuosity_of(const Polyline& line) {
  return length_m(line) / distance(line.front(), line.back());
}

TEST(TortuousLine, IsAsTortuousAsWanted) {
  Rng rng = testing::property_rng("TortuousLine.IsAsTortuousAsWanted");
  for (int i = 0; i < testing::iterations(300); ++i) {
    const Point a = snap(Point{rng.uniform(-5000, 5000), rng.uniform(-5000, 5000)});
    const Point b = snap(a + Point{rng.uniform(5, 500), rng.uniform(-500, 500)});
    const double wanted = rng.uniform(1.0, 2.0);
    const Polyline line = tortuous_line(a, b, wanted, rng);
    ASSERT_EQ(line.front(), a);
    ASSERT_EQ(line.back(), b);
    ASSERT_NEAR(tortuosity_of(line), wanted, kTortuosityTolerance * wanted);
    for (std::size_t k = 0; k < line.size(); ++k) {
      ASSERT_TRUE(is_on_grid(line[k]));
      if (k > 0) {
        ASSERT_NE(line[k], line[k - 1]);
      }
    }
  }
}

TEST(TortuousLine, IsStraightForATortuosityOfOne) {
  Rng rng(1);
  EXPECT_EQ(tortuous_line({0, 0}, {100, 0}, 1.0, rng), (Polyline{{0, 0}, {100, 0}}));
  EXPECT_EQ(tortuous_line({0, 0}, {100, 0}, 0.5, rng).size(), 2U);
}

TEST(TortuousLine, TurnsALittleAtEachOfItsPointsOnly) {
  Rng rng(2);
  for (int i = 0; i < 50; ++i) {
    const Polyline line = tortuous_line({0, 0}, {200, 0}, 1.1, rng);
    for (std::size_t k = 1; k + 1 < line.size(); ++k)
      EXPECT_LT(std::abs(turn_rad(line, k)), 0.6) << "smooth to look at";
  }
}

TEST(TortuousLine, LeansToEitherSide) {
  Rng rng(3);
  std::set<bool> sides;
  for (int i = 0; i < 40; ++i) sides.insert(tortuous_line({0, 0}, {100, 0}, 1.1, rng)[1].y > 0.0);
  EXPECT_EQ(sides.size(), 2U);
}

TEST(BendSegment, IsAsTortuousAsWantedWhereThereIsRoom) {
  Rng rng(4);
  auto plane = GrowthPlane::over(site_of({{0, 0}, {100, 30}}));
  plane->add(0, 1);
  const Polyline line = bend_segment(*plane, 0, 1, 1.3, rng);
  ASSERT_GT(line.size(), 2U);
  EXPECT_NEAR(tortuosity_of(line), 1.3, 1.3 * kTortuosityTolerance);
}

TEST(BendSegment, BendsLessOrNotAtAllWhereThereIsNone) {
  Rng rng(5);
  // Between two rows of points, 4 m to each side.
  std::vector<Point> places{{0, 0}, {100, 0}};
  for (int x = 5; x < 100; x += 2) {
    places.push_back({static_cast<double>(x), 4.0});
    places.push_back({static_cast<double>(x), -4.0});
  }
  auto plane = GrowthPlane::over(site_of(places));
  plane->add(0, 1);
  for (std::uint32_t v = 2; v + 2 < places.size(); ++v) plane->add(v, v + 2);
  const Polyline line = bend_segment(*plane, 0, 1, 1.2, rng);
  for (const Point p : line) EXPECT_LT(std::abs(p.y), 4.0);
  EXPECT_GT(line.size(), 2U) << "a sixteenth of the amplitude fits";
  // No room at all: a neighbour a few grid steps away on either side.
  auto narrow = GrowthPlane::over(
      site_of({{0, 0}, {100, 0}, {0.5, 0.0625}, {99.5, 0.0625}, {0.5, -0.0625}, {99.5, -0.0625}}));
  narrow->add(0, 1);
  narrow->add(2, 3);
  narrow->add(4, 5);
  EXPECT_TRUE(bend_segment(*narrow, 0, 1, 1.2, rng).empty());
}

TEST(BendSegment, KeepsADenseGridPlanar) {
  Rng rng(6);
  constexpr std::uint32_t kSide = 12;
  std::vector<Point> places;
  for (std::uint32_t i = 0; i < kSide * kSide; ++i)
    places.push_back({20.0 * (i % kSide), 20.0 * static_cast<double>(i / kSide)});
  const GrowthSite site = site_of(places);
  auto plane = GrowthPlane::over(site);
  std::vector<GrownEdge> edges;
  for (std::uint32_t i = 0; i < kSide * kSide; ++i) {
    if (i % kSide + 1 < kSide) edges.push_back({.from = i, .to = i + 1});
    if (i + kSide < kSide * kSide) edges.push_back({.from = i, .to = i + kSide});
  }
  for (const GrownEdge& edge : edges) plane->add(edge.from, edge.to);
  int bent = 0;
  for (GrownEdge& edge : edges) {
    edge.line = bend_segment(*plane, edge.from, edge.to, 1.4, rng);
    if (!edge.line.empty()) ++bent;
  }
  EXPECT_GT(bent, 100);
  std::vector<Segment> segments;
  const Growth growth = assemble_growth(site, *plane, edges);
  for (const Street& street : growth.network.streets) {
    for (std::size_t i = 0; i + 1 < street.line.size(); ++i)
      segments.push_back({street.line[i], street.line[i + 1]});
  }
  EXPECT_EQ(node_segments(segments).edges.size(), segments.size());
}

}  // namespace
}  // namespace plat::streets
