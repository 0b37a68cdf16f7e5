#pragma once

#include <Eigen/Core>
#include <array>
#include <complex>
#include <span>

#include "tiles/layout_solver.h"

namespace plat::tiles::detail {

using Complex = std::complex<double>;
using State = Eigen::VectorXcd;

/// Unknowns per tile. With points as complex numbers every affine map is z -> p + a d + b conj(d),
/// d = z - centroid: a turns and scales, b deforms, and every equation is linear over the complex
/// numbers. So the paper's 6 real unknowns are 3 complex ones, and a factorisation costs a third.
inline constexpr std::uint32_t kUnknownsPerTile = 3;

/// One unknown in one equation.
struct Term {
  std::uint32_t unknown = 0;
  Complex coefficient;
};

/// "The sum of the terms is zero", which holds as well as its weight asks for: every equation is
/// homogeneous over the state of all tiles, those that are held included.
struct Equation {
  std::array<Term, 2 * kUnknownsPerTile> terms;
  std::uint32_t size = 0;
  double weight = 0.0;  ///< of the squared residual in the objective

  [[nodiscard]] std::span<const Term> view() const { return {terms.data(), size}; }
  [[nodiscard]] Complex residual(const State& state) const {
    Complex sum = 0.0;
    for (const Term& term : view())
      sum += term.coefficient * state[static_cast<Eigen::Index>(term.unknown)];
    return sum;
  }
};

inline Complex complex_of(Point p) { return {p.x, p.y}; }
inline Point point_of(Complex z) { return {z.real(), z.imag()}; }

/// Weight of a tile's turning and deforming as its neighbours do, against 1 of their gap. So small
/// that it is not seen where the joints decide (a millimetre of the objective a metre of gap), and
/// large enough that a tile that they leave free is not left to rounding.
inline constexpr double kCommonMapWeight = 1e-6;

/// The equations of a graph.
class LayoutEquations {
 public:
  LayoutEquations(const TileGraph& graph, const SolverOptions& options);

  [[nodiscard]] double joint_weight(const Joint& joint) const {
    return joint.weight * (joint.kind == JointKind::kStreet ? street_weight_ : 1.0);
  }

  /// (p, s a, s b) with s the reach of the tile, so that every unknown is in metres.
  void set_state(State& state, std::uint32_t tile, const Affine& placement) const;
  [[nodiscard]] Affine placement(const State& state, std::uint32_t tile) const;

  /// Whether size is anything to any tile.
  [[nodiscard]] bool has_size() const { return rigidity_ * keep_size_ > 0.0; }
  /// What the tile's `a` is measured by, and what it should then be: the rotation that the state
  /// has for the tile, at the tile's size. Not homogeneous, so not among those of for_each.
  [[nodiscard]] Equation size(std::uint32_t tile) const;
  [[nodiscard]] Complex size_wish(const State& state, std::uint32_t tile) const;

  /// Calls visit(const Equation&) for gaps, common maps and deformations, in this order.
  template <class Visit>
  void for_each(Visit visit) const {
    for (const Joint& joint : graph_->joints) {
      if (joint_weight(joint) <= 0.0) continue;
      visit(gap(joint));
      visit(common_map(joint, 1));
      visit(common_map(joint, 2));
    }
    for (std::uint32_t i = 0; i < graph_->tiles.size(); ++i) visit(deformation(i));
  }

 private:
  /// (1): the two points of a joint are one.
  [[nodiscard]] Equation gap(const Joint& joint) const;
  /// Part 1 (a) or 2 (b) of both maps are the same.
  [[nodiscard]] Equation common_map(const Joint& joint, std::uint32_t part) const;
  /// (3): 2 b = (M00 - M11) + i (M01 + M10), times the tile's radius.
  [[nodiscard]] Equation deformation(std::uint32_t tile) const;

  const TileGraph* graph_;
  double rigidity_;
  double street_weight_;
  double keep_size_;
  std::vector<double> reach_m_;  ///< per tile
};

}  // namespace plat::tiles::detail
