#include "geodata/raster_io.h"

#include <gdal_priv.h>
#include <gmock/gmock.h>
#include <ogr_spatialref.h>

#include <array>
#include <filesystem>
#include <functional>

#include "core/failure.h"
#include "core/rng.h"
#include "geodata/layer_io.h"
#include "geodata/scratch_folder.h"
#include "support/data_folder.h"

namespace plat::geodata {
namespace {

using ::plat::testing::bytes_of;
using ::plat::testing::ScratchFolder;
using ::testing::HasSubstr;

std::string wkt_of_epsg(int code) {
  OGRSpatialReference reference;
  reference.importFromEPSG(code);
  char* text = nullptr;
  const char* const options[] = {"FORMAT=WKT2_2019", nullptr};
  reference.exportToWkt(&text, options);
  const std::string out = text;
  CPLFree(text);
  return out;
}

constexpr Colour kNothing{0, 0, 0, 0};

/// Every pixel differs from its neighbours; larger than a tile of the file in both directions.
Raster speckled(std::size_t width = 700, std::size_t height = 530) {
  Raster out{{wkt_of_epsg(32633), {458000.0, 5550000.0}}, -12.5, 340.0, 0.25, width, height, {}};
  Rng rng(7);
  for (std::size_t i = 0; i < width * height; ++i) {
    const std::uint64_t bits = rng();
    out.pixels.push_back({static_cast<std::uint8_t>(bits), static_cast<std::uint8_t>(bits >> 8U),
                          static_cast<std::uint8_t>(bits >> 16U), 255});
  }
  return out;
}

/// An image by GDAL itself: `value(band, column, row)`, any type and placement.
struct Foreign {
  int width = 40;
  int height = 30;
  int bands = 3;
  GDALDataType type = GDT_Byte;
  std::array<double, 6> placement{458000.0, 0.5, 0.0, 5550000.0, 0.0, -0.5};
  bool has_placement = true;
  int epsg = 32633;
  std::optional<double> nodata{};
  std::function<int(int, int, int)> value = [](int, int, int) { return 100; };

