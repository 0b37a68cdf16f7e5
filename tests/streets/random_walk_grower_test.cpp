#include "streets/random_walk_grower.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "streets/growth_contract.h"
#include "streets/made_sites.h"
#include "support/property.h"

namespace plat::streets {
namespace {

using Options = RandomWalkGrower::Options;
using PlacePair = std::pair<Point, Point>;

PassingStreet style(int level, double distance_m = 100.0, double deviation_m = 15.0) {
  PassingStreet street;
  street.hierarchy = level;
  street.distance_mean_m = distance_m;
  street.distance_variance_m2 = deviation_m * deviation_m;
  street.angle_variance_rad2 = 0.04;
  street.width_m = 10.0;
  return street;
}

/// Points with one street each.
GrowthSite site_of(const std::vector<Point>& places, const PassingStreet& street = style(0)) {
  GrowthSite site;
  for (const Point p : places) site.points.push_back({p, street, {}, {}});
  return site;
}

/// An existing street between two nodes of the site's network.
Street existing_street(const GrowthSite& site, std::uint32_t from, std::uint32_t to) {
  Street street;
  street.from = from;
  street.to = to;
  street.line = {site.existing.nodes[from], site.existing.nodes[to]};
  street.width_m = 10.0;
  return street;
}

/// An existing street that comes from a place west or south of the origin and may go on there.
GrowthSite with_open_end(const std::vector<Point>& places, const PassingStreet& street = style(0),
                         Point from = {-50, 0}) {
  GrowthSite site = site_of(places, street);
  site.existing.nodes = {from, {0, 0}};
  site.existing.streets = {existing_street(site, 0, 1)};
  site.open_ends = {{1, style(0), normalized(Point{} - from)}};
  return site;
}

Growth grow(const GrowthSite& site, const Options& options = {}, std::uint64_t seed = 1) {
  Rng rng(seed);
  auto growth = RandomWalkGrower(options).grow(site, rng);
  EXPECT_TRUE(growth.has_value()) << (growth ? "" : growth.error().message);
  return growth ? std::move(*growth) : Growth{};
}

PlacePair between(Point a, Point b) { return std::minmax(a, b); }

std::set<PlacePair> connected(const Growth& growth) {
  std::set<PlacePair> out;
  for (const Street& street : growth.network.streets)
    out.insert(between(street.line.front(), street.line.back()));
  return out;
}

std::size_t connections_at(const Growth& growth, Point place) {
  std::size_t count = 0;
  for (const PlacePair& pair : connected(growth))
    count += pair.first == place || pair.second == place;
  return count;
}

/// A town of columns x rows points, 100 m and 140 m apart, with all streets of a grid through them.
GrowthSite grid(int columns, int rows, const PassingStreet& along_x, const PassingStreet& along_y) {
  GrowthSite site;
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x)
      site.points.push_back({{100.0 * x, 140.0 * y}, along_x, along_y, {}});
  }
  return site;
}

std::set<PlacePair> grid_edges(int columns, int rows) {
  std::set<PlacePair> edges;
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) {
      const Point p{100.0 * x, 140.0 * y};
      if (x + 1 < columns) edges.insert({p, p + Point{100, 0}});
      if (y + 1 < rows) edges.insert({p, p + Point{0, 140}});
    }
  }
  return edges;
}

TEST(RandomWalk, RecoversAGridExactly) {
  EXPECT_EQ(connected(grow(grid(7, 5, style(0, 100, 8), style(1, 140, 8)))), grid_edges(7, 5));
  EXPECT_EQ(connected(grow(grid(6, 6, style(2, 140, 8), style(2, 100, 8)))), grid_edges(6, 6))
      << "one level only";
}

TEST(RandomWalk, StreetsHaveTheLevelAndWidthOfTheirPoints) {
  PassingStreet wide = style(1);
  wide.width_m = 20.0;
  GrowthSite site = site_of({{0, 0}, {100, 0}}, style(1));
  site.points[1].a = wide;
  const Growth growth = grow(site);
  ASSERT_EQ(growth.segments.size(), 1U);
  EXPECT_EQ(growth.segments[0].hierarchy, 1);
  EXPECT_EQ(growth.network.streets[0].width_m, 15.0);
}

