#include "tiles/layout_solver.h"

#include <fmt/format.h>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <optional>

#include "tiles/layout_equations_internal.h"

namespace plat::tiles {

using detail::Complex;
using detail::Equation;
using detail::kUnknownsPerTile;
using detail::LayoutEquations;
using detail::State;
using detail::Term;

namespace {

using Matrix = Eigen::SparseMatrix<Complex>;

/// Solves after the first, each with the gradient that the one before has left. One brings the
/// gradient down to rounding (ADR 0038).
constexpr int kRefinements = 1;

/// Area that a target must leave of a unit square. A smaller one is a line to the working grid.
constexpr double kSmallestDeterminant = 1e-9;

bool is_finite(Point p) { return std::isfinite(p.x) && std::isfinite(p.y); }

std::optional<Failure> find_defect(const TileGraph& graph) {
  const auto out_of_range = [](std::string message) {
    return Failure{FailureCode::kOutOfRange, std::move(message)};
  };
  for (std::size_t i = 0; i < graph.tiles.size(); ++i) {
    const TileNode& node = graph.tiles[i];
    if (!is_finite(node.centroid))
      return out_of_range(fmt::format("tile {}: its centroid is not finite", i));
    if (!std::isfinite(node.radius_m) || node.radius_m <= 0.0)
      return out_of_range(fmt::format("tile {}: radius {} m, allowed > 0", i, node.radius_m));
    if (!std::isfinite(node.rigidity) || node.rigidity < 0.0)
      return out_of_range(fmt::format("tile {}: rigidity {}, allowed >= 0", i, node.rigidity));
  }
  for (std::size_t j = 0; j < graph.joints.size(); ++j) {
    const Joint& joint = graph.joints[j];
    if (std::max(joint.a, joint.b) >= graph.tiles.size())
      return out_of_range(fmt::format("joint {}: joins tiles {} and {} of {}", j, joint.a, joint.b,
                                      graph.tiles.size()));
    if (!is_finite(joint.rest_a) || !is_finite(joint.rest_b))
      return out_of_range(fmt::format("joint {}: a point is not finite", j));
    if (!std::isfinite(joint.weight) || joint.weight < 0.0)
      return out_of_range(fmt::format("joint {}: weight {}, allowed >= 0", j, joint.weight));
  }
  return std::nullopt;
}

std::optional<Failure> find_defect(std::span<const std::uint32_t> held, std::size_t tiles) {
  for (std::size_t i = 0; i < held.size(); ++i) {
    if (held[i] >= tiles)
      return Failure{FailureCode::kOutOfRange,
                     fmt::format("held tile {} of {} tiles", held[i], tiles)};
    if (i > 0 && held[i] <= held[i - 1])
      return Failure{FailureCode::kOutOfRange,
                     fmt::format("held tile {} after {}: not ascending", held[i], held[i - 1])};
  }
  return std::nullopt;
}

std::optional<Failure> find_defect(const SolverOptions& options) {
  // Not written as < and >: a NaN is in no range.
  if (!(options.rigidity >= 0.0 && std::isfinite(options.rigidity)))
    return Failure{FailureCode::kOutOfRange,
                   fmt::format("rigidity {}, allowed >= 0", options.rigidity)};
  if (!(options.street_weight >= 0.0 && std::isfinite(options.street_weight)))
    return Failure{FailureCode::kOutOfRange,
                   fmt::format("street_weight {}, allowed >= 0", options.street_weight)};
  if (!(options.keep_size >= 0.0 && options.keep_size <= 1.0))
    return Failure{FailureCode::kOutOfRange,
                   fmt::format("keep_size {}, allowed 0 to 1", options.keep_size)};
  return std::nullopt;
}

/// Per tile, whether joints with a weight connect it to a held one.
std::vector<char> reached_from(std::span<const std::uint32_t> held, const TileGraph& graph,
                               const LayoutEquations& equations) {
  std::vector<std::vector<std::uint32_t>> neighbours(graph.tiles.size());
  for (const Joint& joint : graph.joints) {
    if (equations.joint_weight(joint) <= 0.0) continue;
    neighbours[joint.a].push_back(joint.b);
    neighbours[joint.b].push_back(joint.a);
  }
  std::vector<char> is_reached(graph.tiles.size(), 0);
  std::vector<std::uint32_t> open(held.begin(), held.end());
  for (const std::uint32_t tile : held) is_reached[tile] = 1;
  while (!open.empty()) {
    const std::uint32_t tile = open.back();
    open.pop_back();
    for (const std::uint32_t next : neighbours[tile]) {
      if (is_reached[next] != 0) continue;
      is_reached[next] = 1;
      open.push_back(next);
    }
  }
  return is_reached;
}

/// The similarity that is nearest to all targets. Where everything moves by one similarity, it is
/// this one, and nothing is left to solve for.
Affine common_similarity(const TileGraph& graph, std::span<const std::uint32_t> held,
                         std::span<const Affine> targets) {
  if (held.empty()) return {};
  const double count = static_cast<double>(held.size());
  Point from;
  Point to;
  for (std::size_t i = 0; i < held.size(); ++i) {
    const Point centroid = graph.tiles[held[i]].centroid;
    from = from + centroid / count;
    to = to + targets[i](centroid) / count;
  }
  Complex turned = 0.0;
  double norm = 0.0;
  for (std::size_t i = 0; i < held.size(); ++i) {
    const TileNode& node = graph.tiles[held[i]];
    const Affine& target = targets[i];
    const Complex a(0.5 * (target.xx + target.yy), 0.5 * (target.yx - target.xy));
    const double square_m2 = node.radius_m * node.radius_m;
    turned += std::conj(detail::complex_of(node.centroid - from)) *
                  detail::complex_of(target(node.centroid) - to) +
              square_m2 * a;
    norm += squared_length(node.centroid - from) + square_m2;
  }
  const Complex a = turned / norm;
  Affine out{a.real(), -a.imag(), a.imag(), a.real(), {}};
  out.shift = to - out.linear(from);
  return out;
}

/// Singular values' difference: the norm of the paper's (3).
double deformation_of(const Affine& map) { return std::hypot(map.xx - map.yy, map.xy + map.yx); }

LayoutSolution measured(const TileGraph& graph, const LayoutEquations& equations,
                        std::vector<Affine> placements) {
  LayoutSolution out;
  State state(static_cast<Eigen::Index>(placements.size() * kUnknownsPerTile));
  for (std::uint32_t i = 0; i < placements.size(); ++i)
    equations.set_state(state, i, placements[i]);
  equations.for_each([&](const Equation& equation) {
    out.objective += equation.weight * std::norm(equation.residual(state));
  });
  for (std::uint32_t i = 0; i < placements.size() && equations.has_size(); ++i) {
    const Equation size = equations.size(i);
    out.objective += size.weight * std::norm(size.residual(state) - equations.size_wish(state, i));
  }
  out.gaps_m.reserve(graph.joints.size());
  double property_joints = 0.0;
  double street_joints = 0.0;
  for (const Joint& joint : graph.joints) {
    const double gap =
        distance(placements[joint.a](joint.rest_a), placements[joint.b](joint.rest_b));
    out.gaps_m.push_back(gap);
    const bool is_street = joint.kind == JointKind::kStreet;
    (is_street ? out.mean_street_gap_m : out.mean_property_gap_m) += gap;
    ++(is_street ? street_joints : property_joints);
  }
  out.mean_street_gap_m /= std::max(street_joints, 1.0);
  out.mean_property_gap_m /= std::max(property_joints, 1.0);
  for (const Affine& placement : placements) {
    out.deformations.push_back(deformation_of(placement));
    out.mean_deformation += out.deformations.back() / static_cast<double>(placements.size());
  }
  out.placements = std::move(placements);
  return out;
}

bool is_sound(const LayoutSolution& solution) {
  return std::isfinite(solution.objective) &&
         std::ranges::all_of(solution.placements, &Affine::is_finite);
}

}  // namespace

struct LayoutSolver::System {
  using Factor = Eigen::SimplicialLDLT<Matrix, Eigen::Lower>;

