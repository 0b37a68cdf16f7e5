#include "imagery/image_warp.h"

#include <algorithm>
#include <cmath>

#include "core/failure.h"

namespace plat::imagery {
namespace {

using geodata::Colour;
using geodata::Raster;

/// A map that keeps sizes takes one sample, rounding or not.
constexpr double kSampleRounding = 1e-3;

int samples_along(Point source_pixels) {
  const double count = std::ceil(length(source_pixels) - kSampleRounding);
  return static_cast<int>(std::clamp(count, 1.0, static_cast<double>(kMostSamples)));
}

/// Adds the bilinear sample at (x, y), in pixels from the centre of the upper left one; the image
/// is continued by its border.
void add_bilinear(const Raster& image, double x, double y, Sample& sum) {
  const auto last_column = static_cast<double>(image.width - 1);
  const auto last_row = static_cast<double>(image.height - 1);
  x = std::clamp(x, 0.0, last_column);
  y = std::clamp(y, 0.0, last_row);
  const auto column = static_cast<std::size_t>(x);
  const auto row = static_cast<std::size_t>(y);
  const double right = x - static_cast<double>(column);
  const double down = y - static_cast<double>(row);
  const std::size_t next_column = right > 0.0 ? column + 1 : column;
  const std::size_t next_row = down > 0.0 ? row + 1 : row;
  const auto add = [&](std::size_t c, std::size_t r, double weight) {
    const Colour& pixel = image.at(c, r);
    if (pixel.alpha == 0) return;
    sum.colour.red += weight * to_linear(pixel.red);
    sum.colour.green += weight * to_linear(pixel.green);
    sum.colour.blue += weight * to_linear(pixel.blue);
    sum.weight += weight;
  };
  add(column, row, (1.0 - right) * (1.0 - down));
  if (right > 0.0) add(next_column, row, right * (1.0 - down));
  if (down > 0.0) add(column, next_row, (1.0 - right) * down);
  if (right > 0.0 && down > 0.0) add(next_column, next_row, right * down);
}

/// @param source_of  SourcePoint(Point, std::size_t& guess), the guess kept along a row
template <class SourceOf>
void draw(const Polygon& target, const Raster& source, CoverageCanvas& canvas,
          const SourceOf& source_of) {
  const geodata::RasterGrid& grid = canvas.grid();
  for_each_covered_row(target, grid, canvas.window(), [&](const CoveredRow& covered) {
    std::size_t guess = 0;
    const double y = grid.top_m - (static_cast<double>(covered.row) + 0.5) * grid.pixel_m;
    for (std::size_t i = 0; i < covered.cover.size(); ++i) {
      if (covered.cover[i] == 0) continue;
      const std::size_t column = covered.column + i;
      const double x = grid.left_m + (static_cast<double>(column) + 0.5) * grid.pixel_m;
      const Sample sample = sample_area(source, source_of({x, y}, guess), grid.pixel_m);
      if (sample.weight > 0.0) canvas.add(column, covered.row, sample.colour, covered.cover[i]);
    }
  });
}

}  // namespace

Sample sample_area(const Raster& source, const SourcePoint& at, double pixel_m) {
  // Rows run south: image coordinates mirror the north.
  const double scale = pixel_m / source.pixel_m;
  const Point per_column{scale * at.per_east.x, -scale * at.per_east.y};
  const Point per_row{-scale * at.per_north.x, scale * at.per_north.y};
  const Point centre{(at.at.x - source.left_m) / source.pixel_m - 0.5,
                     (source.top_m - at.at.y) / source.pixel_m - 0.5};
  const int columns = samples_along(per_column);
  const int rows = samples_along(per_row);
  Sample sum;
  for (int j = 0; j < rows; ++j) {
    const double down = (j + 0.5) / rows - 0.5;
    for (int i = 0; i < columns; ++i) {
      const double right = (i + 0.5) / columns - 0.5;
      const Point p = centre + right * per_column + down * per_row;
      add_bilinear(source, p.x, p.y, sum);
    }
  }
  if (sum.weight <= 0.0) return {};
  sum.colour.red /= sum.weight;
  sum.colour.green /= sum.weight;
  sum.colour.blue /= sum.weight;
  sum.weight /= columns * rows;
  return sum;
}

CoverageCanvas::CoverageCanvas(const geodata::RasterGrid& grid, const geodata::PixelWindow& window)
    : grid_(grid), window_(window), pixels_(window.width * window.height) {}

void CoverageCanvas::add(std::size_t column, std::size_t row, const LinearColour& colour,
                         std::uint8_t cover) {
  Light& light = pixels_[(row - window_.row) * window_.width + (column - window_.column)];
  const auto rounded = [](double value) { return static_cast<std::uint32_t>(value + 0.5); };
  light.red += cover * rounded(colour.red);
  light.green += cover * rounded(colour.green);
  light.blue += cover * rounded(colour.blue);
  light.cover += cover;
}

Raster CoverageCanvas::over(const Raster& ground) const {
  expects(ground.width == window_.width && ground.height == window_.height,
          "the ground is drawn on the same window");
  Raster out = ground;
  for (std::size_t i = 0; i < pixels_.size(); ++i) {
    const Light& light = pixels_[i];
    if (light.cover == 0) continue;
    Colour& pixel = out.pixels[i];
    // Ground without data does not mix in; where parcels overlap there is no share left for it.
    const double below =
        pixel.alpha == 0 || light.cover >= kFullCover ? 0.0 : kFullCover - light.cover;
    const double all = light.cover + below;
    const auto mixed = [&](std::uint32_t sum, std::uint8_t under) {
      return to_encoded((sum + below * to_linear(under)) / all);
    };
    pixel = {mixed(light.red, pixel.red), mixed(light.green, pixel.green),
             mixed(light.blue, pixel.blue), 255};
  }
  return out;
}

void draw_parcel(const Polygon& target, const WarpMap& map, const Raster& source,
                 CoverageCanvas& canvas) {
  draw(target, source, canvas,
       [&](Point p, std::size_t& column) { return map.source_of(p, column); });
}

void draw_carried(const Polygon& target, const Affine& to_source, const Raster& source,
                  CoverageCanvas& canvas) {
  draw(target, source, canvas, [&](Point p, std::size_t&) {
    return SourcePoint{to_source(p), {to_source.xx, to_source.yx}, {to_source.xy, to_source.yy}};
  });
}

Box source_box(const WarpGrid& grid, double margin_m) {
  Box box;
  for (const Quad& quad : grid.source) {
    for (const Point p : quad) box.add(p);
  }
  return box.expanded(margin_m);
}

}  // namespace plat::imagery
