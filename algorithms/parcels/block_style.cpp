#include "parcels/block_style.h"

#include <array>

namespace plat::parcels {
namespace {

double variation(double deviation, double mean) { return mean > 0.0 ? deviation / mean : 0.0; }

constexpr StyleFeature kCount{"count",
                              [](const ParcelStyle& s) { return static_cast<double>(s.count); }};
constexpr StyleFeature kAreaVariation{"area_variation", [](const ParcelStyle& s) {
                                        return variation(s.area_deviation_m2, s.area_mean_m2);
                                      }};
constexpr StyleFeature kWidthVariation{"width_variation", [](const ParcelStyle& s) {
                                         return variation(s.width_deviation_m, s.width_mean_m);
                                       }};
constexpr StyleFeature kAccessArea{"access_area_01",
                                   [](const ParcelStyle& s) { return s.access_area_01; }};

constexpr StyleNode leaf(BlockStyle style, int blocks) {
  return {std::nullopt, 0.0, 0, 0, style, blocks};
}
constexpr StyleNode split(const StyleFeature& feature, double threshold, std::size_t below,
                          std::size_t above, BlockStyle style, int blocks) {
  return {feature, threshold, below, above, style, blocks};
}

using enum BlockStyle;

/// experiments/block_style, seed 1, depth 3, at least 20 blocks a leaf. Splits carry the best
/// single answer, too.
constexpr std::array kTree{
    split(kAreaVariation, 1.521, 1, 8, kMinBox, 917),      // 0
    split(kWidthVariation, 0.2748, 2, 5, kMinBox, 827),    // 1
    split(kCount, 6.5, 3, 4, kMinBox, 291),                // 2
    leaf(kVoronoi, 147),                                   // 3
    leaf(kMinBox, 144),                                    // 4
    split(kWidthVariation, 0.733, 6, 7, kRecursive, 536),  // 5
    leaf(kRecursive, 492),                                 // 6
    leaf(kMinBox, 44),                                     // 7
    split(kAccessArea, 0.9504, 9, 10, kSkeleton, 90),      // 8
    leaf(kMinBox, 21),                                     // 9
    leaf(kSkeleton, 69),                                   // 10
};

}  // namespace

std::span<const StyleNode> block_style_tree() { return kTree; }

BlockStyle block_style_of(const ParcelStyle& style) {
  std::size_t i = 0;
  while (kTree[i].feature)
    i = kTree[i].feature->value(style) < kTree[i].threshold ? kTree[i].below : kTree[i].above;
  return kTree[i].style;
}

}  // namespace plat::parcels
