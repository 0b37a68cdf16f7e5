#include "imagery/carried_image.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/failure.h"
#include "imagery/drawing_windows_internal.h"
#include "imagery/image_warp.h"

namespace plat::imagery {
namespace {

using geodata::Colour;
using geodata::PixelWindow;
using geodata::Raster;
using geodata::RasterGrid;

/// Bilinear samples reach one source pixel further, and a pixel's area further still where the
/// image is made smaller.
double source_margin_m(const RasterGrid& target, const RasterGrid& source) {
  return 2.0 * (source.pixel_m + target.pixel_m);
}

Box box_in_source(const CarriedPiece& piece, const Affine& to_source, double margin_m) {
  Box box;
  for (const Point p : piece.shape.outer) box.add(to_source(p));
  return box.expanded(margin_m);
}

void fill(const Polygon& shape, Colour colour, CoverageCanvas& canvas) {
  const LinearColour light{to_linear(colour.red), to_linear(colour.green), to_linear(colour.blue)};
  for_each_covered_row(shape, canvas.grid(), canvas.window(), [&](const CoveredRow& covered) {
    for (std::size_t i = 0; i < covered.cover.size(); ++i) {
      if (covered.cover[i] != 0)
        canvas.add(covered.column + i, covered.row, light, covered.cover[i]);
    }
  });
}

Raster draw_window(const CarriedInput& input, const std::vector<PixelWindow>& places,
                   const RasterGrid& grid, const PixelWindow& window) {
  CoverageCanvas canvas(grid, window);
  const double margin_m = source_margin_m(grid, input.source->grid());
  for (std::size_t i = 0; i < input.pieces.size(); ++i) {
    if (!detail::meets(places[i], window)) continue;
    const CarriedPiece& piece = input.pieces[i];
    if (const auto* colour = std::get_if<Colour>(&piece.shows)) {
      fill(piece.shape, *colour, canvas);
      continue;
    }
    const Affine& to_source = std::get<Affine>(piece.shows);
    const Raster source = input.source->read(box_in_source(piece, to_source, margin_m));
    if (source.width == 0 || source.height == 0) continue;
    draw_carried(piece.shape, to_source, source, canvas);
  }
  return canvas.over(input.ground(window));
}

std::vector<PixelWindow> windows_of(const CarriedInput& input, const RasterGrid& grid) {
  std::vector<PixelWindow> windows;
  for (const CarriedPiece& piece : input.pieces)
    windows.push_back(geodata::window_of(grid, box_of(piece.shape)));
  return windows;
}

/// A map at the corners of cells about kGroundLattice_m wide that cover a window, bilinear between.
class MapLattice {
 public:
  MapLattice(const PointMap& map, const Box& box) : origin_(box.min) {
    columns_ = cells(box.width()) + 1;
    rows_ = cells(box.height()) + 1;
    for (std::size_t row = 0; row < rows_; ++row) {
      for (std::size_t column = 0; column < columns_; ++column)
        shifts_.push_back(map(corner(column, row)) - corner(column, row));
    }
  }

  [[nodiscard]] Box source_box() const {
    Box box;
    for (std::size_t row = 0; row < rows_; ++row) {
      for (std::size_t column = 0; column < columns_; ++column)
        box.add(corner(column, row) + shift(column, row));
    }
    return box;
  }

  [[nodiscard]] SourcePoint source_of(Point p) const {
    const double x = (p.x - origin_.x) / kGroundLattice_m;
    const double y = (p.y - origin_.y) / kGroundLattice_m;
    const std::size_t column = std::min(static_cast<std::size_t>(std::max(x, 0.0)), columns_ - 2);
    const std::size_t row = std::min(static_cast<std::size_t>(std::max(y, 0.0)), rows_ - 2);
    const double u = x - static_cast<double>(column);
    const double v = y - static_cast<double>(row);
    const Point a = shift(column, row);
    const Point e = shift(column + 1, row) - a;
    const Point f = shift(column, row + 1) - a;
    const Point g = shift(column + 1, row + 1) - a - e - f;
    const Point east = (e + v * g) / kGroundLattice_m;
    const Point north = (f + u * g) / kGroundLattice_m;
    return {p + a + u * e + v * f + u * v * g, Point{1.0, 0.0} + east, Point{0.0, 1.0} + north};
  }

