#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "core/affine.h"
#include "core/failure.h"
#include "core/options.h"
#include "tiles/layout_solver.h"
#include "tiles/tile_layout.h"

namespace plat::tiles {

/// When a deformed tile gives way to another one, and to which [ABVA08, Sec. 4.2].
struct ReplacementOptions {
  double deformation_threshold = 0.25;  ///< a tile deformed by more is replaced if that helps
  double gap_threshold_m = 4.0;         ///< or one with a larger mean gap to its neighbours
  int candidates = 5;                   ///< the most similar ones that are tried
  int unions = 0;                       ///< the most similar unions of two tiles that are tried
  int max_rounds = 10;
  static constexpr auto fields() {
    using O = ReplacementOptions;
    return std::tuple{
        Field{"deformation_threshold", &O::deformation_threshold, 0.0, 1e3,
              "A tile deformed by more gives way to a similar one if that lowers the total error."},
        Field{"gap_threshold_m", &O::gap_threshold_m, 0.0, 1e4,
              "So does a tile with a larger mean gap to its neighbours."},
        Field{"candidates", &O::candidates, 1, 1000, "How many of the most similar are tried."},
        Field{"unions", &O::unions, 0, 1000,
              "How many of the most similar unions of two adjacent tiles are tried after them."},
        Field{"max_rounds", &O::max_rounds, 1, 1000, "Rounds of replacing and solving."}};
  }
};

/// What a pasted tile does while its neighbours make room.
enum class PastedTiles {
  kHeld,  ///< keeps its size and shape
  kFree,  ///< is solved as its neighbours are: it may be turned, scaled and deformed
};

struct ReconfigurationOptions {
  SolverOptions solver;
  /// Tiles farther than this from what an operation moves stay where they are; none: all are free.
  std::optional<double> reach_m = 400.0;
  PastedTiles pasted = PastedTiles::kHeld;
  std::string similarity = "affine_vertex";  ///< of the registry (similarity/shape_similarity.h)
  OptionMap similarity_options;
  std::optional<ReplacementOptions> replacement;  ///< none: nothing is replaced
  static constexpr auto fields() {
    using O = ReconfigurationOptions;
    return std::tuple{
        OptionalField{"reach_m", &O::reach_m, 0.0, 1e6,
                      "Tiles farther than this from what an operation moves stay where they are."},
        EnumField{"pasted",
                  &O::pasted,
                  {EnumName<PastedTiles>{"held", PastedTiles::kHeld},
                   EnumName<PastedTiles>{"free", PastedTiles::kFree}},
                  "Whether pasted tiles keep their shape while others make room."}};
  }
};

/// What an operation did.
struct ReconfigurationReport {
  std::vector<TileId> moved;     ///< whose placement changed
  std::vector<TileId> appeared;  ///< pasted and replacing tiles
  std::vector<TileId> vanished;  ///< cut and replaced tiles
  std::size_t replacements = 0;
  std::size_t replacements_refused = 0;  ///< the total error did not fall, or others overlapped
  std::size_t replacements_without_place = 0;  ///< could not be laid there, or not be solved
  std::size_t rounds = 0;                      ///< of solving
  std::size_t stiffened = 0;                   ///< tiles that weigh more so that none overlap
  double mean_property_gap_m = 0.0;            ///< before gaps are closed
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
  /// Edges, by their two vertices in the order of their tile's ring, beyond which a tile lay that
  /// is not of the group; sorted. The other edges of the outline face streets.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> property_edges;
};

/// The zone of land that tiles were cut from.
inline constexpr std::string_view kVacantZone = "vacant";

/// What becomes of land that tiles leave.
enum class VacatedLand {
  kVacant,  ///< a tile without zone stays in the place
  kClosed,  ///< the neighbours draw together over it
};

/// All operations: a failure changes nothing; kUnknownEntity for an id that no tile has, or where
/// none is named; kTilesOverlap where tiles would overlap or be turned inside out; kOutOfRange for
/// a map that is not finite or mirrors. The result is a layout with all its invariants; tiles of a
/// block are a coverage. Same input, same bytes.

/// Moves tiles by a map of the plane (a translation, a rotation) and pins them there; the others
/// make room. The identity pins them where they are, and solves nothing.
Expected<Reconfiguration> move_tiles(const TileLayout& layout, std::span<const TileId> tiles,
                                     const Affine& motion, const ReconfigurationOptions& options);

/// Solves again with the pins as they are.
Expected<Reconfiguration> relax(const TileLayout& layout, const ReconfigurationOptions& options);

/// Lets pinned tiles go; nothing moves before the next operation.
Expected<TileLayout> unpin_tiles(const TileLayout& layout, std::span<const TileId> tiles);

/// Tiles with what they share among themselves, as they are; pins are not copied.
Expected<TileGroup> copy_tiles(const TileLayout& layout, std::span<const TileId> tiles);

/// Takes tiles away. Vacated land is a tile of zone kVacantZone without source; closed land draws
/// its neighbours together, whose vertices are merged pairwise. Fails with kNoPlace where no two
/// sides of a tile can be laid on each other.
Expected<Reconfiguration> cut_tiles(const TileLayout& layout, std::span<const TileId> tiles,
                                    VacatedLand land, const ReconfigurationOptions& options);

/// Puts a group down where `to` carries it: it takes the place of the most similar tile or union of
/// tiles there, in the position and orientation that match it best, and inherits what they were
/// joined to. Pinned tiles are not replaced. Fails with kNoPlace where less than half of it would
/// lie on others.
Expected<Reconfiguration> paste_tiles(const TileLayout& layout, const TileGroup& group,
                                      const Affine& to, const ReconfigurationOptions& options);

/// Replaces tiles over the thresholds, in rounds, until none is left or none helps: one for one,
/// one for two neighbours, or, where `unions` says so, two adjacent ones for one.
Expected<Reconfiguration> replace_deformed_tiles(const TileLayout& layout,
                                                 const ReplacementOptions& replacement,
                                                 const ReconfigurationOptions& options);

}  // namespace plat::tiles
