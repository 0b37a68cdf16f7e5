// The contract of StreetGrower, over every registered strategy and many sites.
#include <cmath>
#include <limits>

#include "core/parallel.h"
#include "core/planar_graph.h"
#include "core/working_grid.h"
#include "streets/growth_contract.h"
#include "streets/made_sites.h"
#include "streets/nearest_grower.h"
#include "streets/street_grower.h"
#include "support/property.h"

namespace plat::streets {
namespace {

using plat::testing::BoundaryKind;
using plat::testing::ExistingNetwork;
using plat::testing::iterations;
using plat::testing::made_site;
using plat::testing::made_town;
using plat::testing::MadeSite;
using plat::testing::NewNodes;
using plat::testing::ObstacleKind;
using plat::testing::property_rng;
using plat::testing::Town;
using plat::testing::why_not_grown;
using plat::testing::why_not_in_contract;

/// Fewer cases than this may all be of one kind by chance.
constexpr int kEnoughToTell = 200;

/// How many of the cases tell something.
struct Tally {
  int cases = 0;
  int grown = 0;
  int at_existing = 0;
  int in_boundary = 0;
  int beside_obstacles = 0;
  int left_alone = 0;

  void add(const MadeSite& made, const Growth& growth) {
    ++cases;
    if (!growth.left_alone.empty()) ++left_alone;
    if (growth.segments.empty()) return;
    ++grown;
    if (!made.site.existing.streets.empty()) ++at_existing;
    if (made.site.boundary) ++in_boundary;
    if (!made.site.obstacles.empty()) ++beside_obstacles;
  }
  void expect_enough() const {
    if (cases < kEnoughToTell) return;
    EXPECT_GT(2 * grown, cases);
    EXPECT_GT(8 * at_existing, cases);
    EXPECT_GT(8 * in_boundary, cases);
    EXPECT_GT(10 * beside_obstacles, cases);
    EXPECT_GT(8 * left_alone, cases);
  }
};

std::uint64_t seed_of(const std::string& test_name) {
  Rng rng = property_rng(test_name);
  return rng();
}

/// Calls `check(made, seed)` for many sites.
template <class Check>
void for_made_sites(const std::string& name, int count, Check check) {
  const std::uint64_t seed = seed_of(name);
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(count); ++i) {
    SCOPED_TRACE(fmt::format("made_site({}, {})", seed, i));
    check(made_site(seed, i), seed + i);
    if (::testing::Test::HasFatalFailure()) return;
  }
}

// ---- the suite fails on growers that are wrong ----

enum class Fault {
  kNone,
  kCrosses,
  kCrossesExisting,
  kRunsTwice,
  kRunsAlong,
  kHasNoLength,
  kLeavesTheBoundary,
  kEntersAnObstacle,
  kPassesThroughAPoint,
  kEndsNowhere,
  kMovesAnExistingStreet,
  kWidensAnExistingStreet,
  kIsNotDeterministic,
  kHasNoWidth,
  kHasNoLevel,
  kForgetsASegment,
  kLiesAboutPoints,
  kTearsAStreet,
};

/// The network with another street, whatever it runs through.
void add_street(Growth& growth, const Point from, const Point to) {
  auto& network = growth.network;
  for (const Point p : {from, to}) {
    const auto at = std::ranges::lower_bound(network.nodes, p);
    if (at != network.nodes.end() && *at == p) continue;
    const auto node = static_cast<std::uint32_t>(at - network.nodes.begin());
    network.nodes.insert(at, p);
    for (Street& street : network.streets) {
      street.from += street.from >= node ? 1 : 0;
      street.to += street.to >= node ? 1 : 0;
    }
  }
  const auto node = [&](Point p) {
    return static_cast<std::uint32_t>(std::ranges::lower_bound(network.nodes, p) -
                                      network.nodes.begin());
  };
  Street street;
  street.id = StreetId{static_cast<std::uint32_t>(network.streets.size())};
  street.from = node(from);
  street.to = node(to);
  street.line = {from, to};
  street.width_m = 8.0;
  street.width_source = WidthSource::kAssumed;
  network.streets.push_back(std::move(street));
  growth.segments.push_back({0, static_cast<std::uint32_t>(growth.segments.size())});
}

/// An honest strategy with one fault.
struct Twin {
  Fault fault;
  mutable int calls = 0;

  [[nodiscard]] Expected<Growth> grow(const GrowthSite& site, Rng& rng) const {
    GrowthSite seen = site;
    if (fault == Fault::kLeavesTheBoundary) seen.boundary.reset();
    if (fault == Fault::kEntersAnObstacle) seen.obstacles.clear();
    auto grown = NearestGrower({}).grow(seen, rng);
    if (grown && !grown->segments.empty()) spoil(site, *grown);
    return grown;
  }

