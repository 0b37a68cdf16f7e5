#pragma once

#include <span>
#include <tuple>
#include <vector>

#include "core/options.h"
#include "core/polygon.h"
#include "tiles/tile_layout.h"

namespace plat::tiles {

/// The centre line of a street.
struct StreetLine {
  Polyline line;
  double width_m = 0.0;
};

struct LinkOptions {
  double reach_m = 60.0;    ///< fronts farther apart than this have no street between them
  double front_m = 3.0;     ///< shorter fronts have no link of their own
  double spacing_m = 40.0;  ///< a longer front has links between its ends, too

  static constexpr auto fields() {
    using O = LinkOptions;
    return std::tuple{
        Field{"reach_m", &O::reach_m, 1.0, 500.0,
              "Fronts farther apart than this, metres, have no street between them."},
        Field{"front_m", &O::front_m, 0.1, 100.0, "Shorter fronts have no link, metres."},
        Field{"spacing_m", &O::spacing_m, 1.0, 1000.0,
              "Distance of links along a long front, metres."}};
  }
};

/// Finds what lies across the street from each front: from points near both ends of a front, and
/// every `spacing_m` between them, straight across to the first tile in sight. The link's point is
/// where a centre line crosses the way, or half way where none does.
///
/// Guarantees: 1. no tile lies on the way of a link;  2. no link is wider than `reach_m`;  3. tiles
/// that share vertices have no link;  4. a link is found once, whichever side it is seen from;  5.
/// links are sorted by their tiles.
/// Complexity: O(n log n) for streets of bounded width.
/// Paper: [ABVA08, Sec. 4.1], the common boundary across a street (ADR 0037).
std::vector<StreetLink> find_street_links(const TileLayout& layout,
                                          std::span<const StreetLine> streets,
                                          const LinkOptions& options = {});

}  // namespace plat::tiles
