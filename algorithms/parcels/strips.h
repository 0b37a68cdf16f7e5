#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "blocks/block.h"
#include "parcels/straight_skeleton.h"

namespace plat::parcels {

/// Which strip a corner region goes to [VKW12, Sec. 4.2.2].
enum class CornerScheme {
  kStreetWidth,   ///< to the strip on the wider street
  kStreetLength,  ///< to the strip with the longer front
};

/// How a block's strips are laid out.
struct StripRules {
  CornerScheme corners = CornerScheme::kStreetWidth;
  std::optional<double> offset_m =
      std::nullopt;                ///< d_offset: how deep strips are at most; absent: no patio
  double min_patio_width_m = 0.0;  ///< a patio narrower than this is not made
};

/// Supporting edges psi(s): consecutive contour edges on one logical street, counter-clockwise
/// along a ring.
struct Strip {
  std::vector<std::uint32_t> edges;  ///< contour edges, numbered as in StraightSkeleton
  double trimmed_start_m = 0.0;  ///< length at the start of psi whose land a neighbour strip took
  double trimmed_end_m = 0.0;
  bool is_closed = false;  ///< psi is a whole ring
};

/// A block's strips and the walls between them.
///
/// Alpha-strips are the skeleton faces joined by logical street; corner regions are then handed
/// over, which gives the beta-strips [VKW12, Sec. 4.2.1-2, fig. 4]. Faces of edges that front no
/// street go to the street strip with which they share the longest boundary, so that all land but
/// the patios has access.
struct StripLayout {
  Polygon contour;  ///< the one the skeleton belongs to
  double slack_m =
      0.0;  ///< how far the block's own contour may be off: cuts are prolonged by this to reach it
  std::vector<blocks::BlockEdge> labels;  ///< per contour edge
  StraightSkeleton skeleton;              ///< below the offset; its nodes on the working grid
  std::vector<Strip> strips;
  /// Per contour edge; kNoStrip where its face lies in a patio, out of reach of any street.
  std::vector<std::uint32_t> strip_of_edge;
  static constexpr std::uint32_t kNoStrip = 0xffffffffU;
  std::vector<Segment> walls;      ///< boundaries between beta-strips, and the rim
  std::vector<Segment> rim;        ///< the offset contour C'(B) [VKW12, fig. 3]
  std::vector<bool> is_wall_node;  ///< per skeleton node: a wall meets it
  /// Per arc: whether a slice that meets it follows it, as it lies inside one strip (fig. 5b), or
  /// ignores it, as it lies in a region that changed hands or was absorbed.
  enum class ArcRole : std::uint8_t { kWall, kGuide, kIgnored };
  std::vector<ArcRole> roles;
};

/// Lays out the strips of a contour that is at most `slack_m` off the block's own.
/// @returns the skeleton's Failure, or kNoStreet if no edge fronts a street.
Expected<StripLayout> lay_out_strips(Polygon contour, std::vector<blocks::BlockEdge> labels,
                                     double slack_m, const StripRules& rules);

/// The segment of contour edge `edge`.
Segment contour_segment(const StripLayout& layout, std::uint32_t edge);

/// Length of psi, metres.
double front_length_m(const StripLayout& layout, const Strip& strip);

}  // namespace plat::parcels
