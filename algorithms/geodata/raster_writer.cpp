#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <span>
#include <vector>

#include "core/failure.h"
#include "geodata/gdal_internal.h"
#include "geodata/partial_file_internal.h"
#include "geodata/raster_io.h"

namespace plat::geodata {
namespace {

using detail::QuietGdal;
using detail::ScopedConfig;
namespace fs = std::filesystem;

/// Sides of a tile of the file, pixels.
constexpr std::size_t kTile = 256;
/// Overviews halve the image until it is at most this wide and high: it then opens at once.
constexpr std::size_t kOverviewSize = 512;

/// Bytes of GDAL's block cache while a file is finished: its default, a share of the machine's
/// memory, would fill with tiles that are read once.
constexpr GIntBig kCacheBytes = 128 << 20;

/// GDAL's cache is one for the process: made smaller for a while, never larger.
class SmallCache {
 public:
  SmallCache() : before_(GDALGetCacheMax64()) { GDALSetCacheMax64(std::min(before_, kCacheBytes)); }
  ~SmallCache() { GDALSetCacheMax64(before_); }
  SmallCache(const SmallCache&) = delete;
  SmallCache& operator=(const SmallCache&) = delete;

 private:
  GIntBig before_;
};

void expect_tif(const std::string& path) {
  const std::string ending = fs::path(path).extension().string();
  if (ending != ".tif" && ending != ".tiff")
    throw InputError(fmt::format("{}: the file must end in .tif or .tiff", path));
}

CPLStringList creation_options(const RasterWriteOptions& options) {
  const bool is_jpeg = options.compression == RasterCompression::kJpeg;
  expects(!is_jpeg || options.bands == RasterBands::kOpaque, "JPEG has no alpha");
  CPLStringList out;
  out.SetNameValue("TILED", "YES");
  out.SetNameValue("BLOCKXSIZE", std::to_string(kTile).c_str());
  out.SetNameValue("BLOCKYSIZE", std::to_string(kTile).c_str());
  out.SetNameValue("INTERLEAVE", "PIXEL");
  out.SetNameValue("COMPRESS", is_jpeg ? "JPEG" : "DEFLATE");
  out.SetNameValue("BIGTIFF", "IF_SAFER");
  // Tiles are compressed in parallel and written in order.
  out.SetNameValue("NUM_THREADS", "2");
  if (is_jpeg) {
    out.SetNameValue("PHOTOMETRIC", "YCBCR");
    out.SetNameValue("JPEG_QUALITY", "90");
  } else {
    out.SetNameValue("PHOTOMETRIC", "RGB");
    out.SetNameValue("PREDICTOR", "2");
    out.SetNameValue("ZLEVEL", "6");
    if (options.bands == RasterBands::kAlpha) out.SetNameValue("ALPHA", "NON-PREMULTIPLIED");
  }
  return out;
}

}  // namespace

class RasterWriter::Target {
 public:
  Target(const std::string& path, const RasterGrid& grid, const RasterWriteOptions& options)
      : path_(path),
        grid_(grid),
        bands_(options.bands == RasterBands::kAlpha ? 4 : 3),
        partial_(fs::path(path)) {
    expect_tif(path);
    expects(grid.width > 0 && grid.height > 0 && grid.pixel_m > 0.0, "an image has pixels");
    const QuietGdal quiet;
    GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("GTiff");
    if (driver == nullptr) throw InputError("GDAL has no GTiff driver; reinstall it");
    data_.reset(driver->Create(partial_.path().c_str(), static_cast<int>(grid.width),
                               static_cast<int>(grid.height), bands_, GDT_Byte,
                               creation_options(options).List()));
    if (data_ == nullptr) refuse(quiet, "the file cannot be created; does its folder exist?");
    std::array<double, 6> placement{grid.frame.origin.x + grid.left_m, grid.pixel_m, 0.0,
                                    grid.frame.origin.y + grid.top_m,  0.0,          -grid.pixel_m};
    data_->SetGeoTransform(placement.data());
    if (!grid.frame.crs_wkt.empty())
      data_->SetSpatialRef(detail::reference_from_wkt(grid.frame.crs_wkt).get());
    if (!options.description.empty())
      data_->SetMetadataItem("TIFFTAG_IMAGEDESCRIPTION", options.description.c_str());
    data_->SetMetadataItem("TIFFTAG_SOFTWARE", "plat");
  }

