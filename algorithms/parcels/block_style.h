#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "parcels/parcel_style.h"

namespace plat::parcels {

/// A strategy with the options that `hybrid` runs it with; the name is the strategy's.
enum class BlockStyle : std::uint8_t { kSkeleton, kObb, kMinBox, kRecursive, kVoronoi };

/// A number that tells styles apart.
struct StyleFeature {
  std::string_view name;  ///< as in experiments/block_style
  double (*value)(const ParcelStyle&);
};

/// A node of the decision tree; a leaf has no feature.
struct StyleNode {
  std::optional<StyleFeature> feature;
  double threshold = 0.0;
  std::size_t below = 0;  ///< the node to go on with where the feature is below the threshold
  std::size_t above = 0;  ///< the node to go on with elsewhere
  BlockStyle style{};     ///< of a leaf: the answer
  int blocks = 0;         ///< observed blocks that the node was fitted to
};

/// The tree, root first. Its numbers are what experiments/block_style fitted to 917 blocks of
/// Cambridge, San Roman and Prague; the file tree.csv there holds the same, and a test compares.
std::span<const StyleNode> block_style_tree();

/// Which strategy reproduces a block best, going by what its observed parcels look like.
/// Paper: left to the user, and named as future work [VKW12, Sec. 6 and 7].
/// Deviation: right for one block in three, in an unseen city one in four (ADR 0015).
BlockStyle block_style_of(const ParcelStyle& style);

}  // namespace plat::parcels
