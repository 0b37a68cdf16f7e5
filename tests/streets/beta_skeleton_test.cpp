#include "streets/beta_skeleton.h"

#include <numeric>

#include "core/working_grid.h"
#include "streets/made_sites.h"
#include "support/property.h"

namespace plat::streets {
namespace {

std::vector<Point> different_places(std::uint32_t number) {
  std::vector<Point> out;
  for (const IntersectionPoint& point : testing::made_site(12, number, 60).site.points)
    out.push_back(point.place);
  std::ranges::sort(out);
  const auto [first, last] = std::ranges::unique(out);
  out.erase(first, last);
  return out;
}

/// All pairs against all places; discs as [KR85] defines them.
std::vector<DelaunayEdge> by_definition(const std::vector<Point>& places, double beta) {
  std::vector<DelaunayEdge> out;
  for (std::uint32_t a = 0; a < places.size(); ++a) {
    for (std::uint32_t b = a + 1; b < places.size(); ++b) {
      const long double px = places[a].x, py = places[a].y, qx = places[b].x, qy = places[b].y;
      const long double half = static_cast<long double>(beta) / 2;
      const auto room = [&](Point r, long double cx, long double cy) {
        const long double dx = r.x - cx, dy = r.y - cy;
        const long double d2 = (qx - px) * (qx - px) + (qy - py) * (qy - py);
        return half * half * d2 - (dx * dx + dy * dy);
      };
      const bool is_empty = std::ranges::none_of(places, [&](Point r) {
        if (r == places[a] || r == places[b]) return false;
        const long double at_p = room(r, (1 - half) * px + half * qx, (1 - half) * py + half * qy);
        const long double at_q = room(r, half * px + (1 - half) * qx, half * py + (1 - half) * qy);
        return beta == 1.0 ? at_p >= 0 : at_p > 0 && at_q > 0;
      });
      if (is_empty) out.push_back({a, b});
    }
  }
  return out;
}

TEST(BetaSkeleton, IsWhatTryingAllPairsFinds) {
  std::size_t edges = 0;
  for (std::uint32_t number = 0; number < static_cast<std::uint32_t>(testing::iterations(150));
       ++number) {
    const auto places = different_places(number);
    // With these, every term has few enough digits for the oracle to be exact.
    for (const double beta : {1.0, 1.25, 1.5, 2.0, 3.0, 8.0}) {
      const auto expected = by_definition(places, beta);
      ASSERT_EQ(beta_skeleton(places, beta), expected)
          << "made_site(12, " << number << "), beta " << beta;
      edges += expected.size();
    }
  }
  EXPECT_GT(edges, 5000U);
}

TEST(BetaSkeleton, OfASquareHasItsSidesOnly) {
  const std::vector<Point> square{{0, 0}, {0, 100}, {100, 0}, {100, 100}};
  for (const double beta : {1.0, 1.1, 2.0})
    EXPECT_EQ(beta_skeleton(square, beta),
              (std::vector<DelaunayEdge>{{0, 1}, {0, 2}, {1, 3}, {2, 3}}))
        << beta;
}

TEST(BetaSkeleton, OfPlacesInALineJoinsNeighbours) {
  const std::vector<Point> line{{0, 0}, {30, 10}, {60, 20}, {300, 100}};
  for (const double beta : {1.0, 2.0, 8.0})
    EXPECT_EQ(beta_skeleton(line, beta), (std::vector<DelaunayEdge>{{0, 1}, {1, 2}, {2, 3}}));
}

TEST(BetaSkeleton, IsASubsetForALargerBeta) {
  for (std::uint32_t number = 0; number < 60; ++number) {
    const auto places = different_places(number);
    std::vector<DelaunayEdge> before = beta_skeleton(places, 1.0);
    for (const double beta : {1.3, 1.7, 2.0, 4.0}) {
      const auto edges = beta_skeleton(places, beta);
      EXPECT_TRUE(std::ranges::includes(before, edges));
      before = edges;
    }
  }
}

TEST(BetaSkeleton, ConnectsAllPlacesUpToTwo) {
  for (std::uint32_t number = 0; number < 60; ++number) {
    const auto places = different_places(number);
    if (places.empty()) continue;
    std::vector<std::uint32_t> part(places.size());
    std::iota(part.begin(), part.end(), 0U);
    std::size_t parts = places.size();
    for (const auto& [a, b] : beta_skeleton(places, 2.0)) {
      const std::uint32_t from = part[a];
      const std::uint32_t to = part[b];
      parts -= from != to ? 1 : 0;
      for (std::uint32_t& p : part)
        if (p == from) p = to;
    }
    EXPECT_EQ(parts, 1U) << number;
  }
}

TEST(BetaSkeleton, LunesAreExactOnTheGrid) {
  // The third place is a grid step inside or on the circle about p through q.
  const Point p{0, 0};
  const Point q{30'000.0, 0.0};
  const Point on{18'000.0, 24'000.0};
  EXPECT_FALSE(is_in_lune(p, q, on, 2.0));
  EXPECT_TRUE(is_in_lune(p, q, on - Point{kGridStep_m, 0.0}, 2.0));
  EXPECT_FALSE(is_in_lune(p, q, on + Point{kGridStep_m, 0.0}, 2.0));
  const Point rim = midpoint(p, q) + Point{9'000.0, 12'000.0};
  EXPECT_TRUE(is_in_lune(p, q, rim, 1.0));
  EXPECT_FALSE(is_in_lune(p, q, rim + Point{kGridStep_m, 0.0}, 1.0));
}

}  // namespace
}  // namespace plat::streets