TEST(RandomWalk, SegmentsOfOneStreetShareItsNumber) {
  const Growth growth = grow(site_of({{0, 0}, {100, 0}, {200, 0}, {0, 5000}, {100, 5000}}));
  ASSERT_EQ(growth.segments.size(), 3U);
  std::set<std::uint32_t> of_three;
  std::set<std::uint32_t> numbers;
  for (std::size_t i = 0; i < 3; ++i) {
    numbers.insert(growth.segments[i].street);
    if (growth.network.streets[i].line.front().y == 0.0) of_three.insert(growth.segments[i].street);
  }
  EXPECT_EQ(of_three.size(), 1U);
  EXPECT_EQ(numbers, (std::set<std::uint32_t>{0, 1}));
}

// ---- each constraint, and what happens without it ----

TEST(RandomWalk, StreetsGoToPointsOfTheirLevelOnly) {
  GrowthSite site = site_of({{0, 0}, {100, 0}});
  site.points[1].a.hierarchy = 1;
  EXPECT_TRUE(grow(site).segments.empty());
  EXPECT_EQ(grow(site, {.levels = RandomWalkGrower::Levels::kIgnored}).segments.size(), 1U);
}

TEST(RandomWalk, TwoConnectionsForEachStreetOfAPoint) {
  // A point of one street, with three others around it that are too far from each other.
  const std::vector<Point> star{{0, 0}, {100, 0}, {-50, 87}, {-50, -87}};
  PassingStreet street = style(0);
  street.angle_variance_rad2 = 4.0;
  GrowthSite site = site_of(star, street);
  EXPECT_EQ(connections_at(grow(site), {0, 0}), 2U);
  EXPECT_EQ(connections_at(grow(site, {.connections = RandomWalkGrower::Connections::kUnlimited}),
                           {0, 0}),
            3U);
  const Options observed{.connections = RandomWalkGrower::Connections::kObserved};
  site.points[0].a.connections = 1;
  EXPECT_EQ(connections_at(grow(site, observed), {0, 0}), 1U);
  site.points[0].b = street;
  EXPECT_EQ(connections_at(grow(site, observed), {0, 0}), 3U);
}

TEST(RandomWalk, StepsBelowTheThresholdAreNotTaken) {
  // 130 m are two deviations of 15 m off: exp(-2) = 0.135.
  const GrowthSite site = site_of({{0, 0}, {130, 0}});
  const Options blind{.threshold = 0.13, .first_step = RandomWalkGrower::FirstStep::kBlind};
  EXPECT_EQ(grow(site, blind).segments.size(), 1U);
  Options strict = blind;
  strict.threshold = 0.14;
  EXPECT_TRUE(grow(site, strict).segments.empty());
}

TEST(RandomWalk, PrefersTheMeanDistance) {
  // From the middle, 100 m to one side are likelier than 75 m to the other; all have one
  // connection.
  GrowthSite site = site_of({{0, 0}, {100, 0}, {-75, 0}});
  for (IntersectionPoint& point : site.points) point.a.connections = 1;
  Options options{.connections = RandomWalkGrower::Connections::kObserved};
  EXPECT_EQ(connected(grow(site, options)), (std::set{between({0, 0}, {100, 0})}));
  options.distance = AxisUse::kIgnored;
  std::swap(site.points[1], site.points[2]);  // equal: the lower vertex
  EXPECT_EQ(connected(grow(site, options)), (std::set{between({0, 0}, {-75, 0})}));
}