  System(TileGraph g, std::vector<std::uint32_t> h, const SolverOptions& options)
      : graph(std::move(g)), held(std::move(h)), equations(graph, options) {}

  TileGraph graph;
  std::vector<std::uint32_t> held;
  LayoutEquations equations;
  std::vector<char> is_reached;  ///< per tile: from a held one
  std::vector<int> column;       ///< per unknown of the state; -1 where it is given
  Eigen::Index columns = 0;
  Factor factor;        ///< of the paper's equations
  Factor sized_factor;  ///< with those of size, where they have a weight

  void number_unknowns() {
    is_reached = reached_from(held, graph, equations);
    std::vector<char> is_free = is_reached;
    for (const std::uint32_t tile : held) is_free[tile] = 0;
    for (const char free : is_free) {
      for (std::uint32_t part = 0; part < kUnknownsPerTile; ++part)
        column.push_back(free != 0 ? static_cast<int>(columns++) : -1);
    }
  }

  [[nodiscard]] bool is_free(std::uint32_t tile) const {
    return column[tile * kUnknownsPerTile] >= 0;
  }

  /// @returns whether there is a factorisation
  bool factorise() {
    Matrix matrix = normal_matrix();
    // A negative or vanishing pivot is a system that rounding has made singular.
    const auto succeeds = [&](Factor& out) {
      out.compute(matrix);
      return out.info() == Eigen::Success && out.vectorD().real().minCoeff() > 0.0;
    };
    if (!succeeds(factor)) return false;
    if (!equations.has_size()) return true;
    for (std::uint32_t i = 0; i < graph.tiles.size(); ++i) {
      if (!is_free(i)) continue;
      const Equation size = equations.size(i);
      const int a = column[size.terms[0].unknown];
      matrix.coeffRef(a, a) += size.weight * std::norm(size.terms[0].coefficient);
    }
    return succeeds(sized_factor);
  }

