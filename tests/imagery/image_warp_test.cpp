#include "imagery/image_warp.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "core/working_grid.h"
#include "imagery/made_parcels.h"
#include "support/property.h"

namespace plat::imagery {
namespace {

using geodata::Colour;
using geodata::PixelWindow;
using geodata::Raster;
using geodata::RasterGrid;
using plat::testing::iterations;
using plat::testing::property_rng;
using plat::testing::rectangle;
using plat::testing::shape;
using plat::testing::strip_parcel;

Raster image(double left_m, double top_m, double pixel_m, std::size_t width, std::size_t height) {
  Raster out{{}, left_m, top_m, pixel_m, width, height, {}};
  out.pixels.resize(width * height);
  return out;
}

Raster noise(Rng& rng, double left_m, double top_m, double pixel_m, std::size_t width,
             std::size_t height) {
  Raster out = image(left_m, top_m, pixel_m, width, height);
  for (Colour& pixel : out.pixels) {
    const auto value = [&] { return static_cast<std::uint8_t>(rng.index(256)); };
    pixel = {value(), value(), value(), 255};
  }
  return out;
}

/// A picture without detail finer than some pixels.
Raster waves(double left_m, double top_m, double pixel_m, std::size_t width, std::size_t height) {
  Raster out = image(left_m, top_m, pixel_m, width, height);
  for (std::size_t r = 0; r < height; ++r) {
    for (std::size_t c = 0; c < width; ++c) {
      const auto wave = [&](double fc, double fr) {
        const double v = std::sin(fc * static_cast<double>(c) + fr * static_cast<double>(r));
        return static_cast<std::uint8_t>(127.5 + 100.0 * v);
      };
      out.at(c, r) = {wave(0.3, 0.1), wave(0.1, 0.4), wave(0.2, -0.2), 255};
    }
  }
  return out;
}

CoverageCanvas canvas_over(const Box& box, double pixel_m) {
  const RasterGrid grid{{},
                        box.min.x,
                        box.max.y,
                        pixel_m,
                        static_cast<std::size_t>(std::ceil(box.width() / pixel_m)),
                        static_cast<std::size_t>(std::ceil(box.height() / pixel_m))};
  return {grid, {0, 0, grid.width, grid.height}};
}

Raster ground_of(const CoverageCanvas& canvas, Colour colour) {
  Raster ground = geodata::empty_raster(canvas.grid(), canvas.window());
  std::fill(ground.pixels.begin(), ground.pixels.end(), colour);
  return ground;
}

WarpMap map_between(const Polygon& source, const Polygon& target,
                    Symmetry symmetry = Symmetry::kKept) {
  return WarpMap(warp_grid(shape(source), shape(target), symmetry));
}

TEST(LinearLight, RoundTripsEveryValueAndHalvesLight) {
  for (int v = 0; v < 256; ++v) EXPECT_EQ(to_encoded(to_linear(static_cast<std::uint8_t>(v))), v);
  EXPECT_EQ(to_encoded(0.5 * (to_linear(0) + to_linear(255))), 188);
}

TEST(PixelCoverage, CountsTheSharesOfAPixel) {
  const RasterGrid grid{{}, 0, 4, 1, 4, 4};
  std::vector<std::vector<std::uint8_t>> rows(4);
  for_each_covered_row(rectangle(0.6, 0.5, 2.25, 2.5), grid, {0, 0, 4, 4}, [&](const auto& row) {
    rows[row.row].assign(row.column, 0);
    rows[row.row].insert(rows[row.row].end(), row.cover.begin(), row.cover.end());
  });
  EXPECT_TRUE(rows[0].empty());
  EXPECT_EQ(rows[1], (std::vector<std::uint8_t>{8, 16, 12}));
  EXPECT_EQ(rows[3], (std::vector<std::uint8_t>{4, 8, 6}));
}

TEST(PixelCoverage, AHoleIsNotCovered) {
  Polygon ring = rectangle(0, 0, 4, 4);
  ring.holes.push_back({{1, 1}, {1, 3}, {3, 3}, {3, 1}});
  int covered = 0;
  for_each_covered_row(ring, {{}, 0, 4, 1, 4, 4}, {0, 0, 4, 4}, [&](const auto& row) {
    covered += std::accumulate(row.cover.begin(), row.cover.end(), 0);
  });
  EXPECT_EQ(covered, 12 * kFullCover);
}

TEST(PixelCoverage, ParcelsThatShareEdgesCoverEveryPixelOnce) {
  Rng rng = property_rng("PixelCoverage.ParcelsThatShareEdgesCoverEveryPixelOnce");
  for (int i = 0; i < iterations(100); ++i) {
    // A fan of triangles and its outline, around a point.
    const Ring outline = strip_parcel(rng).outer;
    const Ring hull = convex_hull(outline);
    const Point middle = snap(centroid({hull, {}}));
    const Box box = box_of(hull).expanded(1.0);
    const RasterGrid grid{{}, box.min.x, box.max.y, 0.7, 200, 200};
    std::vector<int> parts(grid.width * grid.height);
    std::vector<int> whole(parts.size());
    const auto add = [&](const Polygon& polygon, std::vector<int>& sums) {
      for_each_covered_row(polygon, grid, {0, 0, grid.width, grid.height}, [&](const auto& row) {
        for (std::size_t k = 0; k < row.cover.size(); ++k)
          sums[row.row * grid.width + row.column + k] += row.cover[k];
      });
    };
    add({hull, {}}, whole);
    for (std::size_t k = 0; k < hull.size(); ++k)
      add({{hull[k], hull[(k + 1) % hull.size()], middle}, {}}, parts);
    EXPECT_EQ(parts, whole);
    const double covered = std::accumulate(whole.begin(), whole.end(), 0.0) / kFullCover;
    EXPECT_NEAR(covered * 0.49, signed_area_m2(hull), 0.02 * signed_area_m2(hull));
  }
}

TEST(PixelCoverage, WindowsSeeTheSame) {
  Rng rng(3);
  const Polygon parcel = strip_parcel(rng);
  const Box box = box_of(parcel).expanded(1.0);
  const RasterGrid grid{{}, box.min.x, box.max.y, 0.5, 300, 300};
  const auto counts = [&](std::size_t size) {
    std::vector<int> sums(grid.width * grid.height);
    for (std::size_t r = 0; r < 300; r += size) {
      for (std::size_t c = 0; c < 300; c += size) {
        for_each_covered_row(parcel, grid, {c, r, size, size}, [&](const auto& row) {
          for (std::size_t k = 0; k < row.cover.size(); ++k)
            sums[row.row * grid.width + row.column + k] += row.cover[k];
        });
      }
    }
    return sums;
  };
  EXPECT_EQ(counts(300), counts(25));
}

TEST(ImageWarp, TheIdentityReproducesTheSource) {
  Rng rng = property_rng("ImageWarp.TheIdentityReproducesTheSource");
  const Polygon parcel{{{0, 0}, {20, 0}, {20, 12}, {3, 14}}, {}};
  const Raster source = noise(rng, -1, 15, 0.25, 90, 70);
  CoverageCanvas canvas(geodata::grid_of(source), {0, 0, source.width, source.height});
  draw_parcel(parcel, map_between(parcel, parcel), source, canvas);
  const Colour nothing{0, 0, 0, 0};
  const Raster drawn = canvas.over(ground_of(canvas, nothing));
  int same = 0;
  for (std::size_t i = 0; i < drawn.pixels.size(); ++i) {
    if (drawn.pixels[i] == nothing) continue;
    const std::size_t c = i % source.width;
    const Point p{-1 + 0.25 * (static_cast<double>(c) + 0.5),
                  15 - 0.25 * (static_cast<double>(i / source.width) + 0.5)};
    if (boundary_distance_m(parcel, p) < 0.25) continue;
    EXPECT_EQ(drawn.pixels[i], source.pixels[i]);
    ++same;
  }
  EXPECT_GT(same, 3000);
}

TEST(ImageWarp, AMinifiedCheckerboardIsGrey) {
  // Half a pixel aside: the middle of a coarse pixel is the middle of a black or a white one.
  Raster board = image(0.0625, 32.0625, 0.125, 256, 256);
  for (std::size_t i = 0; i < board.pixels.size(); ++i) {
    const std::uint8_t v = (i % 256 + i / 256) % 2 == 0 ? 0 : 255;
    board.pixels[i] = {v, v, v, 255};
  }
  const Polygon source = rectangle(0, 0, 32, 31.9);
  CoverageCanvas canvas = canvas_over({{0, 0}, {32, 32}}, 1.0);  // eight times coarser
  draw_parcel(rectangle(0, 0, 32, 31.9), map_between(source, source), board, canvas);
  const Raster drawn = canvas.over(ground_of(canvas, {9, 9, 9, 255}));
  for (std::size_t r = 1; r + 1 < 32; ++r) {
    for (std::size_t c = 1; c + 1 < 32; ++c) EXPECT_NEAR(drawn.at(c, r).green, 188, 2);
  }
}

/// Root of the mean squared difference in 8-bit steps, over the pixels wholly inside.
double difference_to_supersampling(const Polygon& from, const Polygon& to, const Raster& source,
                                   double pixel_m) {
  const WarpMap map = map_between(from, to);
  CoverageCanvas canvas = canvas_over(box_of(to).expanded(1.0), pixel_m);
  draw_parcel(to, map, source, canvas);
  const Colour nothing{0, 0, 0, 0};
  const Raster drawn = canvas.over(ground_of(canvas, nothing));
  double squares = 0.0;
  int count = 0;
  constexpr int kOracleSamples = 24;
  for (std::size_t i = 0; i < drawn.pixels.size(); ++i) {
    const RasterGrid& grid = canvas.grid();
    const Point corner{grid.left_m + pixel_m * static_cast<double>(i % grid.width),
                       grid.top_m - pixel_m * static_cast<double>(i / grid.width)};
    const Point middle = corner + Point{0.5 * pixel_m, -0.5 * pixel_m};
    if (locate(to, middle) != Side::kInside || boundary_distance_m(to, middle) < pixel_m) continue;
    double light = 0.0;
    for (int s = 0; s < kOracleSamples * kOracleSamples; ++s) {
      const Point p = corner + Point{pixel_m * (s % kOracleSamples + 0.5) / kOracleSamples,
                                     -pixel_m * (s / kOracleSamples + 0.5) / kOracleSamples};
      const SourcePoint at{map.source_of(p).at, {}, {}};
      light += sample_area(source, at, pixel_m).colour.green;  // no Jacobian: one sample
    }
    const double expected = to_encoded(light / (kOracleSamples * kOracleSamples));
    squares += std::pow(expected - drawn.pixels[i].green, 2);
    ++count;
  }
  EXPECT_GT(count, 30);
  return std::sqrt(squares / count);
}

TEST(ImageWarp, AgreesWithBruteForceSupersampling) {
  Rng rng = property_rng("ImageWarp.AgreesWithBruteForceSupersampling");
  for (int i = 0; i < iterations(6); ++i) {
    const Polygon from = strip_parcel(rng);
    const Polygon to = strip_parcel(rng);
    const Box box = box_of(from).expanded(3.0);
    const auto size = [](double m) { return static_cast<std::size_t>(m / 0.25); };
    const Raster source = waves(box.min.x, box.max.y, 0.25, size(box.width()), size(box.height()));
    // Of 256 steps: kernels differ where the image is enlarged, maps where they bend in a pixel.
    EXPECT_LT(difference_to_supersampling(from, to, source, 0.5), 6.0);
    EXPECT_LT(difference_to_supersampling(from, to, source, 1.0), 6.0);
  }
}

TEST(ImageWarp, LeavesNoPixelOfAParcelUnfilled) {
  Rng rng = property_rng("ImageWarp.LeavesNoPixelOfAParcelUnfilled");
  for (int i = 0; i < iterations(40); ++i) {
    const Polygon from = plat::testing::any_parcel(rng);
    const Polygon to = plat::testing::any_parcel(rng);
    const Box box = box_of(from).expanded(60.0);
    Raster source = image(box.min.x, box.max.y, 1.0, static_cast<std::size_t>(box.width()),
                          static_cast<std::size_t>(box.height()));
    std::fill(source.pixels.begin(), source.pixels.end(), Colour{200, 100, 50, 255});
    CoverageCanvas canvas = canvas_over(box_of(to).expanded(1.0), 0.5);
    draw_parcel(to, map_between(from, to), source, canvas);
    const Colour hole{0, 0, 0, 255};
    const Raster drawn = canvas.over(ground_of(canvas, hole));
    for_each_covered_row(to, canvas.grid(), canvas.window(), [&](const CoveredRow& row) {
      for (std::size_t k = 0; k < row.cover.size(); ++k) {
        if (row.cover[k] != kFullCover) continue;
        EXPECT_EQ(drawn.at(row.column + k, row.row), (Colour{200, 100, 50, 255}));
      }
    });
  }
}

TEST(CoverageCanvas, NeighboursShareAPixelWithoutGround) {
  CoverageCanvas canvas = canvas_over({{0, 0}, {1, 1}}, 1.0);
  canvas.add(0, 0, {to_linear(255), 0, 0}, 6);
  canvas.add(0, 0, {0, to_linear(255), 0}, 10);
  const Colour mixed = canvas.over(ground_of(canvas, {0, 0, 255, 255})).at(0, 0);
  EXPECT_EQ(mixed.red, to_encoded(to_linear(255) * 6 / 16));
  EXPECT_EQ(mixed.green, to_encoded(to_linear(255) * 10 / 16));
  EXPECT_EQ(mixed.blue, 0);
}

TEST(CoverageCanvas, OverlapsShareThePixelInAnyOrder) {
  CoverageCanvas one = canvas_over({{0, 0}, {1, 1}}, 1.0);
  CoverageCanvas other = canvas_over({{0, 0}, {1, 1}}, 1.0);
  const LinearColour a{to_linear(255), 100, 7};
  const LinearColour b{0, to_linear(255), 9};
  one.add(0, 0, a, 16);
  one.add(0, 0, b, 16);
  other.add(0, 0, b, 16);
  other.add(0, 0, a, 16);
  const Raster ground = ground_of(one, {0, 0, 255, 255});
  EXPECT_EQ(one.over(ground).at(0, 0), other.over(ground).at(0, 0));
  EXPECT_EQ(one.over(ground).at(0, 0).red, 188);
}

TEST(ImageWarp, PixelsWithoutDataDoNotMixIn) {
  Raster source = image(0, 2, 1, 2, 2);
  source.pixels = {{255, 0, 0, 255}, {0, 0, 0, 0}, {255, 0, 0, 255}, {0, 0, 0, 0}};
  const Sample sample = sample_area(source, {{1.0, 1.0}, {1, 0}, {0, 1}}, 1.0);
  EXPECT_EQ(to_encoded(sample.colour.red), 255);
  EXPECT_NEAR(sample.weight, 0.5, 1e-12);
}

}  // namespace
}  // namespace plat::imagery
