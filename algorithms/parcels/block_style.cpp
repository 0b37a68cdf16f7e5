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
constexpr StyleFeature kAspectRatio{"aspect_ratio_mean",
                                    [](const ParcelStyle& s) { return s.aspect_ratio_mean; }};

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
    split(kCount, 3.5, 1, 8, kMinBox, 917),                   // 0
    split(kAspectRatio, 1.647, 2, 5, kVoronoi, 152),          // 1
    split(kWidthVariation, 0.02862, 3, 4, kMinBox, 79),       // 2
    leaf(kVoronoi, 51),                                       // 3
    leaf(kMinBox, 28),                                        // 4
    split(kWidthVariation, 0.02237, 6, 7, kVoronoi, 73),      // 5
    leaf(kRecursive, 39),                                     // 6
    leaf(kVoronoi, 34),                                       // 7
    split(kWidthVariation, 0.733, 9, 12, kMinBox, 765),       // 8
    split(kWidthVariation, 0.2748, 10, 11, kRecursive, 655),  // 9
    leaf(kMinBox, 176),                                       // 10
    leaf(kRecursive, 479),                                    // 11
    split(kAreaVariation, 1.854, 13, 14, kMinBox, 110),       // 12
    leaf(kMinBox, 60),                                        // 13
    leaf(kSkeleton, 50),                                      // 14
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
