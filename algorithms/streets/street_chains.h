#pragma once

#include <cstdint>
#include <numbers>
#include <tuple>
#include <vector>

#include "core/options.h"
#include "streets/street_network.h"

namespace plat::streets {

/// A street as a person would name it: pieces of the network that follow one another.
struct StreetChain {
  struct Piece {
    std::uint32_t street = 0;  ///< index in the network
    bool is_reversed = false;  ///< walked from `to` to `from`
  };
  std::vector<Piece> pieces;
  std::vector<std::uint32_t> nodes;  ///< one more than pieces; first == last where it is closed
  bool is_closed = false;  ///< goes on from its last piece to its first, and so has no ends
  int hierarchy = 0;       ///< 0 until assign_hierarchy() (street_hierarchy.h)
};

/// What makes two pieces that meet at a node one street.
enum class Continuity {
  kName,             ///< equal names; where one has none, direction
  kDirection,        ///< the straightest pairs of each node, whatever their names
  kNameOrDirection,  ///< equal names first, then direction among those that are left
};

struct ChainOptions {
  Continuity continuity = Continuity::kNameOrDirection;
  double max_turn_rad = std::numbers::pi / 4;  ///< a street joined by direction turns no more
  static constexpr auto fields() {
    return std::tuple{EnumField{"continuity",
                                &ChainOptions::continuity,
                                {EnumName{"name", Continuity::kName},
                                 EnumName{"direction", Continuity::kDirection},
                                 EnumName{"name_or_direction", Continuity::kNameOrDirection}},
                                "What makes two pieces that meet at a node one street."},
                      Field{"max_turn_rad", &ChainOptions::max_turn_rad, 0.0, std::numbers::pi,
                            "A street does not turn more than this at a node, unless its name "
                            "goes on."}};
  }
};

/// Joins the pieces of a network to streets: at every node the straightest pair first, then the
/// straightest of those that are left. An equal name goes on through any turn but one that goes
/// back; a ring that nothing else meets is closed whatever its shape.
///
/// Guarantees: 1. every street of the network is in exactly one chain, once;  2. the chains, their
/// order and their sense do not depend on the order or the sense of the network's streets;  3. they
/// are in the order of their lines, each walked in the sense that comes first.
/// A chain may pass a node several times: a loop that ends where it began, a street that crosses
/// itself.
/// Complexity: O(n log n), and the squares of the nodes' degrees.
/// Paper: [AVB08, Sec. 5] takes each poly-line of the source as a street. Deviation: sources cut
/// them at crossings, so they are put together (ADR 0026).
std::vector<StreetChain> chains_of(const StreetNetwork& network, const ChainOptions& options = {});

/// The line of a chain from its first node to its last.
Polyline line_of(const StreetNetwork& network, const StreetChain& chain);

/// Length of a piece, summed in the sense of the chain: the same bits whichever way the street's
/// line is stored.
double length_m(const StreetNetwork& network, StreetChain::Piece piece);
double length_m(const StreetNetwork& network, const StreetChain& chain);
/// Mean by length of the pieces' widths.
double width_m(const StreetNetwork& network, const StreetChain& chain);

/// The unit vector in which a street leaves its node `from` (or, where `is_reversed`, `to`),
/// measured far enough off not to see rounded corners.
Point heading_of(const Street& street, bool is_reversed);

}  // namespace plat::streets
