#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "core/rng.h"
#include "core/working_grid.h"
#include "tiles/layout_construction.h"

namespace plat::testing {

/// A grid city of tiles: blocks of two rows of parcels, streets between, some rows divided
/// differently from those behind them, so that corners meet edges.
struct MadeLayout {
  int blocks_x = 3;
  int blocks_y = 3;
  int parcels_south = 4;
  int parcels_north = 5;
  double block_m = 80.0;
  double depth_m = 30.0;
  double street_m = 12.0;
  double jitter_m = 2.0;  ///< every corner is moved by up to this, each way
  Affine turn{};          ///< carries the whole city
  std::uint64_t seed = 1;
};

namespace detail {

/// The three lines of a block: south front, middle, north front. The middle has the corners of both
/// rows.
class MadeBlock {
 public:
  MadeBlock(const MadeLayout& made, Rng& rng, Point origin) : made_(made) {
    const auto jittered = [&](Point p) {
      return p + Point{rng.uniform(-made.jitter_m, made.jitter_m),
                       rng.uniform(-made.jitter_m, made.jitter_m)};
    };
    const auto line = [&](int parcels, double y) {
      Ring out;
      for (int i = 0; i <= parcels; ++i)
        out.push_back(jittered(origin + Point{made.block_m * i / parcels, y}));
      return out;
    };
    south_ = line(made.parcels_south, 0.0);
    north_ = line(made.parcels_north, 2.0 * made.depth_m);
    west_ = jittered(origin + Point{0.0, made.depth_m});
    east_ = jittered(origin + Point{made.block_m, made.depth_m});
  }

  void add_to(std::vector<tiles::TilePiece>& pieces, std::uint32_t block) const {
    row(south_, false, pieces, block);
    row(north_, true, pieces, block);
  }

 private:
  [[nodiscard]] Point middle(int i, int of) const {
    return lerp(west_, east_, static_cast<double>(i) / of);
  }
  void row(const Ring& front, bool is_north, std::vector<tiles::TilePiece>& pieces,
           std::uint32_t block) const {
    const int n = static_cast<int>(front.size()) - 1;
    for (int i = 0; i < n; ++i) {
      const auto k = static_cast<std::size_t>(i);
      Ring ring{front[k], front[k + 1], middle(i + 1, n), middle(i, n)};
      if (is_north) ring = {middle(i, n), middle(i + 1, n), front[k + 1], front[k]};
      for (Point& p : ring) p = snap(made_.turn(p));
      const char* zones[] = {"residential", "commercial", "park"};
      pieces.push_back({"piece " + std::to_string(pieces.size()),
                        zones[(block + k) % 3],
                        block,
                        {std::move(ring), {}}});
    }
  }

  MadeLayout made_;
  Ring south_;
  Ring north_;
  Point west_;
  Point east_;
};

}  // namespace detail

inline tiles::TileLayout made_layout(const MadeLayout& made) {
  Rng rng(made.seed);
  std::vector<tiles::TilePiece> pieces;
  for (int y = 0; y < made.blocks_y; ++y) {
    for (int x = 0; x < made.blocks_x; ++x) {
      const Point origin{x * (made.block_m + made.street_m),
                         y * (2.0 * made.depth_m + made.street_m)};
      detail::MadeBlock(made, rng, origin)
          .add_to(pieces, static_cast<std::uint32_t>(y * made.blocks_x + x));
    }
  }
  return tiles::construct_layout(pieces).layout;
}

}  // namespace plat::testing
