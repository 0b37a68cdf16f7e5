#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/affine.h"
#include "core/ids.h"
#include "core/polygon.h"
#include "similarity/labelled_shape.h"

namespace plat::tiles {

using TileId = Id<struct TileTag>;

/// A vertex of a tile's ring: which vertex of the layout it is, and where the tile has it at rest.
struct Corner {
  std::uint32_t vertex = 0;
  Point rest;

  friend bool operator==(const Corner&, const Corner&) = default;
};

/// A piece of land that is moved as a whole: a parcel, or a block where blocks are not divided
/// [ABVA08, Sec. 3].
struct Tile {
  TileId id;                ///< kept by every operation; a copy gets a new one
  std::string source_id;    ///< in the layer it came from
  std::string zone;         ///< zone or land use; empty where unknown
  std::uint32_t block = 0;  ///< tiles of one block have no street between them
  /// Outer ring counter-clockwise, then holes. Rest positions are those of the observed city: what
  /// imagery is taken from, and what deformation is measured against. A copy keeps its source's.
  std::vector<std::vector<Corner>> rings;
  Affine placement;        ///< from rest to where the tile is now
  bool is_pinned = false;  ///< operations leave it where it is

  friend bool operator==(const Tile&, const Tile&) = default;
};

/// A point that tiles of one block share, or that is one tile's alone.
struct LayoutVertex {
  Point at;  ///< where it is now: the mean of where its tiles would have it; on the working grid
  /// Whether it constrains its tiles. The one-time simplification keeps joints only: of near
  /// vertices one, of collinear vertices none [ABVA08, Sec. 6].
  bool is_joint = false;

  friend bool operator==(const LayoutVertex&, const LayoutVertex&) = default;
};

/// Two tiles on the two sides of a street, by a point on its centre line that belongs to both: each
/// tile reaches half across. At rest the two points are the same.
struct StreetLink {
  std::uint32_t a = 0;  ///< index of a tile
  Point rest_a;         ///< the point in the rest frame of `a`
  std::uint32_t b = 0;
  Point rest_b;
  double width_m = 0.0;  ///< between the fronts, at rest

  friend bool operator==(const StreetLink&, const StreetLink&) = default;
};

/// The tiles of a city, and what holds them together: vertices within a block, links across
/// streets.
///
/// Invariants: 1. every corner names a vertex; tiles that share a vertex are of one block;  2.
/// tiles of a block that touch have the same vertices, in reverse order, along their common
/// boundary, so that they stay a coverage wherever the vertices go;  3. ids are unique and below
/// `next_id`;
/// 4. everything is finite.
/// Deviation: the paper's tiles reach the centre line and share points there; here they end at the
///            street, and links hold the points.
struct TileLayout {
  std::vector<Tile> tiles;
  std::vector<LayoutVertex> vertices;
  std::vector<StreetLink> links;
  std::uint32_t next_id = 0;

  friend bool operator==(const TileLayout&, const TileLayout&) = default;
};

/// Where the tile is now.
Polygon shape_of(const TileLayout& layout, const Tile& tile);
/// Where it was observed.
Polygon rest_shape_of(const Tile& tile);
/// The tile as it is now, its edges labelled: property where another tile has the edge too.
similarity::LabelledShape labelled_shape_of(const TileLayout& layout, std::uint32_t tile);
/// The index of a tile; nullopt where there is none with this id.
std::optional<std::uint32_t> find_tile(const TileLayout& layout, TileId id);

}  // namespace plat::tiles
