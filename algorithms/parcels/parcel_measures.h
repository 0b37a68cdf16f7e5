#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "blocks/block.h"
#include "core/polygon.h"
#include "parcels/parcel.h"

namespace plat::parcels {

/// What is measured on every parcel, observed, generated or made by another program
/// (docs/measures.md defines each and says where its tolerance comes from).
struct ParcelMeasures {
  double area_m2 = 0.0;       ///< holes taken off
  double perimeter_m = 0.0;   ///< holes included
  double width_m = 0.0;       ///< shorter side of the box of least area, "minimum width" [VKW12]
  double aspect_ratio = 1.0;  ///< longer by shorter side of that box, at least 1
  int neighbours = 0;         ///< parcels of the block with a common boundary
  double frontage_m = 0.0;    ///< boundary along the street edges of the block
  bool has_street_access = false;  ///< frontage_m >= kStreetAccess_m
  double compactness = 0.0;        ///< 4 pi area / perimeter^2, 1 for a disc
  double rectangularity = 0.0;     ///< area / area of the box, at most 1
  int corners = 0;  ///< vertices of the outer ring that turn by more than kCornerTurn_deg

  friend bool operator==(const ParcelMeasures&, const ParcelMeasures&) = default;
};

/// Two parcels share a boundary where edges run against each other closer than this: cadastral
/// coordinates are quantised (0.78 x 0.57 m in Cambridge) and digitised boundaries leave gaps.
inline constexpr double kSharedGap_m = 0.3;
/// Least common boundary of neighbours: parcels that meet in a corner are not neighbours.
inline constexpr double kSharedLength_m = 0.5;
/// An edge fronts a street that is as near as this to the block's contour: contours made from
/// parcels are closed by 0.6 m and simplified by 0.1 m.
inline constexpr double kFrontageGap_m = 0.75;
/// As momepy's Corners.
inline constexpr double kCornerTurn_deg = 10.0;

/// The measures of the parcels of one block, in their order.
///
/// Guarantees: 1. the same for any order of the parcels and, up to rounding, for any position and
/// rotation;  2. parcels that share their edges exactly and parcels within the tolerances get the
/// same neighbours and access.
/// Pre: every parcel has an area; rings are oriented as in Polygon.
/// Complexity: O(n log n) plus pairs of edges that overlap in x.
std::vector<ParcelMeasures> measure_parcels(const blocks::Block& block,
                                            std::span<const Polygon> parcels);

/// The row of each parcel: 1 with street access, 2 for the neighbours of those behind, and so on; 0
/// where no street is reached over neighbours. Neighbours and access are those of measure_parcels.
std::vector<int> parcel_rows(const blocks::Block& block, std::span<const Polygon> parcels);

/// Per parcel, the parts of its boundary along street edges of the block, land on the left; their
/// lengths sum to frontage_m.
std::vector<std::vector<Segment>> street_fronts(const blocks::Block& block,
                                                std::span<const Polygon> parcels);

enum class MeasureKind : std::uint8_t {
  kContinuous,
  kInteger,
  kFlag,  ///< 0 or 1: written and mapped, but no distribution to compare
};

/// One column of parcels.csv and of parcel layers.
struct MeasureColumn {
  std::string_view name;  ///< the unit in it
  std::string_view unit;  ///< empty for a ratio or a count
  std::string_view title;
  std::string_view momepy;  ///< the name in momepy 0.6, with the relation, or "none"
  MeasureKind kind;
  double (*value)(const ParcelMeasures&);
};

/// The one list behind CSV, layers, distances and docs, in the order of the columns.
std::span<const MeasureColumn> measure_columns();

}  // namespace plat::parcels
