#include "parcel_scaling/tiled_city.h"

#include <cmath>

namespace plat::scaling {
namespace {

/// Copies lie this far apart.
constexpr double kGap_m = 50.0;
/// Copies in a row: a square of them for a million parcels of a city of ten thousand.
constexpr std::size_t kCopiesInARow = 10;

}  // namespace

TiledCity::TiledCity(harness::City city) : city_(std::move(city)) {
  Box box;
  for (const harness::ObservedBlock& observed : city_.blocks) {
    box.add(box_of(observed.block.contour));
    styles_.push_back(parcels::style_of(observed.block, observed.parcels));
  }
  step_ = {std::ceil(box.width() + kGap_m), std::ceil(box.height() + kGap_m)};
}

std::vector<blocks::Block> TiledCity::blocks(std::size_t count) const {
  std::vector<blocks::Block> out;
  out.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t copy = i / city_.blocks.size();
    const Point shift{step_.x * static_cast<double>(copy % kCopiesInARow),
                      step_.y * static_cast<double>(copy / kCopiesInARow)};
    blocks::Block block = city_.blocks[i % city_.blocks.size()].block;
    block.id = BlockId{static_cast<std::uint32_t>(i)};
    for (Point& p : block.contour.outer) p = p + shift;
    for (Ring& hole : block.contour.holes) {
      for (Point& p : hole) p = p + shift;
    }
    out.push_back(std::move(block));
  }
  return out;
}

}  // namespace plat::scaling