 private:
  static std::size_t cells(double extent_m) {
    return std::max<std::size_t>(1,
                                 static_cast<std::size_t>(std::ceil(extent_m / kGroundLattice_m)));
  }
  [[nodiscard]] Point corner(std::size_t column, std::size_t row) const {
    return origin_ +
           kGroundLattice_m * Point{static_cast<double>(column), static_cast<double>(row)};
  }
  [[nodiscard]] Point shift(std::size_t column, std::size_t row) const {
    return shifts_[row * columns_ + column];
  }

  Point origin_;
  std::size_t columns_ = 0;
  std::size_t rows_ = 0;
  std::vector<Point> shifts_;
};

}  // namespace

GroundPainter carried_ground(const SharedImage& source, PointMap to_source,
                             const RasterGrid& grid) {
  return [&source, to_source = std::move(to_source), grid](const PixelWindow& window) {
    Raster out = geodata::empty_raster(grid, window);
    const Box box = geodata::grid_of(out).box();
    // The lattice is anchored in the plane: its bilinear pieces do not depend on the window.
    const auto down = [](double v) { return std::floor(v / kGroundLattice_m) * kGroundLattice_m; };
    const MapLattice lattice(to_source, {{down(box.min.x), down(box.min.y)}, box.max});
    const Raster pixels =
        source.read(lattice.source_box().expanded(source_margin_m(grid, source.grid())));
    if (pixels.width == 0 || pixels.height == 0) return out;
    for (std::size_t row = 0; row < window.height; ++row) {
      const double y = box.max.y - (static_cast<double>(row) + 0.5) * grid.pixel_m;
      for (std::size_t column = 0; column < window.width; ++column) {
        const double x = box.min.x + (static_cast<double>(column) + 0.5) * grid.pixel_m;
        const SourcePoint at = lattice.source_of({x, y});
        if (!geodata::grid_of(pixels).box().contains(at.at)) continue;
        const Sample sample = sample_area(pixels, at, grid.pixel_m);
        if (sample.weight <= 0.0) continue;
        out.at(column, row) = {to_encoded(sample.colour.red), to_encoded(sample.colour.green),
                               to_encoded(sample.colour.blue), 255};
      }
    }
    return out;
  };
}

GroundPainter over_ground(GroundPainter upper, GroundPainter painter) {
  return [upper = std::move(upper), painter = std::move(painter)](const PixelWindow& window) {
    Raster out = upper(window);
    const auto is_bare = [](const Colour& pixel) { return pixel.alpha == 0; };
    if (std::ranges::none_of(out.pixels, is_bare)) return out;
    const Raster below = painter(window);
    for (std::size_t i = 0; i < out.pixels.size(); ++i) {
      if (is_bare(out.pixels[i])) out.pixels[i] = below.pixels[i];
    }
    return out;
  };
}

Raster draw_carried_image(const CarriedInput& input, const RasterGrid& grid,
                          const PixelWindow& window, Jobs jobs) {
  expects(input.source != nullptr, "there is an image to carry");
  const std::vector<PixelWindow> places = windows_of(input, grid);
  return detail::draw_windows(grid, window, jobs, [&](const PixelWindow& part) {
    return draw_window(input, places, grid, part);
  });
}

void write_carried_image(const std::string& path, const CarriedInput& input, const RasterGrid& grid,
                         const geodata::RasterWriteOptions& options, Jobs jobs,
                         Progress::Style style) {
  expects(input.source != nullptr, "there is an image to carry");
  const std::vector<PixelWindow> places = windows_of(input, grid);
  detail::write_windows(path, grid, options, jobs, style, [&](const PixelWindow& part) {
    return draw_window(input, places, grid, part);
  });
}

}  // namespace plat::imagery