  std::string write(const std::string& path) const {
    GDALAllRegister();
    GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("GTiff");
    const GDALDatasetUniquePtr data(
        driver->Create(path.c_str(), width, height, bands, type, nullptr));
    std::array<double, 6> place = placement;
    if (has_placement) data->SetGeoTransform(place.data());
    if (epsg != 0) {
      OGRSpatialReference reference;
      reference.importFromEPSG(epsg);
      data->SetSpatialRef(&reference);
    }
    for (int b = 1; b <= bands; ++b) {
      if (nodata) data->GetRasterBand(b)->SetNoDataValue(*nodata);
      for (int row = 0; row < height; ++row) {
        for (int column = 0; column < width; ++column) {
          int v = value(b, column, row);
          EXPECT_EQ(data->GetRasterBand(b)->RasterIO(GF_Write, column, row, 1, 1, &v, 1, 1,
                                                     GDT_Int32, 0, 0, nullptr),
                    CE_None);
        }
      }
    }
    return path;
  }
};

std::string refusal(const std::function<void()>& act) {
  try {
    act();
  } catch (const InputError& error) {
    return error.what();
  }
  return "not refused";
}

TEST(RasterIo, ReadsBackWhatItWrote) {
  const ScratchFolder folder;
  Raster raster = speckled();
  for (const bool is_opaque : {true, false}) {
    if (!is_opaque) raster.at(3, 5) = kNothing;
    write_raster(folder.file("a.tif"), raster, "a test");
    const Raster again = read_raster(folder.file("a.tif"), {.frame = raster.frame});
    EXPECT_EQ(grid_of(again), grid_of(raster));
    EXPECT_TRUE(again.pixels == raster.pixels) << "opaque: " << is_opaque;
  }
}

TEST(RasterIo, ReadsAWindowOfIt) {
  const ScratchFolder folder;
  const Raster raster = speckled();
  write_raster(folder.file("a.tif"), raster);
  // The box touches columns 100 to 110 and rows 20 to 39.
  const Box box{{-12.5 + 25.1, 340.0 - 10.0}, {-12.5 + 27.6, 340.0 - 5.0}};
  const Raster part = read_raster(folder.file("a.tif"), {.frame = raster.frame}, box);
  ASSERT_EQ(part.width, 11U);
  ASSERT_EQ(part.height, 20U);
  EXPECT_EQ(part.left_m, -12.5 + 25.0);
  EXPECT_EQ(part.top_m, 335.0);
  EXPECT_EQ(part.at(0, 0), raster.at(100, 20));
  EXPECT_EQ(part.at(10, 19), raster.at(110, 39));
  const Box beyond{{1000, 1000}, {1010, 1010}};
  const std::string message =
      refusal([&] { (void)read_raster(folder.file("a.tif"), {.frame = raster.frame}, beyond); });
  EXPECT_THAT(message, HasSubstr("does not meet"));
}

TEST(RasterWriter, GivesTheSameBytesHoweverRowsAreDivided) {
  const ScratchFolder folder;
  const Raster raster = speckled();
  write_raster(folder.file("whole.tif"), raster);
  for (const std::size_t rows : {1U, 100U, 256U, 300U}) {
    RasterWriter writer(folder.file("strips.tif"), grid_of(raster),
                        {.bands = RasterBands::kOpaque});
    for (std::size_t row = 0; row < raster.height; row += rows) {
      const std::size_t count = std::min(rows, raster.height - row);
      Raster strip = empty_raster(grid_of(raster), {0, row, raster.width, count});
      const auto first = raster.pixels.begin() + static_cast<std::ptrdiff_t>(row * raster.width);
      std::copy_n(first, count * raster.width, strip.pixels.begin());
      writer.write(strip);
    }
    writer.finish();
    EXPECT_TRUE(bytes_of(folder.file("strips.tif")) == bytes_of(folder.file("whole.tif"))) << rows;
  }
}

TEST(RasterWriter, SaysWhatItIsAndHasOverviews) {
  const ScratchFolder folder;
  const Raster raster = speckled(1400, 600);
  write_raster(folder.file("a.tif"), raster, "rendered, not a photograph");
  const GDALDatasetUniquePtr data(GDALDataset::Open(folder.file("a.tif").c_str()));
  ASSERT_NE(data, nullptr);
  EXPECT_STREQ(data->GetMetadataItem("TIFFTAG_IMAGEDESCRIPTION"), "rendered, not a photograph");
  EXPECT_EQ(data->GetRasterBand(1)->GetOverviewCount(), 2);
  std::array<double, 6> placement{};
  data->GetGeoTransform(placement.data());
  const std::array<double, 6> expected{457987.5, 0.25, 0.0, 5550340.0, 0.0, -0.25};
  EXPECT_EQ(placement, expected);
  EXPECT_STREQ(data->GetSpatialRef()->GetAuthorityCode(nullptr), "32633");
}

TEST(RasterWriter, LeavesNothingBehindUntilItIsFinished) {
  const ScratchFolder folder;
  const std::string path = folder.file("a.tif");
  {
    RasterWriter writer(path, grid_of(speckled()));
    writer.write(speckled());
    EXPECT_FALSE(std::filesystem::exists(path));
  }
  EXPECT_TRUE(std::filesystem::is_empty(std::filesystem::path(path).parent_path()));
}

TEST(RasterWriter, RefusesAPathThatCannotBeWritten) {
  const ScratchFolder folder;
  const Raster raster = speckled(4, 4);
  EXPECT_THAT(refusal([&] { write_raster(folder.file("none/a.tif"), raster); }),
              HasSubstr("cannot be written"));
  EXPECT_THAT(refusal([&] { write_raster(folder.file("a.png"), raster); }), HasSubstr(".tif"));
}

TEST(RasterReader, RefusesWhatIsNoImageWithAPlace) {
  const ScratchFolder folder;
  const auto message = [&](const std::string& path) {
    return refusal([&] { const RasterReader reader(path); });
  };
  EXPECT_THAT(message(folder.file("none.tif")), HasSubstr("no such file"));
  EXPECT_THAT(message(folder.write("a.tif", "no image")), HasSubstr("not an image"));
  EXPECT_THAT(message(Foreign{.has_placement = false}.write(folder.file("b.tif"))),
              HasSubstr("no geotransform"));
  EXPECT_THAT(message(Foreign{.epsg = 0}.write(folder.file("c.tif"))),
              HasSubstr("gdal_edit.py -a_srs"));
  EXPECT_THAT(message(Foreign{.bands = 5}.write(folder.file("d.tif"))), HasSubstr("5 bands"));
  EXPECT_THAT(message(Foreign{.type = GDT_Float32}.write(folder.file("e.tif"))),
              HasSubstr("Float32"));
}

TEST(RasterReader, ShowsOneBandAsGrey) {
  const ScratchFolder folder;
  const Foreign grey{.bands = 1, .value = [](int, int column, int) { return 3 * column; }};
  const Raster raster = read_raster(grey.write(folder.file("a.tif")));
  EXPECT_EQ(raster.at(10, 4), (Colour{30, 30, 30, 255}));
}

TEST(RasterReader, ScalesSixteenBitsByTheLargestValue) {
  const ScratchFolder folder;
  const Foreign deep{.type = GDT_UInt16, .value = [](int band, int column, int) {
                       return column == 0 ? 0 : 500 * band;
                     }};
  const Raster raster = read_raster(deep.write(folder.file("a.tif")));
  EXPECT_EQ(raster.at(5, 5), (Colour{85, 170, 255, 255}));
  EXPECT_EQ(raster.at(0, 5), (Colour{0, 0, 0, 255}));
}

TEST(RasterReader, MakesPixelsWithoutDataTransparent) {
  const ScratchFolder folder;
  const Foreign holed{.nodata = 0.0, .value = [](int band, int column, int) {
                        return column < 8 ? 0 : (column < 16 && band == 1 ? 0 : 90);
                      }};
  const std::string path = holed.write(folder.file("a.tif"));
  const Raster raster = read_raster(path);
  EXPECT_EQ(raster.at(2, 2).alpha, 0) << "every band";
  EXPECT_EQ(raster.at(12, 2).alpha, 255) << "one band only";
  EXPECT_EQ(raster.at(20, 2), (Colour{90, 90, 90, 255}));
  const Raster warped = read_raster(path, {.pixel_m = 0.4});
  EXPECT_EQ(warped.at(2, 2).alpha, 0);
  EXPECT_EQ(warped.at(35, 20), (Colour{90, 90, 90, 255}));
}

TEST(RasterReader, TurnsARotatedImageNorthUp) {
  const ScratchFolder folder;
  // Columns run north-east, rows south-east, 0.5 m each; the right half is bright.
  const double step = 0.5 / std::sqrt(2.0);
  const Foreign turned{.placement = {458100.0, step, step, 5550100.0, step, -step},
                       .value = [](int, int column, int) { return column < 20 ? 40 : 200; }};
  const Raster raster = read_raster(turned.write(folder.file("a.tif")));
  EXPECT_NEAR(raster.pixel_m, 0.5, 0.1);
  const auto colour_at = [&](double column, double row) {
    const double x = 458100.0 + step * (column + row) - raster.frame.origin.x;
    const double y = 5550100.0 + step * (column - row) - raster.frame.origin.y;
    return raster.at(static_cast<std::size_t>((x - raster.left_m) / raster.pixel_m),
                     static_cast<std::size_t>((raster.top_m - y) / raster.pixel_m));
  };
  EXPECT_EQ(colour_at(5, 15), (Colour{40, 40, 40, 255}));
  EXPECT_EQ(colour_at(35, 15), (Colour{200, 200, 200, 255}));
  EXPECT_EQ(colour_at(-3, 15).alpha, 0) << "beside the image";
}

TEST(RasterReader, GivesTheSamePixelsInAnyWindows) {
  const ScratchFolder folder;
  const Foreign degrees{.width = 900,
                        .height = 700,
                        .placement = {14.42, 3e-6, 0.0, 50.1, 0.0, -2.5e-6},
                        .epsg = 4326,
                        .value = [](int b, int c, int r) { return (7 * c + 13 * r * b) % 251; }};
  const RasterReader reader(degrees.write(folder.file("a.tif")));
  const RasterGrid& grid = reader.grid();
  const Raster whole = reader.read({0, 0, grid.width, grid.height});
  const std::size_t size = 130;
  for (std::size_t row = 0; row + size < grid.height; row += size) {
    for (std::size_t column = 0; column + size < grid.width; column += size) {
      const Raster part = reader.read({column, row, size, size});
      for (std::size_t i = 0; i < size * size; ++i)
        ASSERT_EQ(part.pixels[i], whole.at(column + i % size, row + i / size));
    }
  }
}

class LasVegas : public ::testing::Test {
 protected:
  static double brightness(Colour c) { return (c.red + c.green + c.blue) / 3.0; }