TEST(RandomWalk, PrefersTheMeanAngle) {
  // From the open end at the origin, which heads east: straight on rather than to the left.
  const GrowthSite site = with_open_end({{0, 100}, {100, 0}});
  EXPECT_TRUE(connected(grow(site)).contains(between({0, 0}, {100, 0})));
  EXPECT_FALSE(connected(grow(site)).contains(between({0, 0}, {0, 100})));
  const auto ignored = connected(grow(site, {.angle = AxisUse::kIgnored}));
  EXPECT_TRUE(ignored.contains(between({0, 0}, {0, 100}))) << "equal: the lower vertex";
}

TEST(RandomWalk, NoStepCrossesAStreet) {
  GrowthSite site = site_of({{0, 0}, {100, 0}, {50, -50}, {50, 50}});
  site.points[2].a = site.points[3].a = style(1);
  EXPECT_EQ(connected(grow(site)), (std::set{between({0, 0}, {100, 0})}));
  const Growth noded = grow(site, {.crossings = RandomWalkGrower::Crossings::kNoded});
  EXPECT_EQ(noded.network.streets.size(), 4U);
  EXPECT_EQ(connections_at(noded, {50, 0}), 4U);
  const Growth tee = grow(site, {.crossings = RandomWalkGrower::Crossings::kTee});
  EXPECT_EQ(connections_at(tee, {50, 0}), 3U) << "from the side that came first";
  EXPECT_EQ(tee.left_alone.size(), 1U);
}

TEST(RandomWalk, NoStreetRunsOverAPoint) {
  GrowthSite site = site_of({{0, 0}, {100, 0}, {50, 4}});
  site.points[2].a = style(3, 10.0);
  EXPECT_TRUE(grow(site).segments.empty()) << "4 m beside the middle of a street of 10 m";
  EXPECT_EQ(grow(site, {.clearance_widths = 0.3}).segments.size(), 1U);
  site.points[2].place = {50, 5.5};
  EXPECT_EQ(grow(site).segments.size(), 1U);
}

TEST(RandomWalk, AStepFitsItsTargetToo) {
  // The nearer target is used to streets of 300 m.
  GrowthSite site = site_of({{0, 0}, {100, 0}});
  site.points[1].a = style(0, 300.0);
  EXPECT_TRUE(grow(site).segments.empty());
  EXPECT_EQ(grow(site, {.view = RandomWalkGrower::View::kBase}).segments.size(), 1U);
}

TEST(RandomWalk, AFirstStepLooksAtHowTheStreetGoesOn) {
  // The point at the origin lies between two others on a line; one aside is at the mean distance.
  // It alone sees the others.
  GrowthSite site = site_of({{0, 0}, {110, 0}, {-110, 0}, {0, 100}}, style(0, 1000.0));
  site.points[0].a = style(0);
  Options options{.view = RandomWalkGrower::View::kBase};
  const auto ahead = connected(grow(site, options));
  EXPECT_TRUE(ahead.contains(between({0, 0}, {110, 0})));
  EXPECT_TRUE(ahead.contains(between({0, 0}, {-110, 0})));
  options.first_step = RandomWalkGrower::FirstStep::kBlind;
  EXPECT_TRUE(connected(grow(site, options)).contains(between({0, 0}, {0, 100})));
}

TEST(RandomWalk, DrawsTargetsByProbability) {
  // Two targets of an open end, one at the mean, one a deviation off: exp(-1/2) = 0.61, so 62 : 38.
  GrowthSite site = site_of({{100, 0}, {-85, 0}});
  for (IntersectionPoint& point : site.points) point.a.connections = 1;
  site.points.insert(site.points.begin(), {{0, 0}, style(0), {}, {}});
  site.points[0].a.connections = 1;
  Options options{.connections = RandomWalkGrower::Connections::kObserved,
                  .selection = RandomWalkGrower::Selection::kSampled,
                  .view = RandomWalkGrower::View::kBase};
  int to_mean = 0;
  constexpr int kRounds = 1000;
  for (std::uint64_t seed = 0; seed < kRounds; ++seed) {
    // The ends see the middle with the same probabilities; only the walk from the middle chooses.
    GrowthSite one = site;
    one.points[1].a.distance_mean_m = one.points[2].a.distance_mean_m = 1000.0;
    to_mean += connected(grow(one, options, seed)).contains(between({0, 0}, {100, 0})) ? 1 : 0;
  }
  EXPECT_NEAR(to_mean, 622, 50);
  options.selection = RandomWalkGrower::Selection::kLikeliest;
  EXPECT_TRUE(connected(grow(site, options)).contains(between({0, 0}, {100, 0})));
}

