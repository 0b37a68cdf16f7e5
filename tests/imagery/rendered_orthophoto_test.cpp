#include "imagery/rendered_orthophoto.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "geodata/scratch_folder.h"
#include "imagery/map_reader.h"
#include "imagery/plot.h"
#include "imagery/shadows.h"
#include "streets/network_cleaning.h"
#include "support/data_folder.h"

namespace plat::imagery {
namespace {

using geodata::Colour;
using geodata::Raster;

constexpr double kDegree = std::numbers::pi / 180.0;

Polygon box(double x, double y, double width, double height) {
  return {{{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}}, {}};
}

/// Two streets that cross, twelve plots with houses, a pond and a park.
MapLayers village() {
  MapLayers map;
  std::vector<streets::RawStreet> raw{{"a", {{-20, 0}, {140, 0}}, {}},
                                      {"b", {{60, -70}, {60, 90}}, {}}};
  map.streets = streets::build_network(raw).network;
  for (streets::Street& street : map.streets.streets) street.width_m = 12.0;
  for (const double y : {6.0, -36.0}) {
    for (const double x : {-18.0, 6.0, 30.0, 66.0, 90.0, 114.0}) {
      map.parcels.push_back(box(x, y, 24, 30));
      map.footprints.push_back({box(x + 5, y + 8, 11, 12), 7.0, HeightSource::kAttribute});
    }
  }
  map.water.push_back(box(-20, 40, 70, 40));
  map.open_space.push_back(box(70, 40, 70, 40));
  return map;
}

const Box kVillage{{-22, -60}, {142, 84}};

/// Mean colour of the pixels of a box.
struct Mean {
  double red = 0.0, green = 0.0, blue = 0.0;
  [[nodiscard]] double light() const { return (red + green + blue) / 3.0; }
};
Mean mean_of(const Raster& raster, const Box& where) {
  const geodata::PixelWindow window = geodata::window_of(geodata::grid_of(raster), where);
  EXPECT_GT(window.width * window.height, 0U);
  Mean sum;
  for (std::size_t r = 0; r < window.height; ++r) {
    for (std::size_t c = 0; c < window.width; ++c) {
      const Colour colour = raster.at(window.column + c, window.row + r);
      sum.red += colour.red;
      sum.green += colour.green;
      sum.blue += colour.blue;
    }
  }
  const auto count = static_cast<double>(window.width * window.height);
  return {sum.red / count, sum.green / count, sum.blue / count};
}

bool same_pixels(const Raster& a, const Raster& b) {
  return geodata::grid_of(a) == geodata::grid_of(b) && a.pixels == b.pixels;
}

TEST(RenderedOrthophoto, HasTheSamePixelsForAnyTilesAndThreads) {
  const MapLayers map = village();
  const Raster expected = RenderedOrthophoto(map, {.tile_px = 4096}, 3).render(kVillage);
  for (const std::size_t tile : {64U, 100U, 333U}) {
    const RenderedOrthophoto picture(map, {.tile_px = tile}, 3);
    for (const int jobs : {1, 2})
      EXPECT_TRUE(same_pixels(picture.render(kVillage, {jobs}), expected)) << tile;
  }
}

TEST(RenderedOrthophoto, HasNoSeamsWhereverTheSunStands) {
  const MapLayers map = village();
  for (const double azimuth : {10.0, 80.0, 100.0, 170.0, 225.0, 300.0}) {
    OrthophotoOptions options;
    options.sun_azimuth_rad = azimuth * kDegree;
    options.sun_elevation_rad = 20.0 * kDegree;
    const Raster whole = RenderedOrthophoto(map, options, 3).render(kVillage);
    options.tile_px = 90;
    EXPECT_TRUE(same_pixels(RenderedOrthophoto(map, options, 3).render(kVillage), whole))
        << azimuth;
  }
}

TEST(RenderedOrthophoto, ShowsInAWindowWhatTheWholeShows) {
  const RenderedOrthophoto picture(village(), {}, 3);
  const Raster whole = picture.render(kVillage);
  const Raster part = picture.render({{10.1, -20.3}, {57.9, 30.2}});
  const auto column = static_cast<std::size_t>((part.left_m - whole.left_m) / 0.25);
  const auto row = static_cast<std::size_t>((whole.top_m - part.top_m) / 0.25);
  ASSERT_GT(part.width, 180U);
  for (std::size_t r = 0; r < part.height; ++r) {
    for (std::size_t c = 0; c < part.width; ++c)
      ASSERT_EQ(part.at(c, r), whole.at(column + c, row + r)) << c << " " << r;
  }
}

TEST(RenderedOrthophoto, OfASeedIsOneFileThatSaysItIsRendered) {
  const testing::ScratchFolder folder;
  const MapLayers map = village();
  const auto write = [&](const std::string& name, std::size_t tile, std::uint64_t seed, int jobs) {
    RenderedOrthophoto(map, {.tile_px = tile}, seed).write(folder.file(name), kVillage, {jobs});
    return testing::bytes_of(folder.file(name));
  };
  const std::string bytes = write("a.tif", 1024, 3, 1);
  EXPECT_TRUE(write("b.tif", 200, 3, 2) == bytes);
  EXPECT_FALSE(write("c.tif", 1024, 4, 1) == bytes);
  EXPECT_NE(bytes.find("rendered by plat from map layers, not a photograph"), std::string::npos);
}

TEST(RenderedOrthophoto, ShowsEachClassInItsColours) {
  const Raster picture = RenderedOrthophoto(village(), {}, 3).render(kVillage);
  const Mean water = mean_of(picture, {{-10, 45}, {40, 75}});
  EXPECT_GT(water.blue, 1.05 * water.red);
  EXPECT_LT(water.light(), 90.0);
  const Mean park = mean_of(picture, {{75, 45}, {135, 75}});
  EXPECT_GT(park.green, 1.1 * park.red);
  EXPECT_GT(park.green, 1.3 * park.blue);
  const Mean crossing = mean_of(picture, {{58, -2}, {62, 2}});
  EXPECT_NEAR(crossing.red, crossing.blue, 12.0);
  EXPECT_NEAR(crossing.light(), 115.0, 30.0);
}

TEST(RenderedOrthophoto, TellsNeighbouringParcelsApart) {
  const MapLayers map = village();
  const Raster picture = RenderedOrthophoto(map, {}, 3).render(kVillage);
  // The nine metres that no house stands on.
  const auto garden = [](const Polygon& parcel) {
    const Box all = plat::box_of(parcel);
    return Box{{all.min.x, all.max.y - 9.0}, all.max};
  };
  int different = 0;
  int pairs = 0;
  for (std::size_t i = 0; i + 1 < map.parcels.size(); ++i) {
    if (i == 2 || i == 5 || i == 8) continue;  // not neighbours
    const Mean a = mean_of(picture, garden(map.parcels[i]));
    const Mean b = mean_of(picture, garden(map.parcels[i + 1]));
    ++pairs;
    different += std::hypot(a.red - b.red, a.green - b.green, a.blue - b.blue) > 4.0 ? 1 : 0;
  }
  EXPECT_EQ(pairs, 8);
  EXPECT_GE(different, 7);
}

/// A hall on bare ground.
struct Hall {
  MapLayers map;
  Point center{0, 0};
  explicit Hall(double height_m) {
    map.footprints.push_back({box(-20, -20, 40, 40), height_m, HeightSource::kAttribute});
  }
};

TEST(RenderedOrthophoto, ThrowsShadowsAwayFromTheSun) {
  const Hall hall(12.0);
  for (const double azimuth : {0.0, 50.0, 90.0, 140.0, 180.0, 215.0, 270.0, 330.0}) {
    OrthophotoOptions options;
    options.sun_azimuth_rad = azimuth * kDegree;
    options.sun_elevation_rad = 45.0 * kDegree;
    const Raster picture = RenderedOrthophoto(hall.map, options, 1).render({{-70, -70}, {70, 70}});
    const Point to_sun{std::sin(azimuth * kDegree), std::cos(azimuth * kDegree)};
    // 4 m beyond the wall that the direction leaves the hall by.
    const double reach = 20.0 / std::max(std::abs(to_sun.x), std::abs(to_sun.y)) + 4.0;
    const auto light = [&](Point p) { return mean_of(picture, Box{p, p}.expanded(1.2)).light(); };
    EXPECT_LT(light(-reach * to_sun), 0.65 * light(reach * to_sun)) << azimuth;
  }
}

/// How far the shadow reaches north of the hall, metres.
double shadow_m(double height_m, double elevation_deg) {
  OrthophotoOptions options;
  options.sun_azimuth_rad = 180.0 * kDegree;
  options.sun_elevation_rad = elevation_deg * kDegree;
  const Hall hall(height_m);
  const Raster picture = RenderedOrthophoto(hall.map, options, 1).render({{-70, -70}, {70, 120}});
  const double lit = mean_of(picture, {{-10, 90}, {10, 110}}).light();
  double end = 0.0;
  for (double y = 20.5; y < 110.0; y += 0.5) {
    if (mean_of(picture, {{-8, y}, {8, y + 0.5}}).light() > 0.75 * lit) break;
    end = y + 0.5 - 20.0;
  }
  return end;
}

TEST(RenderedOrthophoto, ThrowsShadowsAsLongAsTheHeightSays) {
  for (const double height : {6.0, 12.0, 30.0}) {
    for (const double elevation : {30.0, 45.0, 60.0}) {
      // The parapet stands half a metre above the roof.
      const double expected = (height + 0.5) / std::tan(elevation * kDegree);
      EXPECT_NEAR(shadow_m(height, elevation), expected, 1.3) << height << " m " << elevation;
    }
  }
}

TEST(CastShadows, DarkensNothingThatIsHigherThanItsSurroundings) {
  Canvas canvas({0, 0, 40, 40}, 0.25);
  for (std::size_t i = 0; i < canvas.colour.size(); ++i) {
    canvas.colour[i] = {0.5F, 0.5F, 0.5F};
    const std::size_t x = i % 40;
    const std::size_t y = i / 40;
    if (x >= 10 && x < 30 && y >= 10 && y < 30) canvas.height_m[i] = x < 20 ? 2.0F : 5.0F;
  }
  cast_shadows(canvas, {90.0 * kDegree, 45.0 * kDegree});  // the sun in the east
  const auto red = [&](std::size_t x, std::size_t y) { return canvas.colour[y * 40 + x].red; };
  EXPECT_EQ(red(25, 20), 0.5F) << "the higher roof";
  EXPECT_LT(red(18, 20), 0.3F) << "the lower roof, under the higher wall";
  EXPECT_EQ(red(34, 20), 0.5F) << "the sunny side";
  EXPECT_LT(red(4, 20), 0.3F) << "the ground behind";
}

TEST(AssumedHouses, StandOnTheirParcelsAndOnlyWhereTheMapHasNone) {
  MapLayers map = village();
  EXPECT_EQ(RenderedOrthophoto(map, {}, 3).assumed_footprints(), 0U);
  map.footprints.clear();
  EXPECT_GE(RenderedOrthophoto(map, {}, 3).assumed_footprints(), 12U);
  EXPECT_EQ(RenderedOrthophoto(map, {.missing = MissingFootprints::kLeave}, 3).assumed_footprints(),
            0U);
  // Plots that no box fills: the first try never fits.
  map.parcels.push_back({{{150, 6}, {176, 6}, {150, 40}}, {}});
  map.parcels.push_back({{{180, 6}, {204, 40}, {180, 40}}, {}});
  map.parcels.push_back({{{210, 6}, {216, 6}, {216, 30}, {236, 30}, {236, 40}, {210, 40}}, {}});
  std::vector<Plot> plots = make_plots(map);
  assume_houses(plots, 3);
  ASSERT_EQ(plots.size(), 15U);
  std::size_t houses = 0;
  for (const Plot& plot : plots) {
    EXPECT_TRUE(plot.has_front);
    houses += plot.buildings.size();
    for (const Footprint& building : plot.buildings) {
      EXPECT_EQ(building.height_source, HeightSource::kAssumed);
      for (const Point p : building.shape.outer) EXPECT_NE(locate(plot.shape, p), Side::kOutside);
    }
  }
  EXPECT_GE(houses, 14U);
}

TEST(RenderedOrthophoto, OfCambridgeHasNoSeams) {
  PLAT_REAL_DATA_OR_SKIP(path, "cambridge_ma/cambridge_ma.gpkg");
  const MapLayers map = read_map(map_sources_in(path));
  const Point middle = plat::box_of(map.parcels[6000]).center();
  const Box window = Box{middle, middle}.expanded(90.0);
  const Raster whole = RenderedOrthophoto(map, {.tile_px = 2048}, 1).render(window);
  const Raster tiles = RenderedOrthophoto(map, {.tile_px = 128}, 1).render(window);
  EXPECT_TRUE(same_pixels(whole, tiles));
}

}  // namespace
}  // namespace plat::imagery
