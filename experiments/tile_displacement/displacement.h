#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/affine.h"
#include "core/failure.h"
#include "tiles/layout_solver.h"
#include "tiles/tile_layout.h"

namespace plat::displacement {

/// What finds the free tiles of a displaced layout.
enum class Method {
  kSolver,  ///< tiles/layout_solver.h
  kWarp,    ///< tiles/mesh_warp.h
  kNone,    ///< free tiles stay where the displacement has them
};

struct Way {
  std::string name;
  Method method = Method::kSolver;
  tiles::SolverOptions solver;
};

/// What a tile does.
enum class Role {
  kMoved,  ///< held where its motion carries it
  kHeld,   ///< stays where it is
  kFree,   ///< makes room
};
std::string_view role_name(Role role);

/// Which tiles are moved, where to, and which stay.
struct Displacement {
  std::vector<Role> roles;      ///< per tile
  std::vector<Affine> targets;  ///< per tile; where free tiles are now
};

/// Everything free, where it is.
Displacement undisplaced(const tiles::TileLayout& layout);

/// Holds all tiles that are farther than `reach_m` from the boxes of moved tiles, before and after,
/// and those that are pinned: what tiles::move_tiles holds.
void hold_beyond(const tiles::TileLayout& layout, double reach_m, Displacement& displacement);

/// Tiles after a displacement.
struct Outcome {
  tiles::LayoutSolution solution;         ///< of a warp: the affine maps nearest to it
  std::vector<std::vector<Point>> outer;  ///< per tile: its outer ring, gaps closed
  /// Per joint, before gaps are closed. A warp has none: it carries all tiles, held ones too.
  std::vector<double> joint_gaps_m;
};

/// Failures: those of LayoutSolver and MeshWarp.
Expected<Outcome> displaced(const tiles::TileLayout& layout, const tiles::TileGraph& graph,
                            const Displacement& displacement, const Way& way);

/// Of the free tiles, of joints that touch one, and of the tiles that are to stay.
struct Errors {
  std::size_t free_tiles = 0;
  double property_gap_m = 0.0;  ///< mean over joints
  double street_gap_m = 0.0;
  double gap_m = 0.0;        ///< of both kinds
  double deformation = 0.0;  ///< mean over tiles of the difference of singular values
  double largest_deformation = 0.0;
  double size_change = 0.0;         ///< mean of |log size|, the size a length
  double closed_deformation = 0.0;  ///< of the maps nearest to the tiles once gaps are closed
  double non_affine_m = 0.0;        ///< root mean square of what those maps leave, mean over tiles
  std::size_t held_tiles = 0;       ///< tiles that are to stay; moved ones are not among them
  double held_deformation = 0.0;    ///< as closed_deformation, of these
  double held_off_m = 0.0;  ///< distance of their corners from where they belong, mean over tiles
  double largest_held_off_m = 0.0;  ///< of any corner
};

Errors errors_of(const tiles::TileLayout& layout, const tiles::TileGraph& graph,
                 const std::vector<Role>& roles, const Outcome& outcome);

/// Length by which a map makes things larger, on the mean of all directions.
double size_of(const Affine& map);

/// The outer rings of a layout as it is.
std::vector<std::vector<Point>> outer_rings(const tiles::TileLayout& layout);

}  // namespace plat::displacement
