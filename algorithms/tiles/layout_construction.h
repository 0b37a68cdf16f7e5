#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "core/failure.h"
#include "core/options.h"
#include "core/parallel.h"
#include "core/polygon.h"
#include "tiles/street_links.h"
#include "tiles/tile_layout.h"

namespace plat::tiles {

/// A piece of land as it was observed, to become a tile.
struct TilePiece {
  std::string source_id;
  std::string zone;         ///< empty where unknown
  std::uint32_t block = 0;  ///< pieces of one block have no street between them
  Polygon shape;
};

struct ConstructionOptions {
  /// Vertices of one block are one vertex up to this; a vertex as near to an edge is put into it.
  double matching_m = 0.6;
  double near_m = 2.0;        ///< of vertices nearer than this, one is a joint
  double collinear_m = 0.25;  ///< a vertex of a common boundary as near to its chord is no joint
  LinkOptions links;

  static constexpr auto fields() {
    using O = ConstructionOptions;
    return std::tuple{
        Field{"matching_m", &O::matching_m, 0.0, 2.0,
              "Vertices of one block are one vertex up to this distance, metres; a vertex as near "
              "to an edge is put into it."},
        Field{"near_m", &O::near_m, 0.0, 20.0,
              "Of vertices nearer to each other than this, metres, one is a joint."},
        Field{"collinear_m", &O::collinear_m, 0.0, 5.0,
              "A vertex of a common boundary as near to its chord, metres, is no joint."}};
  }
};

/// A piece that did not become a tile.
struct TileFailure {
  std::string source_id;
  Failure failure;
  Polygon shape;  ///< as given; may be invalid
};

struct LayoutConstruction {
  TileLayout layout;
  std::vector<TileFailure> failures;  ///< in the order of the pieces
};

/// Makes a layout of observed pieces of land: vertices that nearly agree become one, vertices near
/// another piece's edge are put into it, small gaps and overlaps are closed half way; joints are
/// selected, links found.
///
/// Guarantees: 1. the layout has its invariants (tile_layout.h) and no defect (layout_defects.h);
/// 2. every piece is a tile or a failure row, in order;  3. the rest positions of a piece's own
/// vertices are those of the piece on the working grid; those put in lie on its edges, to a grid
/// step;  4. corners of a vertex that pieces had of their own are at most `matching_m` apart at
/// rest;  5. where pieces match exactly, tiles stand exactly as observed;  6. the result does not
/// depend on the thread count.
/// Failures (rows): those of admit_polygon() where a piece is not strictly simple; kTooSmall where
/// it is narrower than `matching_m`; kTilesOverlap where it repeats another piece or overlaps one
/// by more than matching closes.
/// Complexity: O(n log n) in the number of vertices.
/// Paper: [ABVA08, Sec. 3, 4.1 and 6].   Deviation: matching, and links that stand for the paper's
/// shared points on the centre line (ADR 0037).
LayoutConstruction construct_layout(std::span<const TilePiece> pieces,
                                    std::span<const StreetLine> streets = {},
                                    const ConstructionOptions& options = {}, Jobs jobs = {});

}  // namespace plat::tiles
