#include <fmt/format.h>
#include <gdal_alg.h>
#include <gdal_utils.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "core/failure.h"
#include "geodata/projection_internal.h"
#include "geodata/raster_io.h"

namespace plat::geodata {
namespace {

using detail::QuietGdal;
using detail::SpatialReference;

/// Sides of a pixel that differ by less are equal: over 10^5 pixels that is a tenth of one.
constexpr double kSquareness = 1e-6;
/// A window's border that misses a pixel's border by less lies on it.
constexpr double kPixelSlack = 1e-6;

/// Column and row to coordinates of the file's CRS: x = a[0] + a[1] column + a[2] row, then y.
using Placement = std::array<double, 6>;

Point place(const Placement& a, double column, double row) {
  return {a[0] + a[1] * column + a[2] * row, a[3] + a[4] * column + a[5] * row};
}

bool is_north_up_and_square(const Placement& a) {
  return a[2] == 0.0 && a[4] == 0.0 && a[1] > 0.0 && std::abs(a[1] + a[5]) <= kSquareness * a[1];
}

GDALDatasetUniquePtr open_raster(const std::string& file) {
  const QuietGdal quiet;
  if (!file.starts_with("/vsi") && !std::filesystem::exists(file))
    throw InputError(fmt::format("{}: no such file; check the path", file));
  GDALDatasetUniquePtr data(GDALDataset::Open(file.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY,
                                              nullptr, nullptr, nullptr));
  if (data == nullptr || data->GetRasterCount() == 0) {
    throw InputError(
        fmt::format("{}: not an image that GDAL can read; `gdalinfo` must be able to open it{}",
                    file, quiet.reason()));
  }
  return data;
}

struct Bands {
  int colours = 0;         ///< 1 or 3
  bool has_alpha = false;  ///< as the band behind them
  GDALDataType type = GDT_Byte;
};

Bands bands_of(GDALDataset& data, const std::string& file) {
  const int count = data.GetRasterCount();
  Bands out;
  out.type = data.GetRasterBand(1)->GetRasterDataType();
  const bool is_palette = data.GetRasterBand(1)->GetColorInterpretation() == GCI_PaletteIndex;
  out.has_alpha = data.GetRasterBand(count)->GetColorInterpretation() == GCI_AlphaBand ||
                  count == 4 || count == 2;
  out.colours = count - (out.has_alpha ? 1 : 0);
  const bool is_alike = [&] {
    for (int i = 1; i <= count; ++i) {
      if (data.GetRasterBand(i)->GetRasterDataType() != out.type) return false;
    }
    return out.type == GDT_Byte || out.type == GDT_UInt16;
  }();
  if (!is_alike || is_palette || (out.colours != 1 && out.colours != 3)) {
    throw InputError(fmt::format(
        "{}: {} bands of type {}{}, wanted grey or red, green and blue, with or without alpha, of "
        "8 or 16 bits; make them: gdal_translate -b 1 -b 2 -b 3 -ot Byte -scale, or -expand rgba",
        file, count, GDALGetDataTypeName(out.type), is_palette ? " with a palette" : ""));
  }
  return out;
}

/// What of 16 bits becomes 255: the largest value of any colour band.
double white_of(GDALDataset& data, const Bands& bands) {
  if (bands.type == GDT_Byte) return 255.0;
  double white = 1.0;
  for (int i = 1; i <= bands.colours; ++i) {
    std::array<double, 2> range{};
    if (data.GetRasterBand(i)->ComputeRasterMinMax(FALSE, range.data()) == CE_None)
      white = std::max(white, range[1]);
  }
  return white;
}

SpatialReference reference_of(GDALDataset& data, const std::string& file) {
  const OGRSpatialReference* found = data.GetSpatialRef();
  if (found == nullptr || found->IsEmpty() != 0 ||
      (found->IsProjected() == 0 && found->IsGeographic() == 0)) {
    throw InputError(fmt::format(
        "{}: has no coordinate reference system; give it one: gdal_edit.py -a_srs EPSG:CODE {}",
        file, file));
  }
  return detail::reference_from_wkt(detail::wkt_of(*found));
}

Placement placement_of(GDALDataset& data, const std::string& file) {
  Placement out{};
  if (data.GetGeoTransform(out.data()) != CE_None) {
    throw InputError(
        fmt::format("{}: its place on Earth is not known (no geotransform); give it one: "
                    "gdal_translate -a_ullr LEFT TOP RIGHT BOTTOM -a_srs EPSG:CODE, or gdalwarp if "
                    "it has control points",
                    file));
  }
  return out;
}

std::uint8_t scaled(std::uint16_t value, double white) {
  return static_cast<std::uint8_t>(
      std::clamp(std::lround(255.0 * static_cast<double>(value) / white), 0L, 255L));
}

}  // namespace

class RasterReader::Source {
 public:
  Source(const std::string& file, const RasterReadOptions& options)
      : file_(file), image_(open_raster(file)) {
    const QuietGdal quiet;
    bands_ = bands_of(*image_, file);
    const SpatialReference reference = reference_of(*image_, file);
    const Placement placement = placement_of(*image_, file);
    white_ = white_of(*image_, bands_);
    grid_.frame = options.frame.value_or(LocalFrame{});
    expects(!options.frame || !grid_.frame.crs_wkt.empty(), "a frame to warp into has a CRS");
    expects(!options.pixel_m || *options.pixel_m > 0.0, "a pixel has a size");
    if (!options.frame) {
      const Point center =
          place(placement, image_->GetRasterXSize() / 2.0, image_->GetRasterYSize() / 2.0);
      grid_.frame = detail::choose_frame(*reference, center, file, "gdal_edit.py");
    }
    const SpatialReference target = detail::reference_from_wkt(grid_.frame.crs_wkt);
    const bool keeps_pixel = !options.pixel_m || *options.pixel_m == placement[1];
    if (keeps_pixel && is_north_up_and_square(placement) && reference->IsSame(target.get()) != 0) {
      keep_grid(placement);
    } else {
      warp(*target, options.pixel_m);
    }
  }