  void spoil(const GrowthSite& site, Growth& growth) const {
    const std::size_t existing = site.existing.streets.size();
    auto& streets = growth.network.streets;
    const Polyline line = streets[existing].line;
    const Point middle = snap(midpoint(line.front(), line.back()));
    const Point aside = snap(0.3 * perpendicular(line.back() - line.front()));
    if (fault == Fault::kCrosses) add_street(growth, middle + aside, middle - aside);
    if (fault == Fault::kCrossesExisting && existing > 0) {
      const Point at = midpoint(streets[0].line[0], streets[0].line[1]);
      const Point off = 0.3 * perpendicular(streets[0].line[1] - streets[0].line[0]);
      add_street(growth, snap(at + off), snap(at - off));
    }
    if (fault == Fault::kRunsTwice) add_street(growth, line.back(), line.front());
    if (fault == Fault::kRunsAlong) add_street(growth, line.front(), middle);
    if (fault == Fault::kHasNoLength) add_street(growth, line.front(), line.front());
    if (fault == Fault::kEndsNowhere) {
      const Point far = growth.network.nodes.back() + Point{1.0, 0.0};
      add_street(growth, growth.network.nodes.back(), far);
    }
    if (fault == Fault::kPassesThroughAPoint) pass_through(site, growth);
    if (fault == Fault::kMovesAnExistingStreet && existing > 0)
      streets[0].line.insert(streets[0].line.begin() + 1,
                             snap(midpoint(streets[0].line[0], streets[0].line[1])));
    if (fault == Fault::kWidensAnExistingStreet && existing > 0) streets[0].width_m += 1.0;
    if (fault == Fault::kIsNotDeterministic) streets.back().width_m += 0.001 * ++calls;
    if (fault == Fault::kHasNoWidth) streets.back().width_m = 0.0;
    if (fault == Fault::kHasNoLevel) growth.segments.back().hierarchy = -1;
    if (fault == Fault::kForgetsASegment) growth.segments.pop_back();
    if (fault == Fault::kLiesAboutPoints) growth.left_alone.push_back(0);
    if (fault == Fault::kTearsAStreet)
      for (auto& segment : growth.segments) segment = {0, 0};
  }

