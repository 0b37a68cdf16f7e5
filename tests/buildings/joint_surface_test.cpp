#include "buildings/joint_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "core/polygon.h"
#include "core/working_grid.h"
#include "support/property.h"

namespace plat::buildings {
namespace {

/// The rim that a solid before the plane leaves: its section walked clockwise. After: the other
/// way.
enum class Solid { kBefore, kAfter };
void add_rim(std::vector<Segment>& rim, Ring section, Solid solid) {
  if (solid == Solid::kBefore) std::ranges::reverse(section);
  for (std::size_t i = 0; i < section.size(); ++i)
    rim.push_back({section[i], section[(i + 1) % section.size()]});
}

double wall_area_m2(const JointSurface& surface) {
  double sum = 0.0;
  for (const auto& wall : surface.walls)
    sum += 0.5 * orientation(wall.corners[0], wall.corners[1], wall.corners[2]);
  return sum;
}

/// Directed edges that chains and walls leave without their opposite.
std::size_t unmatched_edges(const JointSurface& surface) {
  std::map<std::pair<Point, Point>, int> uses;
  const auto use = [&](Point a, Point b) {
    ++uses[{a, b}];
    --uses[{b, a}];
  };
  for (const auto& chain : surface.chains)
    for (std::size_t i = 0; i + 1 < chain.size(); ++i) use(chain[i], chain[i + 1]);
  for (const auto& [corners, is_outward] : surface.walls) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Point a = corners[i];
      const Point b = corners[(i + 1) % 3];
      is_outward ? use(a, b) : use(b, a);
    }
  }
  return static_cast<std::size_t>(
      std::ranges::count_if(uses, [](const auto& edge) { return edge.second != 0; }));
}

Ring box(double west, double south, double east, double north) {
  return {{west, south}, {east, south}, {east, north}, {west, north}};
}

TEST(JointSurface, PutsNoWallBetweenEqualSections) {
  std::vector<Segment> rim;
  add_rim(rim, box(-5, 0, 5, 9), Solid::kBefore);
  add_rim(rim, box(-5, 0, 5, 9), Solid::kAfter);
  const JointSurface surface = joint_surface(rim);
  EXPECT_TRUE(surface.walls.empty());
  EXPECT_EQ(unmatched_edges(surface), 0U);
}

TEST(JointSurface, ClosesWhatOneSideHasMore) {
  std::vector<Segment> rim;
  add_rim(rim, box(-5, 0, 5, 9), Solid::kBefore);
  add_rim(rim, box(-5, 0, 5, 12), Solid::kAfter);
  const JointSurface surface = joint_surface(rim);
  EXPECT_DOUBLE_EQ(wall_area_m2(surface), 30.0);
  for (const auto& wall : surface.walls) EXPECT_FALSE(wall.is_outward);
  EXPECT_EQ(unmatched_edges(surface), 0U);
}

TEST(JointSurface, WeldsSidesWhoseVerticesDiffer) {
  std::vector<Segment> rim;
  add_rim(rim, {{-5, 0}, {0, 0}, {5, 0}, {5, 3}, {5, 9}, {-5, 9}}, Solid::kBefore);
  add_rim(rim, box(-5, 0, 5, 9), Solid::kAfter);
  const JointSurface surface = joint_surface(rim);
  EXPECT_TRUE(surface.walls.empty());
  EXPECT_EQ(unmatched_edges(surface), 0U);
  EXPECT_EQ(surface.chains[6], (std::vector<Point>{{-5, 0}, {0, 0}, {5, 0}}));
}

TEST(JointSurface, ClosesASideThatMeetsNothing) {
  std::vector<Segment> rim;
  add_rim(rim, box(-5, 0, 5, 9), Solid::kBefore);
  const JointSurface surface = joint_surface(rim);
  EXPECT_DOUBLE_EQ(wall_area_m2(surface), 90.0);
  for (const auto& wall : surface.walls) EXPECT_TRUE(wall.is_outward);
  EXPECT_EQ(unmatched_edges(surface), 0U);
}

TEST(JointSurface, WallsAreTheDisagreementOfRandomSections) {
  Rng rng = testing::property_rng("JointSurface.WallsAreTheDisagreementOfRandomSections");
  int crossing = 0;
  for (int i = 0; i < testing::iterations(200); ++i) {
    const auto random_box = [&] {
      const double west = std::floor(rng.uniform(-8, 2));
      const double south = std::floor(rng.uniform(0, 6));
      return std::array{west, south, west + 1 + std::floor(rng.uniform(0, 9)),
                        south + 1 + std::floor(rng.uniform(0, 9))};
    };
    const auto a = random_box();
    const auto b = random_box();
    std::vector<Segment> rim;
    add_rim(rim, box(a[0], a[1], a[2], a[3]), Solid::kBefore);
    add_rim(rim, box(b[0], b[1], b[2], b[3]), Solid::kAfter);
    const JointSurface surface = joint_surface(rim);
    const double common = std::max(0.0, std::min(a[2], b[2]) - std::max(a[0], b[0])) *
                          std::max(0.0, std::min(a[3], b[3]) - std::max(a[1], b[1]));
    const double disagreement =
        (a[2] - a[0]) * (a[3] - a[1]) + (b[2] - b[0]) * (b[3] - b[1]) - 2.0 * common;
    EXPECT_DOUBLE_EQ(wall_area_m2(surface), disagreement);
    EXPECT_EQ(unmatched_edges(surface), 0U);
    crossing += common > 0.0 && disagreement > 0.0 ? 1 : 0;
  }
  EXPECT_GT(crossing, testing::iterations(50));
}

}  // namespace
}  // namespace plat::buildings
