// What is special to the growers that know distances or arrangement only.
#include <cmath>
#include <set>

#include "streets/beta_skeleton.h"
#include "streets/growth_contract.h"
#include "streets/made_sites.h"
#include "streets/nearest_grower.h"
#include "streets/proximity_growth.h"
#include "streets/relative_neighbourhood_grower.h"
#include "support/property.h"

namespace plat::streets {
namespace {

using plat::testing::iterations;
using plat::testing::made_site;
using plat::testing::SiteFamily;

Growth grown(const auto& grower, const GrowthSite& site) {
  Rng rng(1);
  auto growth = grower.grow(site, rng);
  EXPECT_TRUE(growth.has_value());
  return *std::move(growth);
}

std::span<const Street> grown_streets(const GrowthSite& site, const Growth& growth) {
  return std::span(growth.network.streets).subspan(site.existing.streets.size());
}

std::map<Point, std::uint32_t> grown_degrees(const GrowthSite& site, const Growth& growth) {
  std::map<Point, std::uint32_t> out;
  for (const Street& street : grown_streets(site, growth)) {
    ++out[street.line.front()];
    ++out[street.line.back()];
  }
  return out;
}

/// Open ends and streets of points at each place.
struct Allowed {
  std::uint32_t by_points = 0;
  std::uint32_t by_open_ends = 0;
};
std::map<Point, Allowed> allowed_at(const GrowthSite& site) {
  std::map<Point, Allowed> out;
  for (const IntersectionPoint& point : site.points)
    for (const PassingStreet& street : streets_of(point))
      out[point.place].by_points += static_cast<std::uint32_t>(street.connections);
  for (const OpenEnd& end : site.open_ends) ++out[site.existing.nodes[end.node]].by_open_ends;
  return out;
}

GrowthSite with_points_turned_round(const GrowthSite& site) {
  GrowthSite out = site;
  std::ranges::reverse(out.points);
  std::ranges::reverse(out.open_ends);
  return out;
}

void expect_same_whatever_the_order(const auto& grower, std::uint64_t seed) {
  for (int i = 0; i < iterations(80); ++i) {
    const GrowthSite site = made_site(seed, static_cast<std::uint32_t>(i)).site;
    const Growth one = grown(grower, site);
    const Growth other = grown(grower, with_points_turned_round(site));
    ASSERT_EQ(one.network.nodes, other.network.nodes);
    ASSERT_EQ(one.segments.size(), other.segments.size());
    for (std::size_t s = 0; s < one.network.streets.size(); ++s) {
      ASSERT_EQ(one.network.streets[s].line, other.network.streets[s].line);
      ASSERT_EQ(one.network.streets[s].width_m, other.network.streets[s].width_m);
    }
    for (std::size_t s = 0; s < one.segments.size(); ++s)
      ASSERT_EQ(one.segments[s].hierarchy, other.segments[s].hierarchy);
  }
}

IntersectionPoint crossing_at(Point place, double distance_m) {
  PassingStreet street;
  street.distance_mean_m = distance_m;
  street.width_m = 10.0;
  return {place, street, street, std::nullopt};
}

GrowthSite regular_grid(int side, double step_m) {
  GrowthSite site;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x)
      site.points.push_back(crossing_at({step_m * x, step_m * y}, step_m));
  return site;
}

// ---- nearest ----

TEST(NearestGrower, GrowsAGridOnAGrid) {
  const GrowthSite site = regular_grid(6, 80.0);
  const Growth growth = grown(NearestGrower({}), site);
  EXPECT_EQ(growth.segments.size(), 60U);
  for (const Street& street : growth.network.streets)
    EXPECT_EQ(distance(street.line.front(), street.line.back()), 80.0);
}

TEST(NearestGrower, KeepsToTheConnectionsOfPointsAndOpenEnds) {
  int full = 0;
  for (int i = 0; i < iterations(200); ++i) {
    const GrowthSite site = made_site(21, static_cast<std::uint32_t>(i)).site;
    const auto allowed = allowed_at(site);
    for (const auto& [place, degree] : grown_degrees(site, grown(NearestGrower({}), site))) {
      const Allowed most = allowed.at(place);
      ASSERT_LE(degree, most.by_points + most.by_open_ends);
      full += degree == most.by_points + most.by_open_ends ? 1 : 0;
    }
    const NearestGrower sparing({.max_connections = 2.0});
    for (const auto& [place, degree] : grown_degrees(site, grown(sparing, site)))
      ASSERT_LE(degree, 2U);
  }
  EXPECT_GT(full, 200);
}

TEST(NearestGrower, GrowsNoStreetLongerThanItsSitesLargestLength) {
  GrowthSite site = regular_grid(2, 100.0);
  for (const IntersectionPoint& point : std::vector(site.points))
    site.points.push_back(crossing_at(point.place + Point{0.0, 140.0}, 100.0));
  const auto longest = [&](std::optional<double> deviations) {
    double out = 0.0;
    const Growth growth = grown(NearestGrower({.length_deviations = deviations}), site);
    for (const Street& street : growth.network.streets) out = std::max(out, length_m(street.line));
    return out;
  };
  EXPECT_EQ(longest(2.0), 100.0) << "no deviation";
  EXPECT_GT(longest(std::nullopt), 139.0);
  // Half of the streets at 50 m, half at 150: mean 100, deviation 50.
  for (std::size_t i = 0; i < site.points.size(); ++i)
    site.points[i].a.distance_mean_m = site.points[i].b->distance_mean_m = i % 2 == 0 ? 50 : 150;
  EXPECT_EQ(longest(0.0), 100.0);
  EXPECT_LT(longest(0.5), 125.0);
  EXPECT_GT(longest(1.0), 139.0);
}

/// All pairs, sorted; what near means by counting.
TEST(NearestGrower, IsGreedyByDistance) {
  std::size_t streets = 0;
  for (int i = 0; i < iterations(150); ++i) {
    const GrowthSite site = made_site(22, static_cast<std::uint32_t>(i)).site;
    const int neighbours = 1 + i % 7;
    const Growth growth =
        grown(NearestGrower({.length_deviations = std::nullopt, .neighbours = neighbours}), site);
    auto plane = GrowthPlane::over(site);
    ASSERT_TRUE(plane.has_value());
    std::vector<Socket> sockets = sockets_of(site, *plane);
    const auto squared_m2 = [&](std::size_t a, std::size_t b) {
      return squared_length(sockets[a].place - sockets[b].place);
    };
    const auto is_near = [&](std::size_t a, std::size_t b) {
      int nearer = 0;
      for (std::size_t c = 0; c < sockets.size(); ++c)
        if (c != a && std::pair(squared_m2(a, c), c) < std::pair(squared_m2(a, b), b)) ++nearer;
      return nearer < neighbours;
    };
    std::vector<std::tuple<double, std::size_t, std::size_t>> pairs;
    for (std::size_t a = 0; a < sockets.size(); ++a)
      for (std::size_t b = a + 1; b < sockets.size(); ++b)
        if (is_near(a, b) || is_near(b, a)) pairs.emplace_back(squared_m2(a, b), a, b);
    std::ranges::sort(pairs);
    std::size_t at = site.existing.streets.size();
    for (const auto& [d, a, b] : pairs) {
      if (sockets[a].free_connections == 0 || sockets[b].free_connections == 0) continue;
      if (!plane->admits(sockets[a].vertex, sockets[b].vertex)) continue;
      plane->add(sockets[a].vertex, sockets[b].vertex);
      --sockets[a].free_connections;
      --sockets[b].free_connections;
      ASSERT_LT(at, growth.network.streets.size());
      ASSERT_EQ(growth.network.streets[at].line, (Polyline{sockets[a].place, sockets[b].place}));
      ++at;
    }
    ASSERT_EQ(at, growth.network.streets.size());
    streets += growth.segments.size();
  }
  EXPECT_GT(streets, 1000U);
}

TEST(NearestGrower, DoesNotDependOnTheOrderOfThePoints) {
  expect_same_whatever_the_order(NearestGrower({}), 23);
}

TEST(NearestGrower, PassesNoPointNearerThanItsShareOfItsWidth) {
  // Three points on a line but for two metres: from end to end runs over the one between.
  GrowthSite site;
  for (const Point place : {Point{0, 0}, Point{50, 2}, Point{100, 0}})
    site.points.push_back(crossing_at(place, 100.0));
  const auto streets = [&](double clearance_widths) {
    return grown(NearestGrower({.clearance_widths = clearance_widths}), site).segments.size();
  };
  EXPECT_EQ(streets(0.0), 3U);
  EXPECT_EQ(streets(0.1), 3U) << "a metre of ten";
  EXPECT_EQ(streets(0.5), 2U) << "five metres of ten";
}

// ---- relative_neighbourhood ----

TEST(RelativeNeighbourhoodGrower, IsTheSkeletonWhereNothingBarsIt) {
  std::size_t streets = 0;
  for (int i = 0; i < iterations(150); ++i) {
    const auto made = made_site(24, static_cast<std::uint32_t>(i));
    GrowthSite site;
    site.points = made.site.points;
    std::set<Point> different;
    for (const IntersectionPoint& point : site.points) different.insert(point.place);
    const std::vector<Point> places(different.begin(), different.end());
    for (const double beta : {1.0, 2.0}) {
      std::set<std::pair<Point, Point>> expected;
      for (const auto& [a, b] : beta_skeleton(places, beta)) expected.emplace(places[a], places[b]);
      const Growth growth = grown(RelativeNeighbourhoodGrower({.beta = beta}), site);
      std::set<std::pair<Point, Point>> found;
      for (const Street& street : growth.network.streets)
        found.emplace(street.line.front(), street.line.back());
      ASSERT_TRUE(std::ranges::includes(expected, found));
      // Of points millimetres apart, noding would bend one street onto another.
      if (made.family != SiteFamily::kDense && made.family != SiteFamily::kNearCollinear) {
        ASSERT_EQ(found, expected) << "made_site(24, " << i << "), beta " << beta;
      }
      streets += found.size();
    }
  }
  EXPECT_GT(streets, 2000U);
}

TEST(RelativeNeighbourhoodGrower, LeavesOutOnlyWhatIsBarred) {
  int barred = 0;
  for (int i = 0; i < iterations(150); ++i) {
    const GrowthSite site = made_site(25, static_cast<std::uint32_t>(i)).site;
    const Growth growth = grown(RelativeNeighbourhoodGrower({}), site);
    auto plane = GrowthPlane::over(site);
    const std::vector<Socket> sockets = sockets_of(site, *plane);
    std::vector<Point> places;
    for (const Socket& socket : sockets) places.push_back(socket.place);
    std::set<std::pair<Point, Point>> found;
    for (const Street& street : grown_streets(site, growth)) {
      found.emplace(street.line.front(), street.line.back());
      const auto vertex = [&](Point p) {
        return std::ranges::find(sockets, p, &Socket::place)->vertex;
      };
      plane->add(vertex(street.line.front()), vertex(street.line.back()));
    }
    const auto degrees = grown_degrees(site, growth);
    for (const auto& [a, b] : beta_skeleton(places, 2.0)) {
      if (found.erase({places[a], places[b]}) == 1) continue;
      const auto is_used_up = [&](const Socket& socket) {
        return !socket.has_point && degrees.contains(socket.place) &&
               degrees.at(socket.place) == socket.free_connections;
      };
      ASSERT_TRUE(is_used_up(sockets[a]) || is_used_up(sockets[b]) ||
                  !plane->admits(sockets[a].vertex, sockets[b].vertex));
      ++barred;
    }
    ASSERT_TRUE(found.empty()) << "a street that is not in the skeleton";
  }
  EXPECT_GT(barred, 200);
}

TEST(RelativeNeighbourhoodGrower, ConnectsAnOpenEndOnce) {
  int open_ends = 0;
  for (int i = 0; i < iterations(200); ++i) {
    const GrowthSite site = made_site(26, static_cast<std::uint32_t>(i)).site;
    const auto allowed = allowed_at(site);
    const auto growth = grown(RelativeNeighbourhoodGrower({.beta = 1.0}), site);
    for (const auto& [place, degree] : grown_degrees(site, growth)) {
      const Allowed most = allowed.at(place);
      if (most.by_points > 0) continue;
      ASSERT_LE(degree, most.by_open_ends);
      ++open_ends;
    }
  }
  EXPECT_GT(open_ends, 100);
}

TEST(RelativeNeighbourhoodGrower, DoesNotDependOnTheOrderOfThePoints) {
  expect_same_whatever_the_order(RelativeNeighbourhoodGrower({}), 27);
}

// ---- levels and widths of both ----

TEST(SegmentStyle, IsTheHighestCommonLevelWithTheMeanOfItsWidths) {
  const auto street = [](int level, double width_m) {
    PassingStreet out;
    out.hierarchy = level;
    out.width_m = width_m;
    return out;
  };
  const auto socket = [](std::vector<PassingStreet> streets) {
    Socket out;
    out.streets = std::move(streets);
    return out;
  };
  const Socket main_and_side = socket({street(0, 30), street(2, 10)});
  const Socket side_and_lane = socket({street(2, 12), street(3, 6)});
  const Socket lane = socket({street(3, 0)});
  EXPECT_EQ(style_between(main_and_side, main_and_side).hierarchy, 0);
  EXPECT_EQ(style_between(main_and_side, side_and_lane).hierarchy, 2);
  EXPECT_EQ(style_between(main_and_side, side_and_lane).width_m, 11.0);
  EXPECT_EQ(style_between(main_and_side, lane).hierarchy, 3) << "the deeper main street";
  EXPECT_EQ(style_between(main_and_side, lane).width_m, 10.0) << "the lane knows none";
  EXPECT_EQ(style_between(lane, main_and_side).hierarchy, 3);
  EXPECT_EQ(style_between(lane, lane).width_m, 0.0);
}

}  // namespace
}  // namespace plat::streets