  [[nodiscard]] const RasterGrid& grid() const { return grid_; }

  [[nodiscard]] std::string description() const {
    const char* text = image_->GetMetadataItem("TIFFTAG_IMAGEDESCRIPTION");
    return text == nullptr ? std::string() : std::string(text);
  }

  [[nodiscard]] Raster read(const PixelWindow& window) const {
    QuietGdal quiet;
    Raster out = empty_raster(grid_, window);
    std::vector<std::uint16_t> plane(out.pixels.size());
    const auto read_band = [&](GDALRasterBand& band) {
      const auto width = static_cast<int>(window.width);
      const auto height = static_cast<int>(window.height);
      const CPLErr status =
          band.RasterIO(GF_Read, static_cast<int>(window.column), static_cast<int>(window.row),
                        width, height, plane.data(), width, height, GDT_UInt16, 0, 0, nullptr);
      if (status != CE_None)
        throw InputError(
            fmt::format("{}: cannot be read{}; is it damaged?", file_, quiet.reason()));
    };
    if (plane.empty()) return out;
    GDALDataset& data = warped_ ? *warped_ : *image_;
    constexpr std::array kChannels{&Colour::red, &Colour::green, &Colour::blue};
    for (int i = 1; i <= bands_.colours; ++i) {
      read_band(*data.GetRasterBand(i));
      for (std::size_t p = 0; p < plane.size(); ++p) {
        const std::uint8_t value = scaled(plane[p], white_);
        out.pixels[p].*kChannels[static_cast<std::size_t>(i - 1)] = value;
        if (bands_.colours == 1) out.pixels[p].green = out.pixels[p].blue = value;
      }
    }
    if (warped_ || bands_.has_alpha) {
      const double opaque = bands_.type == GDT_Byte ? 255.0 : 65535.0;
      read_band(*data.GetRasterBand(bands_.colours + 1));
      for (std::size_t p = 0; p < plane.size(); ++p) out.pixels[p].alpha = scaled(plane[p], opaque);
      return out;
    }
    // Without alpha a pixel is there where the mask of any band says so.
    for (int i = 1; i <= bands_.colours; ++i) {
      read_band(*data.GetRasterBand(i)->GetMaskBand());
      for (std::size_t p = 0; p < plane.size(); ++p) {
        if (plane[p] != 0) out.pixels[p].alpha = 255;
      }
    }
    return out;
  }

 private:
  void keep_grid(const Placement& placement) {
    grid_.pixel_m = placement[1];
    grid_.left_m = placement[0] - grid_.frame.origin.x;
    grid_.top_m = placement[3] - grid_.frame.origin.y;
    grid_.width = static_cast<std::size_t>(image_->GetRasterXSize());
    grid_.height = static_cast<std::size_t>(image_->GetRasterYSize());
  }

  void warp(const OGRSpatialReference& target, std::optional<double> pixel_m) {
    const QuietGdal quiet;
    const auto refuse = [&] {
      throw InputError(
          fmt::format("{}: cannot be warped to \"{}\"{}", file_, target.GetName(), quiet.reason()));
    };
    CPLStringList to;
    to.SetNameValue("DST_SRS", grid_.frame.crs_wkt.c_str());
    void* transformer = GDALCreateGenImgProjTransformer2(image_.get(), nullptr, to.List());
    if (transformer == nullptr) refuse();
    Placement suggested{};
    std::array<double, 4> extent{};
    int columns = 0;
    int rows = 0;
    const CPLErr status =
        GDALSuggestedWarpOutput2(image_.get(), GDALGenImgProjTransform, transformer,
                                 suggested.data(), &columns, &rows, extent.data(), 0);
    GDALDestroyGenImgProjTransformer(transformer);
    if (status != CE_None) refuse();
    grid_.pixel_m = pixel_m.value_or(suggested[1]);
    set_extent({{extent[0], extent[1]}, {extent[2], extent[3]}});
    warped_ = virtual_warp();
    if (warped_ == nullptr) refuse();
  }

