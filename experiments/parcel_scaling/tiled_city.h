#pragma once

#include <cstddef>
#include <vector>

#include "harness/city.h"
#include "parcels/parcel_style.h"

namespace plat::scaling {

/// A city laid out again and again beside itself, as far as blocks are asked for: as large as one
/// likes, and no real place.
class TiledCity {
 public:
  explicit TiledCity(harness::City city);

  [[nodiscard]] const geodata::LocalFrame& frame() const { return city_.frame; }
  [[nodiscard]] std::size_t blocks_per_copy() const { return city_.blocks.size(); }
  /// The observed parcels' style that block `i`, of any copy, is fitted to.
  [[nodiscard]] const parcels::ParcelStyle& style(std::size_t i) const {
    return styles_[i % styles_.size()];
  }
  /// The first `count` blocks, copy after copy; ids are 0 .. count-1.
  [[nodiscard]] std::vector<blocks::Block> blocks(std::size_t count) const;

 private:
  harness::City city_;
  std::vector<parcels::ParcelStyle> styles_;
  Point step_;  ///< from one copy to the next, whole metres: copies stay on the working grid
};

}  // namespace plat::scaling
