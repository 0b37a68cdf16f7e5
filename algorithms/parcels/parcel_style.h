#pragma once

#include <span>

#include "blocks/block.h"
#include "core/polygon.h"

namespace plat::parcels {

/// What the observed parcels of one block look like: the attributes that [VKW12, Sec. 6 (ii)]
/// extracts per block, then what tells styles of subdivision apart. Deviations are those
/// of the sample (n - 1), 0 for a single parcel.
struct ParcelStyle {
  std::size_t count = 0;
  double area_mean_m2 = 0.0;
  double area_deviation_m2 = 0.0;
  double width_mean_m = 0.0;  ///< of the shorter side of each parcel's oriented bounding box
  double width_deviation_m = 0.0;
  double aspect_ratio_mean = 1.0;  ///< longer by shorter side of that box
  double access_share_01 = 0.0;    ///< parcels with street access
  double access_area_01 = 0.0;     ///< their share of the area: small where a patio is inside
  double rows_mean = 0.0;          ///< parcels from the street to a parcel, both ends counted
                                   ///< (parcel_rows); 0 where no street is
};

/// Pre: every polygon has an area.
ParcelStyle style_of(const blocks::Block& block, std::span<const Polygon> parcels);

/// The fitted upper bound of area in a block that was observed as one parcel: none.
inline constexpr double kUndivided_m2 = 1e12;

/// mean +- max(k deviations, 10 % of the mean), the lower end kept above `floor` [VKW12, Sec. 6].
/// Deviation: the paper's A_min = mean - k s turns negative where the deviation is large, and its
/// bounds are a single number where all parcels are equal, which no subdivision can hit (ADR 0004).
struct Bounds {
  double low = 0.0;
  double high = 0.0;
};
Bounds bounds_around(double mean, double deviation, double k, double floor);

/// The observed lot as a rectangle: of the mean width, and as deep as the mean area makes it. In a
/// block that was observed as one parcel, larger than any block.
struct LotSize {
  double width_m = 0.0;
  double depth_m = 0.0;
};
LotSize mean_lot(const ParcelStyle& style);

}  // namespace plat::parcels
