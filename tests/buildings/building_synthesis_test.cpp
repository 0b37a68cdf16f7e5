#include "buildings/building_synthesis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>

#include "buildings/made_meshes.h"
#include "buildings/part_kits.h"
#include "core/failure.h"
#include "sequences/sequence_search.h"
#include "support/property.h"

namespace plat::buildings {
namespace {

constexpr FrontSide kL = FrontSide::kLeft;
constexpr FrontSide kR = FrontSide::kRight;

const PartDatabase& kit(const std::string& name) {
  static std::map<std::string, PartDatabase> made;
  const auto at = made.find(name);
  return at != made.end() ? at->second : made.emplace(name, make_part_kit(name)).first->second;
}

std::vector<sequences::SequencePath> best_paths(const PreparedBuilding& prepared, std::size_t k) {
  const auto search = sequences::sequence_searches().make("layered", OptionMap{});
  auto stream = search.search(prepared.compiled.graph);
  EXPECT_TRUE(stream.has_value());
  return *sequences::find_paths(**stream, k);
}

Building best(const PreparedBuilding& prepared) {
  return realise(prepared, best_paths(prepared, 1).at(0));
}

BuildingDesign design_of(BuildingSkeleton skeleton) { return {"", std::move(skeleton), {}, {}}; }

/// What the parts of a row come to, arms at its key points included.
double quantised_m(const PreparedBuilding& prepared, const Building& building, std::size_t r) {
  const SkeletonRow& row = prepared.plan->rows[r];
  double sum = 0.0;
  const auto arm = [&](std::uint32_t key, PortRole role) {
    const auto part = prepared.problem.parts[building.by_place.key_points[key]];
    if (!part) return 0.0;
    const Part& at = prepared.database.parts()[*part];
    return at.ports[*find_port(at, role)].arm_m;
  };
  for (const auto element : building.by_place.segments[r])
    sum += prepared.database.parts()[*prepared.problem.parts[element]].shape.right_m;
  return sum + arm(row.from, row.from_port) + arm(row.to, row.to_port);
}

double sum_of(const PreparedBuilding& prepared, const Building& building, std::size_t r,
              const std::string& name) {
  double sum = 0.0;
  for (const auto element : building.by_place.segments[r])
    sum += attribute(prepared.database.parts()[*prepared.problem.parts[element]], name);
  return sum;
}

void expect_good(const PreparedBuilding& prepared, const Building& building) {
  const SurfaceReport surface = inspect_surface(building.assembled.mesh);
  EXPECT_TRUE(surface.is_watertight()) << surface.unmatched_edge_count << " edges open";
  for (std::size_t r = 0; r < prepared.plan->rows.size(); ++r) {
    const double length = length_m(prepared.plan->rows[r]);
    EXPECT_NEAR(quantised_m(prepared, building, r), length, 0.5 * kLengthQuantum_m + 1e-9);
  }
  // The ports of a part at a key point are as far from its node as its arms are stretched.
  std::size_t placed = 0;
  for (std::size_t k = 0; k < prepared.plan->key_points.size(); ++k) {
    const auto index = prepared.problem.parts[building.by_place.key_points[k]];
    if (!index) continue;
    const Part& part = prepared.database.parts()[*index];
    const SkeletonKeyPoint& key = prepared.plan->key_points[k];
    for (std::size_t p = 0; p < part.ports.size(); ++p) {
      const PortRole role = part.ports[p].role;
      const auto row = role == PortRole::kLeft    ? key.left_row
                       : role == PortRole::kRight ? key.right_row
                                                  : key.stem_row;
      const Point3 at = building.placed.parts[placed].targets[p].origin;
      EXPECT_NEAR(distance(Point{at.x, at.y}, prepared.skeleton.nodes[key.node]),
                  part.ports[p].arm_m * rounding(prepared.plan->rows[*row]).factor, 1e-9);
    }
    ++placed;
  }
  // Every joint lies on its row's line, where the front is on the right.
  for (const Joint& joint : building.placed.joints) {
    double nearest = 1e9;
    for (const SkeletonRow& row : prepared.plan->rows) {
      const Point at{joint.plane.origin.x, joint.plane.origin.y};
      if (dot(direction(row), {joint.plane.outward.x, joint.plane.outward.y}) < 0.999) continue;
      nearest = std::min(nearest, distance(Segment{row.start, row.end}, at));
    }
    EXPECT_LT(nearest, 1e-6);
  }
}

/// A courtyard of random size and slant, with wings at random sides, tees in tees among them.
BuildingSkeleton random_skeleton(Rng& rng) {
  const auto length = [&] { return rng.uniform(26.0, 48.0); };
  BuildingSkeleton skeleton;
  const double width = 2.0 * length();
  const double depth = 2.0 * length();
  const double slant = rng.uniform(-9.0, 9.0);
  skeleton.nodes = {
      {0, 0}, {width, 0}, {width + slant, depth}, {slant, depth + rng.uniform(-6, 6)}};
  const FrontSide front = rng.index(2) == 0 ? kR : kL;
  std::uint32_t before = 0;
  for (std::uint32_t side = 0; side < 4; ++side) {
    const std::uint32_t after = (side + 1) % 4;
    const Point a = skeleton.nodes[side];
    const Point b = skeleton.nodes[after];
    before = side;
    if (rng.index(2) == 0) {
      const auto middle = static_cast<std::uint32_t>(skeleton.nodes.size());
      const Point outward = -perpendicular(normalized(b - a));
      skeleton.nodes.push_back(midpoint(a, b));
      skeleton.nodes.push_back(midpoint(a, b) + length() * outward);
      skeleton.edges.push_back({before, middle, front});
      skeleton.edges.push_back({middle, middle + 1, rng.index(2) == 0 ? kR : kL});
      before = middle;
    }
    skeleton.edges.push_back({before, after, front});
  }
  return skeleton;
}

TEST(BuildingSynthesis, IsWatertightAndFillsRandomSkeletonsInBothStyles) {
  Rng rng =
      testing::property_rng("BuildingSynthesis.IsWatertightAndFillsRandomSkeletonsInBothStyles");
  int tees = 0;
  for (const char* name : {"townhouse", "palazzo"}) {
    for (int i = 0; i < testing::iterations(4); ++i) {
      BuildingDesign design = design_of(random_skeleton(rng));
      design.preferences.variety_m2 = i % 2;
      const PreparedBuilding prepared = prepare(design, kit(name));
      const Building building = best(prepared);
      expect_good(prepared, building);
      tees += static_cast<int>(std::get<BuildingSkeleton>(design.shape).edges.size()) - 4;
    }
  }
  EXPECT_GT(tees, testing::iterations(4));
}

TEST(BuildingSynthesis, CostsTheAreaOfItsWalls) {
  // Ends of the two kits' families differ: the transition that costs nothing is forbidden.
  BuildingDesign design = design_of({{{0, 0}, {30, 0}, {30, 30}}, {{0, 1, kR}, {1, 2, kR}}, {}});
  design.preferences = {0.0, 0.0, 0};
  const PreparedBuilding prepared = prepare(design, kit("townhouse"));
  const Building cheapest = best(prepared);
  int disagreeing = 0;
  for (const auto& path : best_paths(prepared, 1)) {
    const Building building = realise(prepared, path);
    EXPECT_NEAR(building.assembled.wall_area_m2,
                static_cast<double>(building.arrangement.cost) * kCostStep_m2, 1e-2);
  }
  // Dearer rows, put together at random: every transition is paid for by its wall.
  Rng rng = testing::property_rng("BuildingSynthesis.CostsTheAreaOfItsWalls");
  for (int i = 0; i < testing::iterations(20); ++i) {
    Building building = cheapest;
    auto& row = building.by_place.segments[0];
    for (auto& element : row) {
      do {
        element = static_cast<sequences::ElementIndex>(rng.index(prepared.problem.parts.size()));
      } while (!prepared.problem.problem.database.elements[element].is_filling);
    }
    double expected = 0.0;
    std::vector<sequences::ElementIndex> all = row;
    all.insert(all.begin(), building.by_place.key_points[0]);
    all.push_back(building.by_place.key_points[1]);
    all.insert(all.end(), building.by_place.segments[1].begin(),
               building.by_place.segments[1].end());
    all.push_back(building.by_place.key_points[2]);
    for (std::size_t e = 0; e + 1 < all.size(); ++e) {
      const std::size_t from = *prepared.problem.parts[all[e]];
      const std::size_t to = *prepared.problem.parts[all[e + 1]];
      const auto& parts = prepared.database.parts();
      expected += prepared.database.cost_m2({from, *find_port(parts[from], PortRole::kRight)},
                                            {to, *find_port(parts[to], PortRole::kLeft)});
    }
    const AssembledBuilding assembled =
        assemble(place(prepared.problem, *prepared.plan, prepared.database, building.by_place),
                 prepared.database);
    EXPECT_NEAR(assembled.wall_area_m2, expected, 1e-2);
    EXPECT_TRUE(inspect_surface(assembled.mesh).is_watertight());
    disagreeing += expected > 1.0 ? 1 : 0;
  }
  EXPECT_GT(disagreeing, testing::iterations(10));
}

TEST(BuildingSynthesis, IsWatertightWhereSectionsDisagreeAtATee) {
  // Parts at random, whether they fit or not, around a tee; the row at the stem is walked inwards.
  Rng rng = testing::property_rng("BuildingSynthesis.IsWatertightWhereSectionsDisagreeAtATee");
  const BuildingSkeleton skeleton{
      {{0, 0}, {30, 0}, {60, 0}, {30, -30}}, {{0, 1, kR}, {1, 2, kR}, {1, 3, kL}}, {}};
  const PreparedBuilding prepared = prepare(design_of(skeleton), kit("palazzo"));
  Building building = best(prepared);
  const sequences::SequenceProblem& problem = prepared.problem.problem;
  using Side = sequences::Port;
  const auto cost = [&](sequences::ElementIndex from, sequences::ElementIndex to, Side in) {
    for (const auto& transition : problem.database.transitions) {
      if (transition.from == from && transition.to == to && transition.from_port == Side::kRight &&
          transition.to_port == in)
        return static_cast<double>(transition.cost) * kCostStep_m2 - Preferences{}.part_m2;
    }
    return std::numeric_limits<double>::quiet_NaN();
  };
  int priced = 0;
  for (int i = 0; i < testing::iterations(25); ++i) {
    for (std::size_t k = 0; k < 4; ++k) {
      const auto& allowed = prepared.problem.problem.structure.key_points[k].allowed;
      building.by_place.key_points[k] = allowed[rng.index(allowed.size())];
    }
    for (auto& row : building.by_place.segments) {
      do {
        row = {static_cast<sequences::ElementIndex>(rng.index(prepared.problem.parts.size()))};
      } while (!prepared.problem.problem.database.elements[row[0]].is_filling);
    }
    const AssembledBuilding assembled =
        assemble(place(prepared.problem, *prepared.plan, prepared.database, building.by_place),
                 prepared.database);
    EXPECT_EQ(inspect_surface(assembled.mesh).unmatched_edge_count, 0U);
    // Every wall is paid for, at the stem by sections seen from the other side.
    double expected = 0.0;
    for (std::size_t r = 0; r < 3; ++r) {
      const SkeletonRow& row = prepared.plan->rows[r];
      const Side in = row.to_port == PortRole::kStem ? Side::kStem : Side::kLeft;
      const auto element = building.by_place.segments[r][0];
      expected += cost(building.by_place.key_points[row.from], element, Side::kLeft);
      expected += cost(element, building.by_place.key_points[row.to], in);
    }
    if (!std::isnan(expected)) {
      EXPECT_NEAR(assembled.wall_area_m2, expected, 1e-2);
      ++priced;
    }
  }
  EXPECT_GT(priced, testing::iterations(10));
}

TEST(BuildingSynthesis, IsWatertightWhereThePortsOfATeeTouch) {
  // The tee is a tower whose ports meet at its edges; its neighbours end half way up those.
  std::vector<Part> parts;
  parts.push_back(make_part("tower",
                            {.part_class = PartClass::kTee,
                             .stem_side = StemSide::kFront,
                             .left_m = 5,
                             .right_m = 5,
                             .stem_m = 5},
                            testing::box_mesh({-5, -5, 0}, {5, 5, 9}), {}));
  parts.push_back(make_part("wing", {.part_class = PartClass::kMiddle, .right_m = 4},
                            testing::box_mesh({0, -5, 0}, {4, 5, 6}), {}));
  parts.push_back(make_part("high", {.part_class = PartClass::kMiddle, .right_m = 6},
                            testing::box_mesh({0, -5, 0}, {6, 5, 7}), {}));
  parts.push_back(make_part("left", {.part_class = PartClass::kLeftEnd, .right_m = 2},
                            testing::box_mesh({0, -5, 0}, {2, 5, 6}), {}));
  parts.push_back(make_part("right", {.part_class = PartClass::kRightEnd, .left_m = 2},
                            testing::box_mesh({-2, -5, 0}, {0, 5, 6}), {}));
  const PartDatabase boxes(
      {.name = "boxes", .summary = "", .origin = "", .kit = {}, .transition_limit_m2 = {}}, parts);
  const PreparedBuilding prepared = prepare(
      design_of({{{0, 0}, {11, 0}, {22, 0}, {11, -13}}, {{0, 1, kR}, {1, 2, kR}, {1, 3, kR}}, {}}),
      boxes);
  const Building building = best(prepared);
  expect_good(prepared, building);
  EXPECT_EQ(inspect_surface(building.assembled.mesh).shell_count, 1U);
}

TEST(BuildingSynthesis, SeesAStemFromTheSideOfTheRowThatComesIn) {
  // Rows are higher on their left. The stem points south and is higher in the east: on the left of
  // who walks out, on the right of who comes in.
  CellSolid tee;
  tee.fill({{-6, -4, 0}, {6, 4, 6}}, 0);
  tee.fill({{-4, -6, 0}, {4, -4, 3}}, 0);
  tee.fill({{1, -6, 3}, {4, -4, 6}}, 0);
  Mesh mesh = tee.surface([](Point3 p) { return p; });
  mesh.materials = testing::empty_mesh().materials;
  const PartShape shape{.part_class = PartClass::kTee,
                        .stem_side = StemSide::kFront,
                        .left_m = 6,
                        .right_m = 6,
                        .stem_m = 6};
  std::vector<Part> parts;
  parts.push_back(make_part("tee", shape, mesh, {}));
  parts.push_back(make_part("row", {.part_class = PartClass::kMiddle, .right_m = 4},
                            testing::crooked_row(0, 4), {}));
  parts.push_back(make_part("left", {.part_class = PartClass::kLeftEnd, .right_m = 2},
                            testing::crooked_row(0, 2), {}));
  parts.push_back(make_part("right", {.part_class = PartClass::kRightEnd, .left_m = 2},
                            testing::crooked_row(-2, 0), {}));
  const PartDatabase crooked(
      {.name = "", .summary = "", .origin = "", .kit = {}, .transition_limit_m2 = {}}, parts);
  const double bar_m2 = 2.0 * 5.0 * 3.0;
  for (const auto& [front, stem_m2] : {std::pair(kR, 0.0), std::pair(kL, 18.0)}) {
    BuildingDesign design = design_of(
        {{{0, 0}, {12, 0}, {24, 0}, {12, -12}}, {{0, 1, kR}, {1, 2, kR}, {1, 3, front}}, {}});
    design.preferences.part_m2 = 0.0;
    const Building building = best(prepare(design, crooked));
    EXPECT_NEAR(building.assembled.wall_area_m2, bar_m2 + stem_m2, 1e-9);
    EXPECT_NEAR(static_cast<double>(building.arrangement.cost) * kCostStep_m2, bar_m2 + stem_m2,
                1e-9);
  }
}

TEST(BuildingSynthesis, PutsPodiumsBelowAndCrownsAbove) {
  const PartDatabase& tower = kit("tower");
  const BuildingProblem problem = tower_problem({120.0, 1528.0, 10.0, {}}, tower);
  const auto has = [&](sequences::ElementIndex element, const char* name) {
    return attribute(tower.parts()[*problem.parts[element]], name) > 0.0;
  };
  for (const auto& transition : problem.problem.database.transitions) {
    EXPECT_FALSE(has(transition.from, "crowns"));
    EXPECT_FALSE(has(transition.to, "podiums"));
  }
  for (sequences::ElementIndex e = 0; e < problem.parts.size(); ++e) {
    EXPECT_EQ(problem.problem.database.elements[e].is_front, has(e, "podiums"));
    EXPECT_EQ(problem.problem.database.elements[e].is_back, has(e, "crowns"));
  }
}

TEST(BuildingSynthesis, KeepsBoundsOfEdges) {
  const BuildingDesign design = design_of({{{0, 0}, {40, 0}, {75, 0}, {75, 30}},
                                           {{0, 1, kR, {{"balconies", 3, 3}}},
                                            {1, 2, kR, {{"doors", 2, std::nullopt}}},
                                            {1 + 1, 3, kR}},
                                           {{"doors", 0, 3}}});
  for (const char* name : {"townhouse", "palazzo"}) {
    const PreparedBuilding prepared = prepare(design, kit(name));
    const Building building = best(prepared);
    expect_good(prepared, building);
    EXPECT_EQ(sum_of(prepared, building, 0, "balconies"), 3.0);
    EXPECT_GE(sum_of(prepared, building, 1, "doors"), 2.0);
  }
}

TEST(BuildingSynthesis, PartsMeetAtACut) {
  const BuildingDesign design =
      design_of({{{0, 0}, {30, 0}, {60, 0}}, {{0, 1, kR, {{"balconies", 0, 0}}}, {1, 2, kR}}, {}});
  const PreparedBuilding prepared = prepare(design, kit("townhouse"));
  const Building building = best(prepared);
  EXPECT_TRUE(std::ranges::any_of(building.placed.joints, [](const Joint& joint) {
    return std::abs(joint.plane.origin.x - 30.0) < 1e-9;
  }));
  expect_good(prepared, building);
}

TEST(BuildingSynthesis, LooksToItsFront) {
  // Doors are at the front: the mesh reaches further out on that side, by the stoops.
  for (const FrontSide front : {kR, kL}) {
    BuildingDesign design = design_of({{{0, 0}, {30, 0}}, {{0, 1, front}}, {{"doors", 2, 4}}});
    const Building building = best(prepare(design, kit("townhouse")));
    const auto [south, north] = std::ranges::minmax(building.assembled.mesh.vertices,
                                                    [](auto& a, auto& b) { return a.y < b.y; });
    double low_south = 0.0;
    double low_north = 0.0;
    for (const Point3& v : building.assembled.mesh.vertices) {
      if (v.z > 0.05) continue;
      low_south = std::min(low_south, v.y);
      low_north = std::max(low_north, v.y);
    }
    EXPECT_LT(south.y, 0.0);
    EXPECT_GT(north.y, 0.0);
    EXPECT_EQ(-low_south > low_north + 0.2, front == kR);
    EXPECT_EQ(low_north > -low_south + 0.2, front == kL);
  }
}

TEST(BuildingSynthesis, GivesTheSameBuildingWhenAnEdgeIsDrawnTheOtherWay) {
  const BuildingSkeleton one{{{0, 0}, {36, 0}, {36, 28}}, {{0, 1, kR}, {1, 2, kR}}, {}};
  const BuildingSkeleton other{{{0, 0}, {36, 0}, {36, 28}}, {{1, 0, kL}, {1, 2, kR}}, {}};
  const PreparedBuilding a = prepare(design_of(one), kit("palazzo"));
  const PreparedBuilding b = prepare(design_of(other), kit("palazzo"));
  EXPECT_EQ(best(a).assembled.mesh, best(b).assembled.mesh);
}

TEST(BuildingSynthesis, KBestAreDistinctAndInOrder) {
  const PreparedBuilding prepared = prepare(
      design_of({{{0, 0}, {24, 0}, {24, 24}}, {{0, 1, kR}, {1, 2, kR}}, {}}), kit("townhouse"));
  const auto paths = best_paths(prepared, 5);
  ASSERT_EQ(paths.size(), 5U);
  std::set<std::vector<sequences::ElementIndex>> seen;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    EXPECT_GE(paths[i].cost, paths[i > 0 ? i - 1 : 0].cost);
    std::vector<sequences::ElementIndex> elements;
    for (const auto& placement : realise(prepared, paths[i]).arrangement.placements)
      elements.push_back(placement.element);
    EXPECT_TRUE(seen.insert(elements).second);
  }
}

TEST(BuildingSynthesis, StacksTowersToHeightAndFloorArea) {
  const double ground_m2 = 1528.0;
  for (const double ratio : {2.0, 3.0}) {
    const BuildingDesign design{
        "", TowerDesign{30.0, ground_m2, ratio, {}}, {{"floor_area_m2", 50.0}}, {}};
    const PreparedBuilding prepared = prepare(design, kit("tower"));
    const auto paths = best_paths(prepared, 1);
    if (paths.empty()) continue;
    const Building building = realise(prepared, paths.front());
    EXPECT_TRUE(inspect_surface(building.assembled.mesh).is_watertight());
    double top = 0.0;
    for (const Point3& v : building.assembled.mesh.vertices) top = std::max(top, v.z);
    EXPECT_NEAR(top, 30.0, 1e-6);
    EXPECT_EQ(attribute(prepared.database.parts()[building.placed.parts.front().part], "podiums"),
              1.0);
    EXPECT_EQ(attribute(prepared.database.parts()[building.placed.parts.back().part], "crowns"),
              1.0);
  }
}

TEST(BuildingSynthesis, RefusesWhatTheDatabaseHasNoPartFor) {
  const auto refusal = [](const BuildingDesign& design,
                          const PartDatabase& database) -> std::string {
    try {
      static_cast<void>(prepare(design, database));
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  const BuildingDesign row = design_of({{{0, 0}, {30, 0}}, {{0, 1, kR}}, {}});
  EXPECT_NE(refusal(row, kit("tower")).find("node 0 at (0.0, 0.0): \"tower\" has no left end"),
            std::string::npos);
  const BuildingDesign tower{"", TowerDesign{}, {}, {}};
  EXPECT_NE(refusal(tower, kit("townhouse")).find("\"townhouse\" has no floors"),
            std::string::npos);
  const BuildingDesign unknown =
      design_of({{{0, 0}, {30, 0}}, {{0, 1, kR, {{"turrets", 1, 1}}}}, {}});
  EXPECT_NE(refusal(unknown, kit("townhouse")).find("has the attribute \"turrets\""),
            std::string::npos);
  // A user's database makes no corners of its own.
  DatabaseInfo info = kit("townhouse").info();
  info.kit.reset();
  const PartDatabase users(info, kit("townhouse").parts());
  const BuildingDesign odd = design_of({{{0, 0}, {30, 0}, {50, 14}}, {{0, 1, kR}, {1, 2, kR}}, {}});
  EXPECT_NE(refusal(odd, users).find("has no corner of 35.0 degrees; there are: "),
            std::string::npos);
  EXPECT_EQ(refusal(odd, kit("townhouse")), "");
}

TEST(BuildingSynthesis, BendsACornerThatIsNearlyRight) {
  DatabaseInfo info = kit("townhouse").info();
  info.kit.reset();
  const PartDatabase users(info, kit("townhouse").parts());
  const double turn = std::numbers::pi / 2 + 0.02;
  const Point end{40.0 + 30.0 * std::cos(turn), 30.0 * std::sin(turn)};
  const PreparedBuilding prepared =
      prepare(design_of({{{0, 0}, {40, 0}, end}, {{0, 1, kR}, {1, 2, kR}}, {}}), users);
  expect_good(prepared, best(prepared));
}

}  // namespace
}  // namespace plat::buildings
