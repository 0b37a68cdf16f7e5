#pragma once

#include <optional>
#include <vector>

#include "imagery/parcel_shape.h"
#include "imagery/scanline_grid.h"

namespace plat::imagery::detail {

/// The outer contour seen along a scan axis: `ring` is counter-clockwise in coordinates along and
/// across the axis, in a unit of one to two metres such that they are exact on the working grid;
/// `world` has the same vertices in the local frame.
struct ContourProfile {
  Ring ring;
  Ring world;
};
/// @param simplified_m  vertices nearer than this to the contour without them are left out
ContourProfile profile_of(const ParcelShape& shape, ScanAxis axis, Symmetry symmetry,
                          double simplified_m = 0.0);

/// Perpendicular edges at the ends only, one way there and one way back.
bool is_monotone(const ContourProfile& profile);

/// Where the scan lines begin and end.
enum class ChainEnds {
  kSides,  ///< at a steep side that runs into the first or last vertex
  kTips,   ///< at the first and last vertex
};

/// A vertex of a chain with its parameter.
struct ChainVertex {
  double line;   ///< in [0, 1], growing along the chain
  Point across;  ///< along and across the axis
  Point world;
};
struct ContourChains {
  std::vector<ChainVertex> lower;
  std::vector<ChainVertex> upper;
};

/// Lower and upper chain from the first to the last vertex along the axis. The parameter of a
/// vertex is its share of the way along the axis; an edge that rises by r gets at least
/// `lean` * r of it, taken from the side where the parcel is wider. nullopt where the parameters
/// do not grow.
std::optional<ContourChains> chains_of(const ContourProfile& profile, ChainEnds ends, double lean);

}  // namespace plat::imagery::detail