  /// Mean along the street lines, moved by `shift`.
  static double along_streets(const Raster& image, const Layer& streets, Point shift) {
    double sum = 0.0;
    double count = 0.0;
    for (const Feature& feature : streets.features) {
      for (const Polyline& line : feature.lines) {
        for (std::size_t i = 0; i + 1 < line.size(); ++i) {
          for (double t = 0.0; t < 1.0; t += 0.02) {
            const Point p = lerp(line[i], line[i + 1], t) + shift;
            if (!image.box().expanded(-2.0).contains(p)) continue;
            const PixelWindow pixel = window_of(grid_of(image), {p, p + Point{0.01, 0.01}});
            const double weight = distance(line[i], line[i + 1]);
            sum += weight * brightness(image.at(pixel.column, pixel.row));
            count += weight;
          }
        }
      }
    }
    return sum / count;
  }
};

TEST_F(LasVegas, ArrivesInMetresWhereItsCornersAre) {
  PLAT_REAL_DATA_OR_SKIP(path, "las_vegas_us/RGB-PanSharpen_AOI_2_Vegas_img0.tif");
  const Raster image = read_raster(path);
  EXPECT_THAT(image.frame.crs_wkt, HasSubstr("UTM zone 11N"));
  // gdaltransform of gdalinfo's upper left and lower right corner.
  const Box box = image.box();
  const Point origin = image.frame.origin;
  EXPECT_NEAR(box.min.x + origin.x, 664383.15 - 8.0, 9.0) << "the image is turned by a degree";
  EXPECT_NEAR(box.max.y + origin.y, 4012188.72, 9.0);
  EXPECT_NEAR(box.max.x + origin.x, 664705.95, 9.0);
  EXPECT_NEAR(box.min.y + origin.y, 4011805.30, 9.0);
  EXPECT_GT(image.pixel_m, 0.24);
  EXPECT_LT(image.pixel_m, 0.30);
}

TEST_F(LasVegas, HasItsAsphaltUnderItsStreetLines) {
  PLAT_REAL_DATA_OR_SKIP(path, "las_vegas_us/RGB-PanSharpen_AOI_2_Vegas_img0.tif");
  const Raster image = read_raster(path);
  const Layer streets = read_layer(
      {testing::data_file("las_vegas_us/AOI_2_Vegas_img0_roads.geojson").value_or(""), {}},
      {.frame = image.frame, .kind = GeometryKind::kLine});
  const double here = along_streets(image, streets, {});
  for (const Point shift : {Point{0, 15}, Point{0, -15}, Point{15, 15}, Point{-15, -15}})
    EXPECT_LT(1.2 * here, along_streets(image, streets, shift)) << shift.x << " " << shift.y;
}

}  // namespace
}  // namespace plat::geodata