  /// The pixels that touch a box of the CRS, on a grid whose lines are multiples of the pixel.
  void set_extent(const Box& box) {
    const double pixel = grid_.pixel_m;
    const Point origin = grid_.frame.origin;
    const double left = std::floor((box.min.x - origin.x) / pixel);
    const double top = std::ceil((box.max.y - origin.y) / pixel);
    grid_.left_m = left * pixel;
    grid_.top_m = top * pixel;
    grid_.width = static_cast<std::size_t>(std::ceil((box.max.x - origin.x) / pixel) - left);
    grid_.height = static_cast<std::size_t>(top - std::floor((box.min.y - origin.y) / pixel));
  }

  [[nodiscard]] GDALDatasetUniquePtr virtual_warp() const {
    const Box box = grid_.box();
    const Point origin = grid_.frame.origin;
    CPLStringList arguments;
    const auto add = [&](std::initializer_list<std::string> words) {
      for (const std::string& word : words) arguments.AddString(word.c_str());
    };
    const auto text = [](double value) { return fmt::format("{:.17g}", value); };
    add({"-of", "VRT", "-t_srs", grid_.frame.crs_wkt, "-r", "cubic", "-dstalpha"});
    add({"-te", text(box.min.x + origin.x), text(box.min.y + origin.y), text(box.max.x + origin.x),
         text(box.max.y + origin.y)});
    add({"-ts", std::to_string(grid_.width), std::to_string(grid_.height)});
    GDALWarpAppOptions* options = GDALWarpAppOptionsNew(arguments.List(), nullptr);
    GDALDatasetH source = GDALDataset::ToHandle(image_.get());
    GDALDatasetUniquePtr out(
        GDALDataset::FromHandle(GDALWarp("", nullptr, 1, &source, options, nullptr)));
    GDALWarpAppOptionsFree(options);
    return out;
  }

  std::string file_;
  GDALDatasetUniquePtr image_;
  GDALDatasetUniquePtr warped_;  ///< over `image_`, so it goes first
  Bands bands_;
  double white_ = 255.0;
  RasterGrid grid_;
};

RasterReader::RasterReader(const std::string& file, const RasterReadOptions& options)
    : source_(std::make_unique<Source>(file, options)) {}
RasterReader::~RasterReader() = default;
RasterReader::RasterReader(RasterReader&&) noexcept = default;
RasterReader& RasterReader::operator=(RasterReader&&) noexcept = default;

const RasterGrid& RasterReader::grid() const { return source_->grid(); }

std::string RasterReader::description() const { return source_->description(); }

Raster RasterReader::read(const PixelWindow& window) const { return source_->read(window); }

RasterGrid grid_of(const Raster& raster) {
  return {raster.frame, raster.left_m, raster.top_m, raster.pixel_m, raster.width, raster.height};
}

Raster empty_raster(const RasterGrid& grid, const PixelWindow& window) {
  expects(window.column + window.width <= grid.width && window.row + window.height <= grid.height,
          "a window lies in the image");
  return {grid.frame,
          grid.left_m + static_cast<double>(window.column) * grid.pixel_m,
          grid.top_m - static_cast<double>(window.row) * grid.pixel_m,
          grid.pixel_m,
          window.width,
          window.height,
          std::vector<Colour>(window.width * window.height, Colour{0, 0, 0, 0})};
}

PixelWindow window_of(const RasterGrid& grid, const Box& box) {
  const auto clipped = [](double from, double to, std::size_t size) {
    const auto last = static_cast<double>(size);
    const double low = std::clamp(std::floor(from + kPixelSlack), 0.0, last);
    const double high = std::clamp(std::ceil(to - kPixelSlack), low, last);
    return std::pair{static_cast<std::size_t>(low), static_cast<std::size_t>(high - low)};
  };
  const auto [column, width] = clipped((box.min.x - grid.left_m) / grid.pixel_m,
                                       (box.max.x - grid.left_m) / grid.pixel_m, grid.width);
  const auto [row, height] = clipped((grid.top_m - box.max.y) / grid.pixel_m,
                                     (grid.top_m - box.min.y) / grid.pixel_m, grid.height);
  return {column, row, width, height};
}

Raster read_raster(const std::string& file, const RasterReadOptions& options,
                   const std::optional<Box>& window) {
  const RasterReader reader(file, options);
  const RasterGrid& grid = reader.grid();
  const PixelWindow pixels =
      window ? window_of(grid, *window) : PixelWindow{0, 0, grid.width, grid.height};
  if (pixels.width == 0 || pixels.height == 0) {
    const Box box = grid.box();
    throw InputError(fmt::format(
        "{}: the window does not meet the image, which covers {:.0f} to {:.0f} m east and {:.0f} "
        "to {:.0f} m north of the local origin ({:.0f}, {:.0f})",
        file, box.min.x, box.max.x, box.min.y, box.max.y, grid.frame.origin.x,
        grid.frame.origin.y));
  }
  return reader.read(pixels);
}

}  // namespace plat::geodata
