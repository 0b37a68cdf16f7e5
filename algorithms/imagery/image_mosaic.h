#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "core/parallel.h"
#include "core/progress.h"
#include "geodata/raster_io.h"
#include "imagery/imagery_plan.h"

namespace plat::imagery {

/// An image that several threads read at once: one reader for each of them.
class SharedImage {
 public:
  SharedImage(std::string file, const geodata::RasterReadOptions& options);

  [[nodiscard]] const geodata::RasterGrid& grid() const { return grid_; }
  /// What the file says of itself: "rendered ..." travels into what is made of it.
  [[nodiscard]] const std::string& description() const { return description_; }
  /// The pixels that touch the box, clipped to the image; of width or height 0 where none does.
  [[nodiscard]] geodata::Raster read(const Box& box) const;

 private:
  std::string file_;
  geodata::RasterReadOptions options_;
  geodata::RasterGrid grid_;
  std::string description_;
  mutable std::mutex mutex_;
  mutable std::vector<std::unique_ptr<geodata::RasterReader>> idle_;
};

/// Draws the land between parcels: streets, water, what is there anyway. Called from several
/// threads.
using GroundPainter = std::function<geodata::Raster(const geodata::PixelWindow&)>;

/// Land of one colour.
GroundPainter plain_ground(const geodata::RasterGrid& grid, geodata::Colour colour);

struct MosaicInput {
  std::span<const ParcelShape> targets;
  std::span<const std::optional<ParcelImage>> plan;  ///< per target
  std::span<const SharedImage* const> images;        ///< per example
  GroundPainter ground;
};

/// The image of a city: ground, and on it every parcel with the image of its source.
///
/// Guarantees: 1. the same pixels for any thread count and any window;  2. every pixel of a parcel
/// that has an image is filled, boundaries are shared by coverage (CoverageCanvas).
geodata::Raster draw_mosaic(const MosaicInput& input, const geodata::RasterGrid& grid,
                            const geodata::PixelWindow& window, Jobs jobs = {});

/// The same into a GeoTIFF, strip by strip: a city is never held in memory.
/// @throws InputError where the path cannot be written
void write_mosaic(const std::string& path, const MosaicInput& input,
                  const geodata::RasterGrid& grid, const geodata::RasterWriteOptions& options,
                  Jobs jobs = {}, Progress::Style progress = Progress::Style::kQuiet);

}  // namespace plat::imagery
