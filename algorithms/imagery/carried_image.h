#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <variant>

#include "core/affine.h"
#include "core/polygon.h"
#include "imagery/image_mosaic.h"

namespace plat::imagery {

/// A piece of land, and what it shows: the source image through a map, or one colour.
struct CarriedPiece {
  Polygon shape;  ///< where it is now
  /// From a point of it now to the place in the source image that it shows.
  std::variant<Affine, geodata::Colour> shows;
};

/// From a point of the picture to the place in the source image that it shows.
using PointMap = std::function<Point(Point)>;

/// Distance of the points at which carried_ground() asks a map, metres: between them it is
/// bilinear.
inline constexpr double kGroundLattice_m = 2.0;

/// Land that is carried by a smooth map, such as the one by which streets follow tiles: the source
/// image where the map takes each pixel to. Without data where the source has none.
GroundPainter carried_ground(const SharedImage& source, PointMap to_source,
                             const geodata::RasterGrid& grid);

/// `painter` where `upper` has no data.
GroundPainter over_ground(GroundPainter upper, GroundPainter painter);

/// A picture of land whose pieces were moved: each with its part of the source image, on a ground.
struct CarriedInput {
  std::span<const CarriedPiece> pieces;
  const SharedImage* source = nullptr;
  GroundPainter ground;
};

/// Guarantees: 1. pieces that did not move show the source's own pixels, and those that moved by
/// whole pixels the same pixels there;  2. every pixel of a piece is filled where the source has
/// data, boundaries are shared by coverage (CoverageCanvas);  3. the same pixels for any thread
/// count and any window;  4. nothing is folded: maps are affine.
/// Paper: [ABVA08, Sec. 4 and Fig. 5], imagery follows tiles by the same transformation.
geodata::Raster draw_carried_image(const CarriedInput& input, const geodata::RasterGrid& grid,
                                   const geodata::PixelWindow& window, Jobs jobs = {});

/// The same into a GeoTIFF, strip by strip. @throws InputError where the path cannot be written
void write_carried_image(const std::string& path, const CarriedInput& input,
                         const geodata::RasterGrid& grid,
                         const geodata::RasterWriteOptions& options, Jobs jobs = {},
                         Progress::Style progress = Progress::Style::kQuiet);

}  // namespace plat::imagery
