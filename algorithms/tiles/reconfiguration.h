#pragma once

#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "core/affine.h"
#include "core/failure.h"
#include "core/options.h"
#include "tiles/layout_solver.h"
#include "tiles/tile_layout.h"

namespace plat::tiles {

/// When a deformed tile gives way to another one, and to which [ABVA08, Sec. 4.2].
struct ReplacementOptions {
  std::string similarity = "affine_vertex";  ///< of the registry (similarity/shape_similarity.h)
  OptionMap similarity_options;
  double deformation_threshold = 0.25;  ///< a tile deformed by more is replaced if that helps
  double gap_threshold_m = 4.0;         ///< or one with a larger mean gap to its neighbours
  int candidates = 5;                   ///< the most similar ones that are tried
  int max_rounds = 10;
};

struct ReconfigurationOptions {
  SolverOptions solver;
  /// Tiles farther than this from what an operation moves stay where they are; none: all are free.
  std::optional<double> reach_m = 400.0;
  std::optional<ReplacementOptions> replacement;  ///< none: nothing is replaced
};

/// What an operation did.
struct ReconfigurationReport {
  std::vector<TileId> moved;     ///< whose placement changed
  std::vector<TileId> appeared;  ///< pasted and replacing tiles
  std::vector<TileId> vanished;  ///< cut and replaced tiles
  std::size_t replacements = 0;
  std::size_t replacements_refused = 0;  ///< tried, and the total error did not fall
  std::size_t rounds = 0;                ///< of solving
  double mean_property_gap_m = 0.0;      ///< before gaps are closed
  double mean_street_gap_m = 0.0;
  double mean_deformation = 0.0;
  double largest_deformation = 0.0;
  double objective = 0.0;
};

struct Reconfiguration {
  TileLayout layout;
  ReconfigurationReport report;
};

/// Tiles by value, with where they were: what copy takes and paste puts down.
struct TileGroup {
  TileLayout tiles;  ///< vertices and links within the group
};

/// What becomes of land that tiles leave.
enum class VacatedLand {
  kVacant,  ///< a tile without zone stays in the place
  kClosed,  ///< the neighbours draw together over it
};

/// All operations: a failure changes nothing; kUnknownEntity for an id that no tile has;
/// kTilesOverlap where tiles would overlap or be turned inside out; kOutOfRange for a map that is
/// not finite. The result is a layout with all its invariants; tiles of a block are a coverage.

/// Moves tiles by a map of the plane (a translation, a rotation) and pins them there; the others
/// make room.
Expected<Reconfiguration> move_tiles(const TileLayout& layout, std::span<const TileId> tiles,
                                     const Affine& motion, const ReconfigurationOptions& options);

/// Solves again with the pins as they are.
Expected<Reconfiguration> relax(const TileLayout& layout, const ReconfigurationOptions& options);

Expected<TileGroup> copy_tiles(const TileLayout& layout, std::span<const TileId> tiles);

Expected<Reconfiguration> cut_tiles(const TileLayout& layout, std::span<const TileId> tiles,
                                    VacatedLand land, const ReconfigurationOptions& options);

/// Puts a group down where `to` carries it: it takes the place of the most similar tile or union of
/// tiles there, and inherits what they were joined to.
Expected<Reconfiguration> paste_tiles(const TileLayout& layout, const TileGroup& group,
                                      const Affine& to, const ReconfigurationOptions& options);

/// Replaces tiles over the thresholds, in rounds, until none is left or none helps.
Expected<Reconfiguration> replace_deformed_tiles(const TileLayout& layout,
                                                 const ReplacementOptions& replacement,
                                                 const ReconfigurationOptions& options);

}  // namespace plat::tiles