TEST(RandomWalk, TakesTheMostCertainStepFirst) {
  // From the west, the point in the middle is one of two likely ones; from the east, the only one.
  GrowthSite site = site_of({{0, 0}, {-100, 0}, {-100, 100}, {110, 0}});
  for (IntersectionPoint& point : site.points) point.a.connections = 1;
  const Options observed{.connections = RandomWalkGrower::Connections::kObserved};
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const auto edges = connected(grow(site, observed, seed));
    EXPECT_TRUE(edges.contains(between({-100, 0}, {-100, 100})));
    EXPECT_TRUE(edges.contains(between({0, 0}, {110, 0})));
  }
  Options random = observed;
  random.start = RandomWalkGrower::Start::kRandom;
  std::set<std::set<PlacePair>> found;
  for (std::uint64_t seed = 0; seed < 40; ++seed) found.insert(connected(grow(site, random, seed)));
  EXPECT_GT(found.size(), 1U);
}

TEST(RandomWalk, SegmentsAreAsTortuousAsTheirPoints) {
  GrowthSite site = site_of({{0, 0}, {100, 0}});
  site.points[0].a.tortuosity = 1.1;
  site.points[1].a.tortuosity = 1.3;
  EXPECT_NEAR(length_m(grow(site).network.streets.at(0).line), 120.0, 1.2);
  const Growth straight = grow(site, {.curves = RandomWalkGrower::Curves::kStraight});
  EXPECT_EQ(straight.network.streets.at(0).line.size(), 2U);
}

// ---- joining what exists ----

TEST(RandomWalk, AnOpenEndGoesOnOnce) {
  GrowthSite site = with_open_end({{100, 0}, {100, 20}, {100, -20}});
  const std::vector<OpenEnd> ends = std::exchange(site.open_ends, {});
  EXPECT_FALSE(connected(grow(site)).contains(between({0, 0}, {100, 0}))) << "no open end";
  site.open_ends = ends;
  const Growth growth = grow(site);
  EXPECT_EQ(connections_at(growth, {0, 0}), 2U);
  EXPECT_TRUE(connected(growth).contains(between({0, 0}, {100, 0})));
}

TEST(RandomWalk, AnOpenEndDoesNotGoOnBackwards) {
  // The way it came does not lie on the line through both points: they could be one street.
  GrowthSite site = with_open_end({{100, 0}, {-100, 0}}, style(0), {0, -50});
  site.open_ends[0].heading = {1, 0};
  EXPECT_EQ(connections_at(grow(site), {0, 0}), 2U);
}

TEST(RandomWalk, NoStepIsImprobableSeenFromEitherEnd) {
  // Right for the point, but the open end heads north.
  const GrowthSite site = with_open_end({{100, 0}}, style(0), {0, -50});
  EXPECT_TRUE(grow(site).segments.empty());
  EXPECT_EQ(grow(site, {.view = RandomWalkGrower::View::kBase}).segments.size(), 1U);
}

TEST(RandomWalk, AnOpenEndIsJoinedWhateverTheLevelAndDistance) {
  const GrowthSite site = with_open_end({{30, 10}}, style(3));
  EXPECT_TRUE(connected(grow(site)).contains(between({0, 0}, {30, 10})));
  EXPECT_TRUE(grow(site, {.open_ends = RandomWalkGrower::OpenEnds::kByLevel}).segments.empty());
}