  void write(const Raster& strip) {
    expects(strip.width == grid_.width, "a strip is as wide as the image");
    expects(seen_rows_ + strip.height <= grid_.height, "no more rows than the image has");
    seen_rows_ += strip.height;
    std::span<const Colour> rest(strip.pixels);
    while (!rest.empty()) {
      // Whole rows of tiles go to the file, in order: then its bytes do not depend on the strips.
      const std::size_t room = kTile * grid_.width - pending_.size();
      const std::size_t taken = std::min(room, rest.size());
      pending_.insert(pending_.end(), rest.begin(),
                      rest.begin() + static_cast<std::ptrdiff_t>(taken));
      rest = rest.subspan(taken);
      if (taken == room) write_pending();
    }
    if (seen_rows_ == grid_.height && !pending_.empty()) write_pending();
  }

  void finish() {
    expects(seen_rows_ == grid_.height, "all rows were written");
    const QuietGdal quiet;
    const SmallCache small_cache;
    const ScopedConfig two_threads("GDAL_NUM_THREADS", "2");
    std::vector<int> factors;
    for (std::size_t factor = 2; std::max(grid_.width, grid_.height) * 2 / factor > kOverviewSize;
         factor *= 2)
      factors.push_back(static_cast<int>(factor));
    data_->FlushCache();
    if (!factors.empty() &&
        data_->BuildOverviews("AVERAGE", static_cast<int>(factors.size()), factors.data(), 0,
                              nullptr, nullptr, nullptr) != CE_None)
      refuse(quiet, "overviews; is the disk full?");
    data_.reset();
    if (quiet.has_failed()) refuse(quiet, "the file cannot be finished; is the disk full?");
    partial_.commit();
  }

 private:
  [[noreturn]] void refuse(const QuietGdal& quiet, const std::string& what) const {
    throw InputError(fmt::format("{}: cannot be written: {}{}", path_, what, quiet.reason()));
  }

  void write_pending() {
    const QuietGdal quiet;
    const auto width = static_cast<int>(grid_.width);
    const auto height = static_cast<int>(pending_.size() / grid_.width);
    constexpr GSpacing kPixelBytes = sizeof(Colour);
    const CPLErr status = data_->RasterIO(GF_Write, 0, static_cast<int>(written_rows_), width,
                                          height, pending_.data(), width, height, GDT_Byte, bands_,
                                          nullptr, kPixelBytes, kPixelBytes * width, 1, nullptr);
    if (status != CE_None) refuse(quiet, fmt::format("row {}; is the disk full?", written_rows_));
    data_->FlushCache();
    written_rows_ += static_cast<std::size_t>(height);
    pending_.clear();
  }

  std::string path_;
  RasterGrid grid_;
  int bands_;
  detail::PartialFile partial_;
  GDALDatasetUniquePtr data_;
  std::vector<Colour> pending_;  ///< rows that do not fill a row of tiles yet
  std::size_t seen_rows_ = 0;
  std::size_t written_rows_ = 0;
};

RasterWriter::RasterWriter(const std::string& path, const RasterGrid& grid,
                           const RasterWriteOptions& options)
    : target_(std::make_unique<Target>(path, grid, options)) {}
RasterWriter::~RasterWriter() = default;
RasterWriter::RasterWriter(RasterWriter&&) noexcept = default;
RasterWriter& RasterWriter::operator=(RasterWriter&&) noexcept = default;

void RasterWriter::write(const Raster& strip) { target_->write(strip); }
void RasterWriter::finish() { target_->finish(); }

void write_raster(const std::string& path, const Raster& raster, const std::string& description) {
  const bool is_opaque = std::all_of(raster.pixels.begin(), raster.pixels.end(),
                                     [](Colour c) { return c.alpha == 255; });
  RasterWriter writer(path, grid_of(raster),
                      {.bands = is_opaque ? RasterBands::kOpaque : RasterBands::kAlpha,
                       .description = description});
  writer.write(raster);
  writer.finish();
}

}  // namespace plat::geodata
