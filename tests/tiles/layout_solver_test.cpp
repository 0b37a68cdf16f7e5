#include "tiles/layout_solver.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

#include "support/made_tile_city.h"
#include "support/property.h"

namespace plat::tiles {
namespace {

using plat::testing::iterations;
using plat::testing::property_rng;

/// Rounding of what a kilometre away is solved for.
constexpr double kRounding_m = 1e-7;

LayoutSolver solver_of(const TileGraph& graph, std::vector<std::uint32_t> held,
                       const SolverOptions& options = {}) {
  auto solver = LayoutSolver::make(graph, std::move(held), options);
  if (!solver) throw LogicError(solver.error().message);
  return *solver;
}

LayoutSolution solved(const TileGraph& graph, std::vector<std::uint32_t> held,
                      const std::vector<Affine>& targets, const SolverOptions& options = {},
                      const std::vector<Affine>& resting = {}) {
  auto solution = solver_of(graph, std::move(held), options).solve(targets, resting);
  if (!solution) throw LogicError(solution.error().message);
  return *solution;
}

/// The farthest that two solutions carry the same tile apart.
double difference_m(const TileGraph& graph, const std::vector<Affine>& a,
                    const std::vector<Affine>& b) {
  double out = 0.0;
  for (std::size_t i = 0; i < graph.tiles.size(); ++i) {
    const auto& [centroid, radius_m, rigidity] = graph.tiles[i];
    for (const Point d : {Point{radius_m, 0.0}, Point{0.0, radius_m}, Point{}})
      out = std::max(out, distance(a[i](centroid + d), b[i](centroid + d)));
  }
  return out;
}

Affine random_similarity(Rng& rng, double reach_m) {
  Affine map = Affine::rotation(rng.uniform(-3.0, 3.0));
  map.shift = {rng.uniform(-reach_m, reach_m), rng.uniform(-reach_m, reach_m)};
  return map;
}

Affine random_affine(Rng& rng, double reach_m) {
  Affine map = random_similarity(rng, reach_m);
  for (double* entry : {&map.xx, &map.xy, &map.yx, &map.yy}) *entry += rng.uniform(-0.2, 0.2);
  return map;
}

/// Tiles and joints of no city: points of a joint lie apart at rest, tiles are joined at random.
TileGraph random_graph(Rng& rng) {
  TileGraph graph;
  const std::size_t tiles = 2 + rng.index(7);
  const auto near = [&](std::uint32_t tile) {
    const auto& [centroid, radius_m, rigidity] = graph.tiles[tile];
    return centroid + Point{rng.uniform(-radius_m, radius_m), rng.uniform(-radius_m, radius_m)};
  };
  for (std::size_t i = 0; i < tiles; ++i)
    graph.tiles.push_back({{rng.uniform(-50, 50), rng.uniform(-50, 50)}, rng.uniform(1, 20)});
  const std::size_t joints = rng.index(5 * tiles);
  for (std::size_t j = 0; j < joints; ++j) {
    const auto a = static_cast<std::uint32_t>(rng.index(tiles));
    const auto b = static_cast<std::uint32_t>(rng.index(tiles));
    if (a == b) continue;
    graph.joints.push_back(
        {a, near(a), b, near(b), rng.index(3) == 0 ? JointKind::kStreet : JointKind::kProperty});
  }
  return graph;
}

std::vector<std::uint32_t> random_held(Rng& rng, const TileGraph& graph) {
  std::vector<std::uint32_t> held;
  for (std::uint32_t i = 0; i < graph.tiles.size(); ++i) {
    if (rng.index(4) == 0) held.push_back(i);
  }
  return held;
}

SolverOptions random_options(Rng& rng) {
  constexpr double kRigidities[] = {0.0, 0.01, 1.0, 100.0, 1e4};
  constexpr double kStreetWeights[] = {0.0, 0.01, 0.25, 1.0};
  return {kRigidities[rng.index(5)], kStreetWeights[rng.index(4)],
          0.5 * static_cast<double>(rng.index(3))};
}

/// The paper's system as it stands, six real unknowns per tile, by a dense QR: rows of (1) and (3),
/// and those that make neighbours turn together.
class DenseOracle {
 public:
  DenseOracle(const TileGraph& graph, const SolverOptions& options)
      : graph_(graph), options_(options) {
    for (std::uint32_t i = 0; i < graph.tiles.size(); ++i) {
      double sum = 0.0;
      double count = 0.0;
      for (const Joint& j : graph.joints) {
        if (j.a == i) sum += squared_length(j.rest_a - graph.tiles[i].centroid), ++count;
        if (j.b == i) sum += squared_length(j.rest_b - graph.tiles[i].centroid), ++count;
      }
      reach_m_.push_back(
          std::max(graph.tiles[i].radius_m, count > 0.0 ? std::sqrt(sum / count) : 0.0));
    }
  }