  /// The lower triangle of the normal equations.
  [[nodiscard]] Matrix normal_matrix() const {
    std::vector<Eigen::Triplet<Complex>> entries;
    equations.for_each([&](const Equation& equation) {
      for (const Term& row : equation.view()) {
        for (const Term& other : equation.view()) {
          const int i = column[row.unknown];
          const int j = column[other.unknown];
          if (i < 0 || j < 0 || i < j) continue;
          entries.emplace_back(i, j,
                               equation.weight * std::conj(row.coefficient) * other.coefficient);
        }
      }
    });
    Matrix out(columns, columns);
    out.setFromTriplets(entries.begin(), entries.end());
    return out;
  }

  /// Down the gradient of half the paper's objective.
  [[nodiscard]] State descent(const State& state) const {
    State out = State::Zero(columns);
    equations.for_each([&](const Equation& equation) {
      const Complex weighted = equation.weight * equation.residual(state);
      for (const Term& term : equation.view()) {
        const int i = column[term.unknown];
        if (i >= 0) out[i] -= std::conj(term.coefficient) * weighted;
      }
    });
    return out;
  }

  /// That of size, with every tile's wish.
  void add_descent_of_size(const State& state, std::span<const Complex> wishes, State& out) const {
    for (std::uint32_t i = 0; i < graph.tiles.size(); ++i) {
      if (!is_free(i)) continue;
      const Equation size = equations.size(i);
      const Term& term = size.terms[0];
      out[column[term.unknown]] -=
          std::conj(term.coefficient) * size.weight * (size.residual(state) - wishes[i]);
    }
  }