TEST(RandomWalk, AnOpenEndIsJoinedAheadAndNear) {
  EXPECT_TRUE(grow(with_open_end({{-10, 30}}, style(3))).segments.empty()) << "turns back";
  EXPECT_TRUE(grow(with_open_end({{400, 0}}, style(3))).segments.empty()) << "too far";
  const Growth growth = grow(with_open_end({{40, 0}, {30, 25}}, style(3, 500.0)));
  EXPECT_TRUE(connected(growth).contains(between({0, 0}, {40, 0}))) << "the one straight on";
  EXPECT_EQ(connections_at(growth, {0, 0}), 2U);
}

TEST(RandomWalk, AnOpenEndIsJoinedToWhatIsFree) {
  // A street from south to north passes the point and leaves it no slot.
  const GrowthSite site = with_open_end({{40, -100}, {40, 0}, {40, 100}}, style(3));
  const Growth growth = grow(site);
  EXPECT_TRUE(connected(growth).contains(between({40, -100}, {40, 0})));
  EXPECT_FALSE(connected(growth).contains(between({0, 0}, {40, 0})));
}

TEST(RandomWalk, TheLastFreeSlotIsJoinedToOneOpenEnd) {
  PassingStreet ending = style(3);
  ending.connections = 1;
  GrowthSite site = with_open_end({{60, 0}}, ending);
  site.existing.nodes = {{-50, 0}, {0, 0}, {120, 0}, {170, 0}};
  site.existing.streets.push_back(existing_street(site, 3, 2));
  site.open_ends.push_back({2, style(0), {-1, 0}});
  EXPECT_EQ(grow(site).segments.size(), 2U);
  const Options options{.connections = RandomWalkGrower::Connections::kObserved};
  EXPECT_EQ(connections_at(grow(site, options), {60, 0}), 1U);
}

TEST(RandomWalk, OpenEndsAreNotJoinedToEachOther) {
  GrowthSite site = with_open_end({{60, 500}}, style(3));
  site.existing.nodes = {{-50, 0}, {0, 0}, {40, 0}, {90, 0}};
  site.existing.streets.push_back(existing_street(site, 3, 2));
  site.open_ends.push_back({2, style(1), {-1, 0}});
  EXPECT_TRUE(grow(site).segments.empty());
}

TEST(RandomWalk, AnOpenEndIsNotJoinedAcrossAnObstacle) {
  GrowthSite site = with_open_end({{60, 0}}, style(3));
  EXPECT_EQ(grow(site).segments.size(), 1U);
  site.obstacles = {{{{20, -50}, {30, -50}, {30, 50}, {20, 50}}, {}}};
  EXPECT_TRUE(grow(site).segments.empty());
}

// ---- what may be odd about a site ----

TEST(RandomWalk, PointsThatNoStreetReachesAreLeftAlone) {
  EXPECT_EQ(grow(site_of({{0, 0}})).left_alone, (std::vector<std::uint32_t>{0}));
  EXPECT_TRUE(grow(GrowthSite{}).network.streets.empty());
  const Growth growth = grow(site_of({{0, 0}, {100, 0}, {5000, 0}}));
  EXPECT_EQ(growth.left_alone, (std::vector<std::uint32_t>{2}));
}

TEST(RandomWalk, CollinearPointsBecomeOneStreet) {
  std::vector<Point> places;
  for (int i = 0; i < 12; ++i) places.push_back({100.0 * i, 50.0 * i});
  const Growth growth = grow(site_of(places, style(0, 110.0)));
  EXPECT_EQ(growth.segments.size(), 11U);
  for (const GrownSegment& segment : growth.segments) EXPECT_EQ(segment.street, 0U);
}

TEST(RandomWalk, PointsOnTopOfEachOtherAreNotConnected) {
  const Growth growth = grow(site_of({{0, 0}, {0, 0}, {0, 0}, {100, 0}, {100, 0}}));
  EXPECT_EQ(growth.segments.size(), 1U);
  EXPECT_TRUE(growth.left_alone.empty());
}