  /// Placements of held tiles and of those without connection are given.
  std::vector<Affine> solve(const std::vector<Affine>& given, const std::vector<char>& is_given) {
    std::vector<Affine> out = solve_once(given, is_given, {});
    return options_.keep_size > 0.0 ? solve_once(given, is_given, out) : out;
  }

 private:
  using Row = std::vector<std::pair<std::uint32_t, double>>;

  /// @param turned  whose rotations the tiles are to have at their own size; empty: any size will
  /// do
  std::vector<Affine> solve_once(std::vector<Affine> given, const std::vector<char>& is_given,
                                 const std::vector<Affine>& turned) {
    rows_.clear();
    wishes_.clear();
    for (const Joint& joint : graph_.joints) add_joint(joint);
    for (std::uint32_t i = 0; i < graph_.tiles.size(); ++i) {
      const double w = std::sqrt(options_.rigidity) * graph_.tiles[i].radius_m;
      rows_.push_back({{6 * i + 2, w}, {6 * i + 5, -w}});
      rows_.push_back({{6 * i + 3, w}, {6 * i + 4, w}});
      if (turned.empty()) continue;
      const double angle_rad = std::atan2(turned[i].yx - turned[i].xy, turned[i].xx + turned[i].yy);
      const double size = w * std::sqrt(options_.keep_size);
      wishes_[rows_.size()] = 2.0 * size * std::cos(angle_rad);
      rows_.push_back({{6 * i + 2, size}, {6 * i + 5, size}});
      wishes_[rows_.size()] = 2.0 * size * std::sin(angle_rad);
      rows_.push_back({{6 * i + 4, size}, {6 * i + 3, -size}});
    }
    Eigen::VectorXd x(6 * static_cast<Eigen::Index>(given.size()));
    for (std::size_t i = 0; i < given.size(); ++i) {
      const Affine& m = given[i];
      const Point p = m(graph_.tiles[i].centroid);
      x.segment<6>(6 * static_cast<Eigen::Index>(i)) << p.x, p.y, m.xx, m.xy, m.yx, m.yy;
    }
    minimise(x, is_given);
    for (std::size_t i = 0; i < given.size(); ++i) {
      if (is_given[i] != 0) continue;
      const auto u = x.segment<6>(6 * static_cast<Eigen::Index>(i));
      given[i] = {u[2], u[3], u[4], u[5], {}};
      given[i].shift = Point{u[0], u[1]} - given[i].linear(graph_.tiles[i].centroid);
    }
    return given;
  }

  void add_joint(const Joint& joint) {
    const double weight = joint.kind == JointKind::kStreet ? options_.street_weight : 1.0;
    if (weight == 0.0) return;
    const double w = std::sqrt(weight);
    const Point da = joint.rest_a - graph_.tiles[joint.a].centroid;
    const Point db = joint.rest_b - graph_.tiles[joint.b].centroid;
    for (std::uint32_t axis = 0; axis < 2; ++axis) {
      const std::uint32_t a = 6 * joint.a + 2 + 2 * axis;
      const std::uint32_t b = 6 * joint.b + 2 + 2 * axis;
      rows_.push_back({{6 * joint.a + axis, w},
                       {a, w * da.x},
                       {a + 1, w * da.y},
                       {6 * joint.b + axis, -w},
                       {b, -w * db.x},
                       {b + 1, -w * db.y}});
    }
    const double common = w * std::sqrt(0.5e-6) * 0.5 * (reach_m_[joint.a] + reach_m_[joint.b]);
    for (std::uint32_t entry = 2; entry < 6; ++entry)
      rows_.push_back({{6 * joint.a + entry, common}, {6 * joint.b + entry, -common}});
  }

