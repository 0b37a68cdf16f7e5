#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/ids.h"
#include "core/polygon.h"

namespace plat::streets {

/// Where the width of a street comes from.
enum class WidthSource {
  kNone,       ///< there is no street
  kAttribute,  ///< a width field of the street
  kLanes,      ///< number of lanes times a lane width, and pavements
  kGap,        ///< measured: distance between the parcels or blocks on both sides
  kClass,      ///< table by street class
  kAssumed,    ///< none of these: a default
  kExample,    ///< grown (street_grower.h): that of the example
};
std::string_view width_source_name(WidthSource source);

/// Whether a street lies on the ground: only there does it meet what it crosses.
enum class Structure { kGround, kBridge, kTunnel };
std::string_view structure_name(Structure structure);

/// What a source says about a street; two streets with equal attributes may be joined into one.
struct StreetAttributes {
  std::string name;
  std::string street_class;             ///< as in the source, e.g. "residential"
  std::optional<double> lanes;          ///< in both directions together
  std::optional<double> given_width_m;  ///< the source's own width field
  int level = 0;                        ///< 0 on the ground, above it positive, below it negative
  Structure structure = Structure::kGround;

  friend bool operator==(const StreetAttributes&, const StreetAttributes&) = default;
};

/// A street between two nodes.
struct Street {
  StreetId id;  ///< its index in the network
  std::uint32_t from = 0;
  std::uint32_t to = 0;
  Polyline line;  ///< on the working grid, from node to node
  StreetAttributes attributes;
  double width_m = 0.0;  ///< full width; 0 until assign_widths() (street_width.h)
  WidthSource width_source = WidthSource::kNone;
  std::string source_id;  ///< feature it came from; the first where several were joined
};

/// Streets that meet at nodes only. Streets of different levels may cross without a node.
struct StreetNetwork {
  std::vector<Point> nodes;  ///< sorted, on the working grid
  std::vector<Street> streets;
};

/// How many street ends meet at each node.
std::vector<std::uint32_t> node_degrees(const StreetNetwork& network);

}  // namespace plat::streets