TEST(RandomWalk, ZeroVariancesAreWalkedWithinTheirBounds) {
  PassingStreet exact = style(0, 100.0, 0.0);
  exact.angle_variance_rad2 = 0.0;
  PassingStreet across = exact;
  across.distance_mean_m = 140.0;
  EXPECT_EQ(connected(grow(grid(4, 4, exact, across))), grid_edges(4, 4));
  EXPECT_EQ(grow(site_of({{0, 0}, {106, 0}}, exact)).segments.size(), 1U);
  EXPECT_TRUE(
      grow(site_of({{0, 0}, {106, 0}}, exact), {.min_distance_deviation_m = 0.0}).segments.empty());
}

TEST(RandomWalk, LevelsMayBeMissing) {
  const Growth growth = grow(grid(3, 3, style(3, 100, 8), style(7, 140, 8)));
  EXPECT_EQ(connected(growth), grid_edges(3, 3));
  for (const GrownSegment& segment : growth.segments)
    EXPECT_TRUE(segment.hierarchy == 3 || segment.hierarchy == 7);
}

TEST(RandomWalk, ABoundaryWithoutPointsLeavesAllAlone) {
  GrowthSite site = site_of({{0, 0}, {100, 0}});
  site.boundary = Polygon{{{500, 500}, {600, 500}, {600, 600}}, {}};
  const Growth growth = grow(site);
  EXPECT_TRUE(growth.segments.empty());
  EXPECT_EQ(growth.left_alone.size(), 2U);
  site.boundary = Polygon{};
  Rng rng(1);
  EXPECT_FALSE(RandomWalkGrower({}).grow(site, rng).has_value());
}

TEST(RandomWalk, AttributesThatAreNoNumbersAreRefused) {
  GrowthSite site = site_of({{0, 0}, {100, 0}});
  site.points[1].a.distance_mean_m = std::nan("");
  Rng rng(1);
  EXPECT_EQ(RandomWalkGrower({}).grow(site, rng).error().code, FailureCode::kOutOfRange);
  site.points[1].a.distance_mean_m = 1e300;
  EXPECT_TRUE(RandomWalkGrower({}).grow(site, rng).has_value());
}

TEST(RandomWalk, EveryCombinationOfItsOptionsKeepsTheContract) {
  using R = RandomWalkGrower;
  int grown = 0;
  Rng draw = testing::property_rng("RandomWalk.EveryCombination");
  for (int i = 0; i < testing::iterations(300); ++i) {
    const auto pick = [&](auto... values) {
      const std::array all{values...};
      return all[draw.index(all.size())];
    };
    Options options;
    options.levels = pick(R::Levels::kMatch, R::Levels::kIgnored);
    options.connections =
        pick(R::Connections::kFour, R::Connections::kObserved, R::Connections::kUnlimited);
    options.crossings = pick(R::Crossings::kForbidden, R::Crossings::kNoded, R::Crossings::kTee);
    options.selection = pick(R::Selection::kLikeliest, R::Selection::kSampled);
    options.start = pick(R::Start::kRandom, R::Start::kLikeliest);
    options.first_step = pick(R::FirstStep::kBlind, R::FirstStep::kLookAhead);
    options.view = pick(R::View::kBase, R::View::kMutual);
    options.distance = pick(AxisUse::kGaussian, AxisUse::kIgnored);
    options.angle = pick(AxisUse::kGaussian, AxisUse::kIgnored);
    options.clearance_widths = pick(0.0, 0.5);
    options.curves = pick(R::Curves::kTortuous, R::Curves::kStraight);
    const auto made = testing::made_site(draw(), static_cast<std::uint32_t>(i));
    const bool has_new_nodes = options.crossings != R::Crossings::kForbidden;
    ASSERT_EQ(testing::why_not_in_contract(
                  R(options), made.site, draw(),
                  has_new_nodes ? testing::NewNodes::kAllowed : testing::NewNodes::kNone),
              "")
        << to_string(to_option_map(options));
    grown += grow(made.site, options).segments.empty() ? 0 : 1;
  }
  EXPECT_GT(grown, 100);
}

}  // namespace
}  // namespace plat::streets