  void step(State& state, const State& by) const {
    for (std::size_t u = 0; u < column.size(); ++u) {
      if (column[u] >= 0) state[static_cast<Eigen::Index>(u)] += by[column[u]];
    }
  }

  void minimise(State& state) const {
    if (columns == 0) return;
    for (int round = 0; round <= kRefinements; ++round) step(state, factor.solve(descent(state)));
    if (!equations.has_size()) return;
    std::vector<Complex> wishes;
    for (std::uint32_t i = 0; i < graph.tiles.size(); ++i)
      wishes.push_back(equations.size_wish(state, i));
    for (int round = 0; round <= kRefinements; ++round) {
      State down = descent(state);
      add_descent_of_size(state, wishes, down);
      step(state, sized_factor.solve(down));
    }
  }
};

Expected<LayoutSolver> LayoutSolver::make(TileGraph graph, std::vector<std::uint32_t> held,
                                          const SolverOptions& options) {
  if (auto defect = find_defect(graph)) return tl::unexpected(*defect);
  if (auto defect = find_defect(held, graph.tiles.size())) return tl::unexpected(*defect);
  if (auto defect = find_defect(options)) return tl::unexpected(*defect);
  auto system = std::make_shared<System>(std::move(graph), std::move(held), options);
  system->number_unknowns();
  if (system->columns > 0 && !system->factorise())
    return fail(FailureCode::kNoConvergence,
                fmt::format("the layout's equations cannot be factorised: {} tiles, {} held",
                            system->graph.tiles.size(), system->held.size()));
  return LayoutSolver(std::move(system));
}

Expected<LayoutSolution> LayoutSolver::solve(std::span<const Affine> targets,
                                             std::span<const Affine> resting) const {
  const System& system = *system_;
  const std::size_t tiles = system.graph.tiles.size();
  expects(targets.size() == system.held.size(), "one target per held tile");
  expects(resting.empty() || resting.size() == tiles, "one resting placement per tile, or none");
  for (std::size_t i = 0; i < targets.size(); ++i) {
    if (!targets[i].is_finite() || std::abs(targets[i].determinant()) < kSmallestDeterminant)
      return fail(FailureCode::kOutOfRange,
                  fmt::format("held tile {}: its target is not finite or has no area left",
                              system.held[i]));
  }
  if (!std::ranges::all_of(resting, &Affine::is_finite))
    return fail(FailureCode::kOutOfRange, "a resting placement is not finite");

  std::vector<Affine> placements(tiles, common_similarity(system.graph, system.held, targets));
  for (std::uint32_t i = 0; i < tiles; ++i) {
    if (system.is_reached[i] == 0) placements[i] = resting.empty() ? Affine{} : resting[i];
  }
  for (std::size_t i = 0; i < targets.size(); ++i) placements[system.held[i]] = targets[i];

  State state(static_cast<Eigen::Index>(tiles * kUnknownsPerTile));
  for (std::uint32_t i = 0; i < tiles; ++i) system.equations.set_state(state, i, placements[i]);
  system.minimise(state);
  for (std::uint32_t i = 0; i < tiles; ++i) {
    if (system.is_free(i)) placements[i] = system.equations.placement(state, i);
  }
  LayoutSolution out = measured(system.graph, system.equations, std::move(placements));
  if (!is_sound(out))
    return fail(FailureCode::kNoConvergence, "the layout's solution is not finite");
  return out;
}

const TileGraph& LayoutSolver::graph() const { return system_->graph; }
std::span<const std::uint32_t> LayoutSolver::held() const { return system_->held; }

LayoutSolution measure_placements(const TileGraph& graph, std::vector<Affine> placements,
                                  const SolverOptions& options) {
  expects(placements.size() == graph.tiles.size(), "one placement per tile");
  return measured(graph, LayoutEquations(graph, options), std::move(placements));
}

}  // namespace plat::tiles