  /// Two streets of one line become one.
  static void pass_through(const GrowthSite& site, Growth& growth) {
    auto& streets = growth.network.streets;
    Street& last = streets.back();
    const Point through = last.line.back();
    for (std::size_t i = site.existing.streets.size(); i + 1 < streets.size(); ++i) {
      if (streets[i].line.front() != through || streets[i].to == last.from) continue;
      last.line.push_back(streets[i].line.back());
      last.to = streets[i].to;
      const auto at = static_cast<std::ptrdiff_t>(i);
      streets.erase(streets.begin() + at);
      growth.segments.pop_back();
      for (std::size_t k = i; k < streets.size(); ++k)
        streets[k].id = StreetId{static_cast<std::uint32_t>(k)};
      return;
    }
  }
};
static_assert(StreetGrower<Twin>);

TEST(StreetGrowerContract, AcceptsAnHonestGrowerAndRefusesItsBrokenTwins) {
  std::map<Fault, int> objections;
  for_made_sites("Contract.Twins", 120, [&](const MadeSite& made, std::uint64_t seed) {
    for (int fault = 0; fault <= static_cast<int>(Fault::kTearsAStreet); ++fault) {
      const Twin twin{static_cast<Fault>(fault)};
      const std::string wrong = why_not_in_contract(twin, made.site, seed);
      objections[twin.fault] += wrong.empty() ? 0 : 1;
      if (twin.fault == Fault::kNone) {
        ASSERT_EQ(wrong, "");
      }
    }
  });
  objections.erase(Fault::kNone);
  for (const auto& [fault, count] : objections)
    EXPECT_GT(count, 8) << "fault " << static_cast<int>(fault);
}

// ---- every strategy on the menu ----

class StreetGrowerContract : public ::testing::TestWithParam<std::string> {
 protected:
  const AnyStreetGrower grower_ = street_growers().make(GetParam());
};

TEST_P(StreetGrowerContract, HoldsOnRandomSites) {
  Tally tally;
  for_made_sites("Contract.Sites", iterations(500), [&](const MadeSite& made, std::uint64_t seed) {
    ASSERT_EQ(why_not_in_contract(grower_, made.site, seed), "");
    Rng rng(seed);
    tally.add(made, *grower_.grow(made.site, rng));
  });
  tally.expect_enough();
}

/// Any value that the field takes.
OptionValue random_value(Rng& rng, const FieldDescription& field) {
  if (!field.choices.empty()) return field.choices[rng.index(field.choices.size())];
  if (field.type == "number or none" && rng.index(3) == 0) return std::string(kAbsent);
  const bool is_whole = field.type == "integer";
  switch (rng.index(4)) {
    case 0:
      return field.min;
    case 1:
      return field.max;
    default: {
      // Ranges are wide; most of what matters lies at their lower end.
      const double value = field.min + (field.max - field.min) * std::pow(rng.uniform_01(), 3);
      return is_whole ? std::floor(value) : value;
    }
  }
}

TEST_P(StreetGrowerContract, HoldsForAnyOptions) {
  const auto& entry = street_growers().at(GetParam());
  Rng rng = property_rng("Contract.Options");
  for_made_sites(
      "Contract.Options", iterations(300), [&](const MadeSite& made, std::uint64_t seed) {
        OptionMap options;
        for (const FieldDescription& field : entry.fields)
          if (rng.index(2) == 0) options[field.name] = random_value(rng, field);
        SCOPED_TRACE(to_string(options));
        ASSERT_EQ(why_not_in_contract(entry.make(options), made.site, seed, NewNodes::kAllowed),
                  "");
      });
}

TEST_P(StreetGrowerContract, HoldsInATownAndNodingLeavesItAsItIs) {
  for (const Town town : {Town::kRegular, Town::kRandom}) {
    const GrowthSite site = made_town(1, town, 1500);
    ASSERT_EQ(why_not_in_contract(grower_, site, 1), "");
    Rng rng(1);
    const Growth growth = *grower_.grow(site, rng);
    EXPECT_GT(growth.segments.size(), 1000U);
    // The town's levels are drawn point by point: who walks by level finds some points alone.
    EXPECT_LT(growth.left_alone.size(), 375U);
    std::vector<Segment> pieces;
    for (const Street& street : growth.network.streets)
      for (std::size_t i = 1; i < street.line.size(); ++i)
        pieces.push_back({street.line[i - 1], street.line[i]});
    const PlanarGraph noded = node_segments(pieces);
    EXPECT_EQ(noded.edges.size(), pieces.size());
    EXPECT_TRUE(noded.overlaps.empty());
  }
}

TEST_P(StreetGrowerContract, GrowsTheSameNetworkOnAnyThread) {
  const GrowthSite site = made_site(3, 0).site;
  const auto grow = [&] {
    Rng rng(7);
    return *grower_.grow(site, rng);
  };
  const Growth here = grow();
  std::vector<Growth> there(8);
  parallel_for(there.size(), Jobs{2}, [&](std::size_t i) { there[i] = grow(); });
  for (const Growth& growth : there) EXPECT_TRUE(plat::testing::are_same(here, growth));
}

TEST_P(StreetGrowerContract, SiteWithoutPointsIsGrownToItsExistingNetwork) {
  GrowthSite site;
  for (int number = 0; site.existing.streets.empty(); ++number)
    site = made_site(5, static_cast<std::uint32_t>(number)).site;
  site.points.clear();
  site.open_ends.clear();
  Rng rng(1);
  const auto growth = grower_.grow(site, rng);
  ASSERT_TRUE(growth);
  EXPECT_TRUE(growth->segments.empty() && growth->left_alone.empty());
  EXPECT_EQ(growth->network.nodes, site.existing.nodes);
  EXPECT_EQ(growth->network.streets.size(), site.existing.streets.size());
  Rng again(1);
  const auto nothing = grower_.grow(GrowthSite{}, again);
  ASSERT_TRUE(nothing);
  EXPECT_TRUE(nothing->network.streets.empty() && nothing->network.nodes.empty());
}

TEST_P(StreetGrowerContract, BoundaryThatExcludesEveryPointLeavesAllAlone) {
  int met = 0;
  for (std::uint32_t i = 0; met < 10; ++i) {
    const MadeSite made = made_site(6, i);
    if (made.boundary != BoundaryKind::kExcludesAll) continue;
    ++met;
    Rng rng(1);
    const auto growth = grower_.grow(made.site, rng);
    ASSERT_TRUE(growth);
    EXPECT_TRUE(growth->segments.empty());
    EXPECT_EQ(growth->left_alone.size(), made.site.points.size());
  }
}

/// A street of the existing network that ends at the origin and could go on to the east, and points
/// there.
GrowthSite street_towards_points() {
  GrowthSite site;
  site.existing.nodes = {{-100.0, 0.0}, {0.0, 0.0}};
  Street street;
  street.from = 0;
  street.to = 1;
  street.line = {{-100.0, 0.0}, {0.0, 0.0}};
  street.width_m = 12.0;
  street.width_source = WidthSource::kClass;
  site.existing.streets.push_back(street);
  PassingStreet style;
  style.distance_mean_m = 100.0;
  style.distance_variance_m2 = 400.0;
  style.angle_variance_rad2 = 0.1;
  style.width_m = 10.0;
  site.open_ends.push_back({1, style, {1.0, 0.0}});
  for (int i = 1; i <= 3; ++i)
    site.points.push_back({{100.0 * i, 2.0}, style, std::nullopt, std::nullopt});
  return site;
}

TEST_P(StreetGrowerContract, ConnectsToAnOpenEnd) {
  const GrowthSite site = street_towards_points();
  ASSERT_EQ(why_not_in_contract(grower_, site, 1), "");
  Rng rng(1);
  const Growth growth = *grower_.grow(site, rng);
  const auto at_open_end = std::ranges::count_if(growth.network.streets, [](const Street& street) {
    return street.line.front() == Point{0.0, 0.0} || street.line.back() == Point{0.0, 0.0};
  });
  EXPECT_EQ(at_open_end, 2);
  EXPECT_TRUE(growth.left_alone.empty());
}

TEST_P(StreetGrowerContract, GrownStreetsWithoutAKnownWidthHaveOne) {
  GrowthSite site = street_towards_points();
  for (IntersectionPoint& point : site.points) point.a.width_m = 0.0;
  site.open_ends.front().street.width_m = 0.0;
  EXPECT_EQ(why_not_in_contract(grower_, site, 1), "");
}

TEST_P(StreetGrowerContract, SitesThatCannotBeUsedAreFailures) {
  const auto failure_of = [&](const GrowthSite& site) -> std::optional<FailureCode> {
    Rng rng(1);
    const auto growth = grower_.grow(site, rng);
    if (growth) return std::nullopt;
    EXPECT_FALSE(growth.error().message.empty());
    return growth.error().code;
  };
  const GrowthSite good = street_towards_points();
  EXPECT_EQ(failure_of(good), std::nullopt);
  for (const double wrong :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e18}) {
    GrowthSite site = good;
    site.points[1].place.y = wrong;
    EXPECT_EQ(failure_of(site), FailureCode::kNotFinite);
    site = good;
    site.existing.nodes[0].x = wrong;
    EXPECT_EQ(failure_of(site), FailureCode::kNotFinite);
    site = good;
    site.boundary = Polygon{{{0, 0}, {wrong, 0}, {0, 100}}, {}};
    EXPECT_EQ(failure_of(site), FailureCode::kNotFinite);
    site = good;
    site.obstacles = {Polygon{{{0, 0}, {wrong, 0}, {0, 100}}, {}}};
    EXPECT_EQ(failure_of(site), FailureCode::kNotFinite);
  }
  GrowthSite site = good;
  site.boundary = Polygon{{{0, 0}, {100, 0}}, {}};
  EXPECT_EQ(failure_of(site), FailureCode::kEmptyGeometry);
  site.boundary = Polygon{{{0, 0}, {100, 100}, {100, 0}, {0, 100}}, {}};
  EXPECT_EQ(failure_of(site), FailureCode::kNotSimple);
  site.boundary = Polygon{};
  EXPECT_EQ(failure_of(site), FailureCode::kEmptyGeometry);
  site = good;
  site.open_ends[0].node = 2;
  EXPECT_EQ(failure_of(site), FailureCode::kUnknownEntity);
}

