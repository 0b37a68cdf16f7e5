#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>

#include "core/box.h"
#include "geodata/layer.h"
#include "geodata/raster.h"

namespace plat::geodata {

/// Where the pixels of an image are, without the pixels; as in Raster.
struct RasterGrid {
  LocalFrame frame;
  double left_m = 0.0;
  double top_m = 0.0;
  double pixel_m = 1.0;
  std::size_t width = 0;
  std::size_t height = 0;

  friend bool operator==(const RasterGrid&, const RasterGrid&) = default;

  [[nodiscard]] Box box() const {
    return {{left_m, top_m - static_cast<double>(height) * pixel_m},
            {left_m + static_cast<double>(width) * pixel_m, top_m}};
  }
};

RasterGrid grid_of(const Raster& raster);

/// A rectangle of pixels of an image.
struct PixelWindow {
  std::size_t column = 0;
  std::size_t row = 0;
  std::size_t width = 0;
  std::size_t height = 0;

  friend bool operator==(const PixelWindow&, const PixelWindow&) = default;
};

/// An image without its pixels, all transparent: the window's place in the grid. Pre: inside it.
Raster empty_raster(const RasterGrid& grid, const PixelWindow& window);

/// The pixels that touch `box`, clipped to the grid; width or height 0 where none does.
PixelWindow window_of(const RasterGrid& grid, const Box& box);

struct RasterReadOptions {
  std::optional<LocalFrame> frame{};  ///< warp into this one; chosen from the image if not given
  std::optional<double> pixel_m{};    ///< resample to it; the image's own resolution if not given
};

/// A georeferenced image of whatever GDAL opens, read window by window in a local frame, north up,
/// with square pixels.
///
/// Frame: chosen as read_layer() does. An image that is north up, with square pixels, in the
/// frame's CRS keeps its grid, and its pixels are read as they are. Any other is warped by GDAL
/// (cubic, averaging where it is made coarser) to a grid whose lines are multiples of the pixel;
/// without `pixel_m` the pixel is the one that keeps the number of pixels along the diagonal.
/// Bands: 1 (grey), 2 (grey, alpha), 3 or 4 (red, green, blue, alpha) of 8 or 16 bits. 16 bits are
/// scaled linearly, one factor for all bands: 0 to 0, the largest value of any colour band to 255.
/// Alpha is 0 where the image has no data: outside it, under its mask, or nodata in every band.
///
/// Guarantees: 1. the same window has the same pixels, however the image is divided into windows;
/// 2. memory is that of one window and of GDAL's cache.
class RasterReader {
 public:
  /// @throws InputError, one line with file and remedy: file missing or not an image; no place on
  ///   Earth (geotransform or CRS); other bands than those above
  explicit RasterReader(const std::string& file, const RasterReadOptions& options = {});
  ~RasterReader();
  RasterReader(RasterReader&&) noexcept;
  RasterReader& operator=(RasterReader&&) noexcept;

  [[nodiscard]] const RasterGrid& grid() const;
  /// What the file says the picture is (TIFF tag 270, RasterWriteOptions::description); empty where
  /// it says nothing.
  [[nodiscard]] std::string description() const;
  /// Pre: the window lies in the grid. Not from two threads at once. @throws InputError where the
  /// file is damaged
  [[nodiscard]] Raster read(const PixelWindow& window) const;

 private:
  class Source;
  std::unique_ptr<Source> source_;
};

/// The whole image, or what of it lies in `window` (local frame, metres).
/// @throws InputError as RasterReader, and where `window` does not meet the image
Raster read_raster(const std::string& file, const RasterReadOptions& options = {},
                   const std::optional<Box>& window = std::nullopt);

enum class RasterBands { kOpaque, kAlpha };         ///< red, green, blue; and alpha
enum class RasterCompression { kLossless, kJpeg };  ///< DEFLATE; JPEG (opaque only)

struct RasterWriteOptions {
  RasterBands bands = RasterBands::kAlpha;
  RasterCompression compression = RasterCompression::kLossless;
  std::string description{};  ///< what the picture is, e.g. that it is no photograph; TIFF tag 270
};

/// Writes a GeoTIFF from top to bottom, in strips of rows: tiled, compressed, with overviews, so
/// that a city opens at once in QGIS and is never held in memory.
///
/// Guarantees: 1. the same pixels give the same bytes, however they are divided into strips;
/// 2. the file appears whole, at finish(), or not at all (written beside the target, renamed);
/// 3. memory is that of 256 rows and of GDAL's cache.
class RasterWriter {
 public:
  /// @throws InputError where the path cannot be written or has another ending than .tif, .tiff
  RasterWriter(const std::string& path, const RasterGrid& grid,
               const RasterWriteOptions& options = {});
  ~RasterWriter();
  RasterWriter(RasterWriter&&) noexcept;
  RasterWriter& operator=(RasterWriter&&) noexcept;

  /// The next rows. Pre: as wide as the grid, and no more rows than are left.
  /// @throws InputError where the disk is full
  void write(const Raster& strip);
  /// Overviews, and the file takes its name. Pre: all rows were written.
  void finish();

 private:
  class Target;
  std::unique_ptr<Target> target_;
};

/// The whole image; alpha is written only where a pixel is not opaque.
/// @throws InputError as RasterWriter
void write_raster(const std::string& path, const Raster& raster,
                  const std::string& description = {});

}  // namespace plat::geodata
