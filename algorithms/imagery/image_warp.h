#pragma once

#include <cstdint>
#include <vector>

#include "core/affine.h"
#include "geodata/raster_io.h"
#include "imagery/linear_light.h"
#include "imagery/pixel_coverage.h"
#include "imagery/warp_map.h"

namespace plat::imagery {

/// At most this many samples along each side of a target pixel: an image made more than as many
/// times smaller is sampled with gaps.
inline constexpr int kMostSamples = 16;

/// A colour and how much of it is known, 0 where the source has no data.
struct Sample {
  LinearColour colour;
  double weight = 0.0;
};

/// What the source shows on the area of one target pixel, in linear light: bilinear samples on a
/// regular grid over the pixel, as many along each side as it covers source pixels.
///
/// Guarantees: 1. where pixel centres go to pixel centres, the source's own colour;  2. no detail
/// is skipped up to kMostSamples source pixels per target pixel: a checkerboard becomes grey;
/// 3. pixels without data (alpha 0) do not mix in.
/// @param at       the pixel's centre in the source and the Jacobian there
/// @param pixel_m  of the target
Sample sample_area(const geodata::Raster& source, const SourcePoint& at, double pixel_m);

/// A window of an image under composition: light per pixel, weighted by coverage.
///
/// Guarantees: 1. parcels that share their edges are mixed at the edge by coverage, and the ground
/// shows through nowhere between them;  2. the result does not depend on the order of adding;
/// 3. where parcels overlap, they share the pixel.
class CoverageCanvas {
 public:
  CoverageCanvas(const geodata::RasterGrid& grid, const geodata::PixelWindow& window);

  [[nodiscard]] const geodata::RasterGrid& grid() const { return grid_; }
  [[nodiscard]] const geodata::PixelWindow& window() const { return window_; }
  /// Pre: the pixel lies in the window.
  void add(std::size_t column, std::size_t row, const LinearColour& colour, std::uint8_t cover);
  /// `ground` where no parcel is, and in the shares of pixels that none covers. Pre: `ground` is
  /// the same window.
  [[nodiscard]] geodata::Raster over(const geodata::Raster& ground) const;

 private:
  struct Light {
    std::uint32_t red = 0;
    std::uint32_t green = 0;
    std::uint32_t blue = 0;
    std::uint32_t cover = 0;
  };
  geodata::RasterGrid grid_;
  geodata::PixelWindow window_;
  std::vector<Light> pixels_;
};

/// Draws the source parcel's image into the target parcel: pixel by pixel back through the map.
/// @param source  the part of the example's image that the map reaches (source_box)
/// Paper:     [AVB08, Sec. 3.2]: textured quadrilaterals
/// Deviation: area sampling in linear light instead of the graphics card's (ADR 0032)
void draw_parcel(const Polygon& target, const WarpMap& map, const geodata::Raster& source,
                 CoverageCanvas& canvas);

/// Draws the source's image into the target through an affine map: without folds.
/// @param to_source  from a point of the target to where it is in the source; not singular
void draw_carried(const Polygon& target, const Affine& to_source, const geodata::Raster& source,
                  CoverageCanvas& canvas);

/// What of the example's image a warp needs: its quadrilaterals, and half the footprint of a pixel
/// around them.
Box source_box(const WarpGrid& grid, double margin_m);

}  // namespace plat::imagery