TEST_P(StreetGrowerContract, AttributesThatSayNothingAreNoException) {
  const auto grows = [&](const GrowthSite& site) { return why_not_in_contract(grower_, site, 1); };
  const GrowthSite good = street_towards_points();
  for (const double wrong : {0.0, -1.0, 1e300, std::numeric_limits<double>::quiet_NaN(),
                             std::numeric_limits<double>::infinity()}) {
    for (double PassingStreet::* attribute :
         {&PassingStreet::tortuosity, &PassingStreet::distance_mean_m,
          &PassingStreet::distance_variance_m2, &PassingStreet::angle_mean_rad,
          &PassingStreet::angle_variance_rad2, &PassingStreet::width_m}) {
      GrowthSite site = good;
      for (IntersectionPoint& point : site.points) point.a.*attribute = wrong;
      site.open_ends[0].street.*attribute = wrong;
      // A Failure would do, too: what counts is that nothing throws and nothing false is grown.
      const std::string why = grows(site);
      EXPECT_TRUE(why.empty() || why.starts_with("is not grown")) << why << " for " << wrong;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Registry, StreetGrowerContract,
                         ::testing::ValuesIn(street_growers().names()),
                         [](const auto& each) { return each.param; });

struct NoVerb {};
static_assert(!StreetGrower<NoVerb>);

}  // namespace
}  // namespace plat::streets
