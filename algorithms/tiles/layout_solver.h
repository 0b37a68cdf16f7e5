#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "core/affine.h"
#include "core/failure.h"
#include "core/options.h"
#include "tiles/tile_graph.h"

namespace plat::tiles {

struct SolverOptions {
  double rigidity = 1.0;        ///< weight of deformation equations; 0: any affine map is free
  double street_weight = 0.25;  ///< of gaps across streets, against 1 of gaps between neighbours
  double keep_size = 0.0;       ///< how much of rigidity is against growing and shrinking
  static constexpr auto fields() {
    using O = SolverOptions;
    return std::tuple{
        Field{"rigidity", &O::rigidity, 0.0, 1e4,
              "Weight that keeps tiles from being deformed, against gaps; large: rigid, small: "
              "affine."},
        Field{"street_weight", &O::street_weight, 0.0, 1.0,
              "Weight of gaps across streets, against 1 of gaps between neighbours."},
        Field{"keep_size", &O::keep_size, 0.0, 1.0,
              "Share of rigidity that is against growing and shrinking; 0: size is free, as in the "
              "paper; 1: large rigidity is rigid."}};
  }
};

/// Where every tile goes, and what is left of the errors.
struct LayoutSolution {
  std::vector<Affine> placements;    ///< per tile, from rest
  std::vector<double> gaps_m;        ///< per joint: distance of the two points
  std::vector<double> deformations;  ///< per tile: difference of the map's singular values, (3)
  double mean_property_gap_m = 0.0;
  double mean_street_gap_m = 0.0;
  double mean_deformation = 0.0;
  double objective = 0.0;  ///< the weighted sum of squares
};

/// Finds the affine maps of all tiles that leave the least weighted sum of squared gaps and
/// deformations, some tiles held in place. The factorisation depends on which tiles are held, not
/// on where: dragging them is a solve with another right-hand side.
///
/// Guarantees: 1. no placement holds a NaN or an infinity;  2. tiles that no joints with a weight
/// connect to a held tile stay where `resting` has them;  3. a rigid motion of all held tiles moves
/// everything that they are connected to rigidly, with no error;  4. the same input gives the same
/// bytes, from a kept factorisation as from a fresh one.
/// Complexity:    factorisation O(n^1.5) and solve O(n log n) of n tiles that lie in the plane
/// Paper:         [ABVA08, Sec. 4.1, (1) and (3)]; `rigidity` is its global weight
/// Deviation:     (2) as printed holds neighbour k in place (it drops M_k) and adds c_i + d_ij
///                twice: solved is (1), both tiles free; deformations are multiplied by the tile's
///                radius, so that all residuals are in metres; held tiles are eliminated; what
///                joints leave free of a tile's map is taken from its neighbours; (3) lets tiles
///                grow: `keep_size` asks in a second linear solution for the rotations of the first
///                one, at the tiles' own size (ADR 0038)
class LayoutSolver {
 public:
  /// Factorises. `held`: indices of tiles, ascending, each once.
  /// Failures: kOutOfRange for an index, a weight or a point that is not finite; kNoConvergence
  /// where the system cannot be factorised.
  static Expected<LayoutSolver> make(TileGraph graph, std::vector<std::uint32_t> held,
                                     const SolverOptions& options);

  /// @param targets  where the held tiles are to be, in the order of `held`, from rest
  /// @param resting  per tile, where those are that nothing connects to a held one; empty: at rest
  /// Failures: kOutOfRange for a target that is not finite or has no area left.
  [[nodiscard]] Expected<LayoutSolution> solve(std::span<const Affine> targets,
                                               std::span<const Affine> resting = {}) const;

  [[nodiscard]] const TileGraph& graph() const;
  [[nodiscard]] std::span<const std::uint32_t> held() const;

 private:
  struct System;
  explicit LayoutSolver(std::shared_ptr<const System> system) : system_(std::move(system)) {}
  std::shared_ptr<const System> system_;
};

/// Errors of given placements, as the solver measures them.
LayoutSolution measure_placements(const TileGraph& graph, std::vector<Affine> placements,
                                  const SolverOptions& options);

}  // namespace plat::tiles