  void minimise(Eigen::VectorXd& x, const std::vector<char>& is_given) const {
    std::vector<Eigen::Index> column;
    Eigen::Index columns = 0;
    for (const char given : is_given) {
      for (int i = 0; i < 6; ++i) column.push_back(given != 0 ? -1 : columns++);
    }
    if (columns == 0) return;
    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(rows_.size()), columns);
    Eigen::VectorXd b = Eigen::VectorXd::Zero(a.rows());
    for (const auto& [row, wish] : wishes_) b[static_cast<Eigen::Index>(row)] = wish;
    for (Eigen::Index r = 0; r < a.rows(); ++r) {
      for (const auto& [unknown, value] : rows_[static_cast<std::size_t>(r)]) {
        if (column[unknown] >= 0) a(r, column[unknown]) += value;
        if (column[unknown] < 0) b[r] -= value * x[unknown];
      }
    }
    const Eigen::VectorXd free = a.colPivHouseholderQr().solve(b);
    for (std::size_t u = 0; u < column.size(); ++u) {
      if (column[u] >= 0) x[static_cast<Eigen::Index>(u)] = free[column[u]];
    }
  }

  const TileGraph& graph_;
  SolverOptions options_;
  std::vector<double> reach_m_;
  std::vector<Row> rows_;
  std::map<std::size_t, double> wishes_;  ///< right-hand sides that are not zero
};

/// Which tiles are given: held, or not connected to a held one.
std::vector<char> given_tiles(const TileGraph& graph, const std::vector<std::uint32_t>& held,
                              const SolverOptions& options) {
  std::vector<char> is_reached(graph.tiles.size(), 0);
  for (const std::uint32_t tile : held) is_reached[tile] = 1;
  for (std::size_t round = 0; round < graph.tiles.size(); ++round) {
    for (const Joint& joint : graph.joints) {
      if (joint.kind == JointKind::kStreet && options.street_weight == 0.0) continue;
      if (is_reached[joint.a] != 0 || is_reached[joint.b] != 0)
        is_reached[joint.a] = is_reached[joint.b] = 1;
    }
  }
  std::vector<char> out;
  for (const char reached : is_reached) out.push_back(reached == 0 ? 1 : 0);
  for (const std::uint32_t tile : held) out[tile] = 1;
  return out;
}

TEST(LayoutSolver, AgreesWithADenseQrOfThePapersSystem) {
  Rng rng = property_rng("AgreesWithADenseQrOfThePapersSystem");
  int solved_tiles = 0;
  for (int i = 0; i < iterations(400); ++i) {
    const TileGraph graph = random_graph(rng);
    const auto held = random_held(rng, graph);
    const SolverOptions options = random_options(rng);
    std::vector<Affine> given;
    for (std::size_t t = 0; t < graph.tiles.size(); ++t) given.push_back(random_affine(rng, 30));
    std::vector<Affine> targets;
    for (const std::uint32_t tile : held) targets.push_back(given[tile]);
    const auto is_given = given_tiles(graph, held, options);
    const LayoutSolution solution = solved(graph, held, targets, options, given);
    const auto expected = DenseOracle(graph, options).solve(given, is_given);
    // What rounding leaves free of a system whose condition is up to 1e9.
    EXPECT_LT(difference_m(graph, solution.placements, expected), 1e-4)
        << "case " << i << ", rigidity " << options.rigidity << ", street weight "
        << options.street_weight;
    const double least = measure_placements(graph, expected, options).objective;
    EXPECT_NEAR(solution.objective, least, 1e-8 * (1.0 + least));
    solved_tiles += static_cast<int>(std::ranges::count(is_given, 0));
  }
  EXPECT_GT(solved_tiles, 500);
}

/// A 3 x 3 city with three tiles of it held.
struct Pinned {
  TileGraph graph = graph_of(MadeCity{});
  std::vector<std::uint32_t> held{0, 44, 89};
};

TEST(LayoutSolver, RigidMotionOfAllHeldTilesMovesEverythingRigidly) {
  const Pinned city;
  Rng rng = property_rng("RigidMotion");
  for (int i = 0; i < iterations(20); ++i) {
    const Affine motion = random_similarity(rng, 1000.0);
    for (const auto& [rigidity, keep_size] :
         {std::pair{0.0, 0.0}, {1.0, 0.0}, {1e4, 0.0}, {1.0, 1.0}}) {
      const LayoutSolution solution =
          solved(city.graph, city.held, {motion, motion, motion}, {rigidity, 0.25, keep_size});
      EXPECT_LT(difference_m(city.graph, solution.placements,
                             std::vector<Affine>(city.graph.tiles.size(), motion)),
                kRounding_m);
      EXPECT_LT(solution.objective, kRounding_m * kRounding_m);
      EXPECT_LT(*std::ranges::max_element(solution.gaps_m), kRounding_m);
      EXPECT_LT(*std::ranges::max_element(solution.deformations), kRounding_m);
    }
  }
}

std::vector<Affine> dragged() {
  return {Affine{}, Affine::translation({14.0, -9.0}), Affine::rotation(0.1, {100.0, 100.0})};
}

TEST(LayoutSolver, TheGradientIsZeroAtTheSolution) {
  const Pinned city;
  const SolverOptions options{0.5, 0.25};
  const LayoutSolution best = solved(city.graph, city.held, dragged(), options);
  EXPECT_GT(best.objective, 1.0);
  Rng rng = property_rng("TheGradientIsZero");
  for (int i = 0; i < iterations(200); ++i) {
    // Along a line through the minimum a quadratic is as high on the one side as on the other.
    const auto tile = rng.index(city.graph.tiles.size());
    if (std::ranges::find(city.held, tile) != city.held.end()) continue;
    const Affine change{rng.uniform(-1, 1),
                        rng.uniform(-1, 1),
                        rng.uniform(-1, 1),
                        rng.uniform(-1, 1),
                        {rng.uniform(-9, 9), rng.uniform(-9, 9)}};
    const auto objective_at = [&](double along) {
      auto placements = best.placements;
      Affine& map = placements[tile];
      map = {map.xx + along * change.xx, map.xy + along * change.xy, map.yx + along * change.yx,
             map.yy + along * change.yy, map.shift + along * change.shift};
      return measure_placements(city.graph, placements, options).objective;
    };
    const double ahead = objective_at(1.0);
    const double back = objective_at(-1.0);
    EXPECT_GT(ahead, best.objective);
    EXPECT_NEAR(ahead, back, 1e-8 * ahead);
  }
}

TEST(LayoutSolver, ReportsWhatMeasurePlacementsMeasures) {
  const Pinned city;
  const LayoutSolution solution = solved(city.graph, city.held, dragged());
  const LayoutSolution again = measure_placements(city.graph, solution.placements, {});
  EXPECT_EQ(solution.gaps_m, again.gaps_m);
  EXPECT_EQ(solution.deformations, again.deformations);
  EXPECT_EQ(solution.objective, again.objective);
}

TEST(LayoutSolver, MeasuresGapsAndTheDifferenceOfSingularValues) {
  const TileGraph pair{{{{5, 5}, 7}, {{15, 5}, 7}},
                       {{0, {10, 0}, 1, {10, 0}, JointKind::kProperty},
                        {0, {10, 10}, 1, {10, 12}, JointKind::kStreet}}};
  const Affine wide{1.5, 0, 0, 1, {0, 0}};
  const LayoutSolution s = measure_placements(pair, {wide, Affine::translation({1, 0})}, {0, 1});
  EXPECT_NEAR(s.gaps_m[0], 4.0, 1e-12);
  EXPECT_NEAR(s.gaps_m[1], std::sqrt(20.0), 1e-12);
  EXPECT_NEAR(s.mean_property_gap_m, 4.0, 1e-12);
  EXPECT_NEAR(s.mean_street_gap_m, std::sqrt(20.0), 1e-12);
  EXPECT_NEAR(s.deformations[0], 0.5, 1e-12);
  EXPECT_NEAR(s.mean_deformation, 0.25, 1e-12);
}

TEST(LayoutSolver, KeptFactorisationGivesTheBytesOfAFreshOne) {
  const Pinned city;
  const LayoutSolver kept = solver_of(city.graph, city.held);
  for (int i = 0; i < 5; ++i) {
    auto targets = dragged();
    targets[1].shift.x += i;
    const auto solution = kept.solve(targets);
    ASSERT_TRUE(solution);
    EXPECT_EQ(solution->placements, solved(city.graph, city.held, targets).placements);
  }
}

TEST(LayoutSolver, OrderOfJointsAndOfTilesDoesNotMatter) {
  const Pinned city;
  const LayoutSolution straight = solved(city.graph, city.held, dragged());
  const auto count = static_cast<std::uint32_t>(city.graph.tiles.size());
  TileGraph turned = city.graph;
  std::ranges::reverse(turned.tiles);
  std::ranges::reverse(turned.joints);
  for (Joint& j : turned.joints) {
    j = {count - 1 - j.b, j.rest_b, count - 1 - j.a, j.rest_a, j.kind};
  }
  auto targets = dragged();
  std::ranges::reverse(targets);
  std::vector<std::uint32_t> held;
  for (const std::uint32_t tile : city.held) held.insert(held.begin(), count - 1 - tile);
  LayoutSolution other = solved(turned, held, targets);
  std::ranges::reverse(other.placements);
  EXPECT_LT(difference_m(city.graph, straight.placements, other.placements), kRounding_m);
  EXPECT_NEAR(straight.objective, other.objective, 1e-9 * straight.objective);
}

/// The whole problem seen through a map of the plane.
struct Twin {
  Affine map;
  double length_factor;
};

TEST(LayoutSolver, TurnedMirroredAndScaledProblemsHaveTurnedMirroredAndScaledSolutions) {
  const Pinned city;
  const LayoutSolution straight = solved(city.graph, city.held, dragged());
  const Twin twins[] = {{Affine::rotation(0.7, {300, 20}), 1.0},
                        {{-1, 0, 0, 1, {0, 0}}, 1.0},
                        {{3, 0, 0, 3, {0, 0}}, 3.0},
                        {{0.01, 0, 0, 0.01, {1e4, 1e4}}, 0.01}};
  for (const auto& [map, factor] : twins) {
    TileGraph graph = city.graph;
    for (TileNode& node : graph.tiles) node = {map(node.centroid), factor * node.radius_m};
    for (Joint& joint : graph.joints) {
      joint.rest_a = map(joint.rest_a);
      joint.rest_b = map(joint.rest_b);
    }
    const Affine back = map.inverse().value();
    auto targets = dragged();
    for (Affine& target : targets) target = map * target * back;
    LayoutSolution twin = solved(graph, city.held, targets);
    for (Affine& placement : twin.placements) placement = back * placement * map;
    EXPECT_LT(difference_m(city.graph, straight.placements, twin.placements), 1e-6);
    EXPECT_NEAR(twin.objective, factor * factor * straight.objective,
                1e-6 * factor * factor * straight.objective);
    EXPECT_NEAR(twin.mean_deformation, straight.mean_deformation, 1e-6);
  }
}

/// The city's west and east pulled apart.
LayoutSolution stretched(const SolverOptions& options) {
  const TileGraph graph = graph_of(MadeCity{.blocks_x = 5});
  std::vector<std::uint32_t> held;
  std::vector<Affine> targets;
  for (std::uint32_t i = 0; i < graph.tiles.size(); ++i) {
    const std::uint32_t column = i / 10 % 5;
    if (column != 0 && column != 4) continue;
    held.push_back(i);
    targets.push_back(Affine::translation({column == 0 ? -30.0 : 30.0, 0.0}));
  }
  return solved(graph, held, targets, options);
}

/// Root mean square over the tiles of how far their size is from what it was.
double size_change(const LayoutSolution& solution) {
  double sum = 0.0;
  for (const Affine& map : solution.placements) {
    const double change = 0.5 * std::hypot(map.xx + map.yy, map.yx - map.xy) - 1.0;
    sum += change * change;
  }
  return std::sqrt(sum / static_cast<double>(solution.placements.size()));
}

TEST(LayoutSolver, TilesGrowUnderAStretchUnlessTheyAreToKeepTheirSize) {
  const double free = size_change(stretched({1e3, 0.25, 0.0}));
  EXPECT_GT(free, 0.05);
  EXPECT_LT(size_change(stretched({1e3, 0.25, 0.1})), 0.1 * free);
  EXPECT_LT(size_change(stretched({1e3, 0.25, 1.0})), 0.01 * free);
}

TEST(LayoutSolver, KeepingSizeIsAskedInProportionToRigidity) {
  const LayoutSolution free = stretched({0.0, 0.25, 0.0});
  EXPECT_EQ(stretched({0.0, 0.25, 1.0}).placements, free.placements);
  EXPECT_LT(size_change(stretched({10.0, 0.25, 1.0})), size_change(stretched({1.0, 0.25, 1.0})));
}

TEST(LayoutSolver, LargerRigidityTradesDeformationForGaps) {
  const Pinned city;
  double deformation = std::numeric_limits<double>::infinity();
  double gap_m = 0.0;
  for (const double rigidity : {0.0, 0.01, 0.1, 1.0, 10.0, 1e3}) {
    const LayoutSolution s = solved(city.graph, city.held, dragged(), {rigidity, 0.25});
    const double gaps =
        std::transform_reduce(s.gaps_m.begin(), s.gaps_m.end(), city.graph.joints.begin(), 0.0,
                              std::plus<>(), [](double gap, const Joint& joint) {
                                return (joint.kind == JointKind::kStreet ? 0.25 : 1.0) * gap * gap;
                              });
    EXPECT_LT(s.mean_deformation, deformation);
    EXPECT_GT(gaps, gap_m);
    deformation = s.mean_deformation;
    gap_m = gaps;
  }
}

}  // namespace
}  // namespace plat::tiles
