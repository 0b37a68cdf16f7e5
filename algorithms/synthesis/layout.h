#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "blocks/block.h"
#include "blocks/dual_graph.h"
#include "core/failure.h"
#include "core/options.h"
#include "core/polygon.h"
#include "parcels/parcel.h"
#include "parcels/parcel_style.h"
#include "streets/intersection_point.h"
#include "streets/street_grower.h"
#include "streets/street_network.h"

namespace plat::synthesis {

/// What a layout is synthesized from.
struct LayoutSite {
  streets::GrowthSite growth;
  /// What is known at the nodes of growth.existing. Nothing is grown to these points; their parcel
  /// areas count for the blocks around them. May be empty.
  std::vector<streets::IntersectionPoint> existing_points;
  /// Level and street of each of growth.existing's streets; empty where nothing is known.
  std::vector<streets::GrownSegment> existing_segments;
};

/// Where the style of a block's parcels comes from.
enum class StyleSource {
  kPoints,  ///< the points at the nodes of the streets around it
  kLayout,  ///< these know no parcels: the mean over all places of the layout that do
  kNone,    ///< no place of the layout knows parcels: the subdivider's options as they were given
};
std::string_view style_source_name(StyleSource source);

/// A block of the layout with its parcels.
struct LayoutBlock {
  blocks::Block block;         ///< its edges name streets of the layout's network
  bool is_existing = false;    ///< faces streets that were there before, and no grown one
  parcels::ParcelStyle style;  ///< wanted; its count is n_b; no parcels where the source is kNone
  StyleSource style_source = StyleSource::kNone;
  std::string strategy;    ///< that divided it
  OptionMap options;       ///< as they ran, fitted ones included
  std::uint64_t seed = 0;  ///< of the block's stream
  Expected<std::vector<parcels::Parcel>> parcels = std::vector<parcels::Parcel>{};
};

/// The stages of a synthesis, in their order [AVB08, Fig. 3].
enum class SynthesisStage { kStreets, kBlocks, kParcels };
inline constexpr SynthesisStage kSynthesisStages[] = {
    SynthesisStage::kStreets, SynthesisStage::kBlocks, SynthesisStage::kParcels};
std::string_view stage_name(SynthesisStage stage);

/// A part of the layout that could not be made.
struct LayoutFailure {
  SynthesisStage stage{};
  std::string feature;  ///< "block 12", or "face at street 7" of one that gave no block
  Failure failure;
  Polygon shape;
  Point place;  ///< inside the shape, or the mean of its vertices where it has no inside
};

/// L = (S, B): streets, blocks and their parcels. Paper: [AVB08, Sec. 3]
struct Layout {
  std::vector<streets::IntersectionPoint> points;  ///< V of S, as given
  streets::StreetNetwork network;  ///< existing streets first, every one with a width
  std::size_t existing_count = 0;  ///< streets that were there before
  /// One per street of `network`; nullopt for an existing one of which nothing is known. No grown
  /// street has the number of an existing one.
  std::vector<std::optional<streets::GrownSegment>> segments;
  std::vector<std::uint32_t> left_alone;  ///< points that no grown street reached, ascending
  std::vector<LayoutBlock> blocks;        ///< ids are 0 .. n-1
  std::vector<blocks::DualEdge> dual;     ///< E^B: blocks that face each other across a street
  std::vector<LayoutFailure> failures;    ///< of the blocks, then of the parcels
};

/// Sum over the blocks.
std::size_t parcel_count(const Layout& layout);

}  // namespace plat::synthesis
