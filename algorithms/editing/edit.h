#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "editing/city.h"
#include "tiles/reconfiguration.h"

/// The edits of a city. Distances in metres, angles in radians; points are rounded to the working
/// grid. docs/edit_script.md has an example of each.
namespace plat::editing {

/// Moves a node; control points of curves near it move along. With `snap_m`, a node that comes
/// nearer than this to another node or street is joined to it, so that a loose end can close a
/// block.
struct MoveNode {
  NodeId node;
  Point to;
  double snap_m = 0.0;
};

/// Moves both ends of a street.
struct MoveStreet {
  StreetId street;
  Point by;
};

/// Bends a street into a curve, or makes it straight again.
struct BendStreet {
  StreetId street;
  std::optional<Curve> curve;
};

/// Adds a street. An end nearer than `snap_m` to a node starts there; else, nearer to a street,
/// splits it. Where the new street crosses others a node is made, or the nearest within `snap_m`
/// taken.
struct AddStreet {
  Point from;
  Point to;
  double width_m = 12.0;
  std::string name{};
  std::string street_class = "residential";
  double snap_m = 1.0;
};

/// Removes a street, and nodes at which nothing is left.
struct RemoveStreet {
  StreetId street;
};

struct SetStreetWidth {
  StreetId street;
  double width_m = 12.0;
};

/// Sets how blocks are divided; all blocks where none is named.
struct SetBlockStyle {
  std::vector<BlockId> blocks;
  Style style;
};

/// Scales uniformly about `center`; all nodes where none is named.
struct ScaleNodes {
  std::vector<NodeId> nodes;
  Point center;
  double factor = 1.0;
};

/// Rotates counter-clockwise about `center`; all nodes where none is named.
struct RotateNodes {
  std::vector<NodeId> nodes;
  Point center;
  double angle_rad = 0.0;
};

/// Attaches a text to a parcel, or takes it away.
struct SetParcelAttribute {
  ParcelId parcel;
  std::string key;
  std::optional<std::string> value;
};

// Edits of tiles, in a city that has them [ABVA08, Sec. 4]. Streets beside tiles go along
// (street_following.h).

/// Moves tiles by a map of the plane and pins them there; the others make room.
struct MoveTiles {
  std::vector<tiles::TileId> tiles;
  Affine motion;
  tiles::ReconfigurationOptions options;
};

/// Puts a group of tiles down where `to` carries it.
struct PasteTiles {
  std::shared_ptr<const tiles::TileGroup> group;
  Affine to;
  tiles::ReconfigurationOptions options;
};

struct CutTiles {
  std::vector<tiles::TileId> tiles;
  tiles::VacatedLand land = tiles::VacatedLand::kVacant;
  tiles::ReconfigurationOptions options;
};

enum class Pinning { kPinned, kFree };

/// Says whether edits may move tiles that they do not name. Moves nothing, names one tile or more.
struct PinTiles {
  std::vector<tiles::TileId> tiles;
  Pinning pinning = Pinning::kPinned;
};

/// Replaces deformed tiles by similar ones.
struct ReplaceTiles {
  tiles::ReplacementOptions replacement;
  tiles::ReconfigurationOptions options;
};

/// Solves again with the pins as they are.
struct RelaxTiles {
  tiles::ReconfigurationOptions options;
};

using Edit = std::variant<MoveNode, MoveStreet, BendStreet, AddStreet, RemoveStreet, SetStreetWidth,
                          SetBlockStyle, ScaleNodes, RotateNodes, SetParcelAttribute, MoveTiles,
                          PasteTiles, CutTiles, PinTiles, ReplaceTiles, RelaxTiles>;

/// "move_node", "add_street", ...: as scripts name them, in the order of the variant.
std::string_view edit_name(const Edit& edit);

/// Widths that a street may have, metres: a footpath to a motorway with its verges.
inline constexpr double kMinStreetWidth_m = 0.5;
inline constexpr double kMaxStreetWidth_m = 150.0;

}  // namespace plat::editing
