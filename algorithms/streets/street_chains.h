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
  bool is_closed = false;
  int hierarchy = 0;  ///< 0 until assign_hierarchy()
};

/// What makes two pieces that meet at a node one street.
enum class Continuity {
  kName,             ///< equal names; where one has none, direction
  kDirection,        ///< the straightest pairs of each node, whatever their names
  kNameOrDirection,  ///< equal names first, then direction among those that are left
};

struct ChainOptions {
  Continuity continuity = Continuity::kNameOrDirection;
  double max_turn_rad = std::numbers::pi / 4;  ///< a street does not turn more at a node
  static constexpr auto fields() {
    return std::tuple{EnumField{"continuity",
                                &ChainOptions::continuity,
                                {EnumName{"name", Continuity::kName},
                                 EnumName{"direction", Continuity::kDirection},
                                 EnumName{"name_or_direction", Continuity::kNameOrDirection}},
                                "What makes two pieces that meet at a node one street."},
                      Field{"max_turn_rad", &ChainOptions::max_turn_rad, 0.0, std::numbers::pi,
                            "A street does not turn more than this at a node."}};
  }
};

/// Every street of the network in exactly one chain.
std::vector<StreetChain> chains_of(const StreetNetwork& network, const ChainOptions& options = {});

/// What makes a street important.
enum class Importance { kLength, kWidth, kLengthTimesWidth };

struct HierarchyOptions {
  double main_share_01 = 0.03;  ///< of the chains, at least one, become level 0
  Importance importance = Importance::kLengthTimesWidth;
  static constexpr auto fields() {
    return std::tuple{
        Field{"main_share_01", &HierarchyOptions::main_share_01, 0.0, 1.0,
              "Share of the streets, the longest and widest, that become level 0; at least one."},
        EnumField{"importance",
                  &HierarchyOptions::importance,
                  {EnumName{"length", Importance::kLength}, EnumName{"width", Importance::kWidth},
                   EnumName{"length_times_width", Importance::kLengthTimesWidth}},
                  "What makes a street one of the longest and widest."}};
  }
};

/// Gives every chain its level: the most important are 0; those that meet one of level h and have
/// none yet are h + 1. In a part of the network that no chain of level 0 reaches, the most
/// important one is 0.
/// Paper: [AVB08, Sec. 5]
void assign_hierarchy(const StreetNetwork& network, std::vector<StreetChain>& chains,
                      const HierarchyOptions& options = {});

}  // namespace plat::streets
