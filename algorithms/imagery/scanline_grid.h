#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "imagery/parcel_shape.h"

namespace plat::imagery {

/// Notches up to this deep, and up to this share of a parcel's width, may be left out of the
/// contours that a warp follows: what surveys and their quantisation leave (0.8 m in Cambridge).
inline constexpr double kMostSimplified_m = 2.0;
inline constexpr double kMostSimplified_01 = 0.1;

/// The direction along which scan lines follow each other: the longer or the shorter side of the
/// box.
enum class ScanAxis : std::uint8_t { kMain, kOther };

/// Whether every line across the axis meets the outer contour in one segment, with perpendicular
/// edges at the two ends only: what [AVB08, Sec. 3.2] asks of a contour for a continuous warp
/// without folds. Exact on the working grid.
bool is_monotone(const ParcelShape& shape, ScanAxis axis);

/// How the quadrilaterals of a warp were found.
enum class WarpKind : std::uint8_t {
  kScanLines,  ///< across the main axis, along which both contours are monotone
  kOtherAxis,  ///< across the other axis, along which both are monotone, as they are not along main
  kSlanted,    ///< not monotone: lines that lean at steps and overhangs
  kSimplified,  ///< any of these, of contours without notches of some decimetres
  kBox,         ///< none of these: box on box, cut to the target
};
std::string_view warp_kind_name(WarpKind kind);
inline constexpr std::array kWarpKinds{WarpKind::kScanLines, WarpKind::kOtherAxis,
                                       WarpKind::kSlanted, WarpKind::kSimplified, WarpKind::kBox};

/// A quadrilateral between two scan lines: lower start, lower end, upper end, upper start;
/// counter-clockwise in the target, and in the source unless the symmetry mirrors.
using Quad = std::array<Point, 4>;

/// Corresponding quadrilaterals of two parcels, from the start of the axis to its end. Column k
/// lies between lines[k] and lines[k + 1], parameters along the contour in [0, 1].
///
/// The paper's s x n grid in the limit of many lines and samples: between two neighbouring scan
/// lines that follow every vertex of both contours, all s lines and n samples in between lie on the
/// bilinear map of the quadrilateral, so the map does not depend on s and n; grid_samples() gives
/// them where they are to be seen.
///
/// Guarantees: 1. one to one: in every column the Jacobian is positive at all four corners of both
/// quadrilaterals (at a tip, where two corners meet, zero there), so, being linear, within;
/// 2. continuous: neighbouring columns share their line;  3. but for kSimplified and kBox, the
/// quadrilaterals cover both parcels up to the contour: their areas sum to the outer ring's;  4.
/// for kSimplified they follow contours that are nowhere farther than `simplified_m` from the
/// parcels'; what lies beyond goes to the source's contour;  5. for kBox, the map is affine and
/// covers the target; it may leave the source, and the report says how often. Why it cannot fold: 1
/// makes the map from parameters to parcel a local homeomorphism; its boundary runs round the
/// simple contour once; so it is one onto one.
struct WarpGrid {
  WarpKind kind = WarpKind::kBox;
  Symmetry symmetry = Symmetry::kKept;
  double simplified_m = 0.0;  ///< of kSimplified, else 0
  std::vector<double> lines;  ///< columns + 1, from 0 to 1
  std::vector<Quad> target;   ///< one per column, local frame of the target's city
  std::vector<Quad> source;   ///< one per column, local frame of the example
};

/// The grid between two parcels; holes are ignored.
///
/// First found of: lines across the main axis; across the other axis (both need monotone contours,
/// and then succeed but for steps of micrometres); lines that lean at steps, across either axis,
/// where guarantee 1 holds; the same for contours simplified more and more; box on box.
/// Paper:     [AVB08, Sec. 3.2, Fig. 7]
/// Deviation: lines through every vertex of both contours, so that both are followed exactly (s
///            uniform lines cut corners off and leave slivers blank); a steep end side is the first
///            line, so that corners go to corners; a steep step gets a width in the parameter, so
///            that lines lean there instead of tearing; fallbacks (ADR 0032)
/// Complexity: O(n log n) of the vertices
WarpGrid warp_grid(const ParcelShape& source, const ParcelShape& target, Symmetry symmetry);

/// s x n sample points that correspond: s lines, uniformly separated in the parameter, n samples on
/// each, line by line.
struct GridSamples {
  std::vector<Point> target;
  std::vector<Point> source;
};
GridSamples grid_samples(const WarpGrid& grid, std::size_t lines, std::size_t samples);

/// The point of a quadrilateral at (a, b) in [0, 1]^2: a along the contour, b across.
Point bilinear(const Quad& quad, double a, double b);

}  // namespace plat::imagery
