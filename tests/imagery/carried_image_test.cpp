#include "imagery/carried_image.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <cmath>
#include <filesystem>

#include "imagery/made_parcels.h"
#include "support/property.h"
#include "support/utm_frame.h"

namespace plat::imagery {
namespace {

using geodata::Colour;
using geodata::PixelWindow;
using geodata::Raster;
using geodata::RasterGrid;
using plat::testing::rectangle;

constexpr double kPixel_m = 0.5;
constexpr Colour kBare{40, 50, 60, 255};

/// A picture of noise, 120 x 80 m from the frame's origin, in a file.
class CarriedImage : public ::testing::Test {
 protected:
  CarriedImage() {
    Rng rng = plat::testing::property_rng("CarriedImage");
    noise_ = {frame_, 0.0, 80.0, kPixel_m, 240, 160, {}};
    noise_.pixels.resize(noise_.width * noise_.height);
    for (Colour& pixel : noise_.pixels) {
      const auto value = [&] { return static_cast<std::uint8_t>(rng.index(256)); };
      pixel = {value(), value(), value(), 255};
    }
    file_ = std::filesystem::temp_directory_path() /
            ("plat_carried_image_" + std::to_string(::getpid()) + ".tif");
    geodata::write_raster(file_.string(), noise_);
    source_ =
        std::make_unique<SharedImage>(file_.string(), geodata::RasterReadOptions{.frame = frame_});
  }
  ~CarriedImage() override { std::filesystem::remove(file_); }

  [[nodiscard]] RasterGrid grid() const { return source_->grid(); }
  [[nodiscard]] Raster draw(std::span<const CarriedPiece> pieces, GroundPainter ground,
                            Jobs jobs = {}) const {
    return draw_carried_image({pieces, source_.get(), std::move(ground)}, grid(),
                              {0, 0, grid().width, grid().height}, jobs);
  }
  [[nodiscard]] GroundPainter bare() const { return plain_ground(grid(), kBare); }

  geodata::LocalFrame frame_ = plat::testing::utm_frame();
  Raster noise_;
  std::filesystem::path file_;
  std::unique_ptr<SharedImage> source_;
};

TEST_F(CarriedImage, PiecesThatDidNotMoveShowTheSourcesPixels) {
  const std::vector<CarriedPiece> pieces{{rectangle(10, 10, 30, 20), Affine{}},
                                         {rectangle(40, 10, 20.3, 20), Affine{}}};
  const auto ground = carried_ground(*source_, [](Point p) { return p; }, grid());
  EXPECT_EQ(draw(pieces, ground).pixels, noise_.pixels);
}

TEST_F(CarriedImage, AShiftByWholePixelsShiftsThePixels) {
  const Point by{7.0 * kPixel_m, -4.0 * kPixel_m};
  const std::vector<CarriedPiece> pieces{
      {rectangle(10.0 + by.x, 20.0 + by.y, 30, 20), Affine::translation(-by)}};
  const Raster image = draw(pieces, bare());
  for (std::size_t row = 0; row < image.height; ++row) {
    for (std::size_t column = 0; column < image.width; ++column) {
      // The piece was at columns 20 to 80 and rows 80 to 120.
      const bool is_inside = column >= 27 && column < 87 && row >= 84 && row < 124;
      ASSERT_EQ(image.at(column, row), is_inside ? noise_.at(column - 7, row - 4) : kBare)
          << column << ' ' << row;
    }
  }
}

TEST_F(CarriedImage, EveryPixelOfAPieceIsFilled) {
  Rng rng = plat::testing::property_rng("CarriedImageFilled");
  for (int i = 0; i < plat::testing::iterations(20); ++i) {
    const Affine map{1.0,
                     rng.uniform(-0.2, 0.2),
                     rng.uniform(-0.2, 0.2),
                     rng.uniform(0.8, 1.2),
                     {rng.uniform(-3, 3), rng.uniform(-3, 3)}};
    const Affine turn = Affine::rotation(rng.uniform(0, 6.28), {60.0, 40.0}) * map;
    const Polygon shape = transformed(turn, rectangle(50, 30, 20, 20));
    const Raster image = draw(std::vector<CarriedPiece>{{shape, *turn.inverse()}},
                              plain_ground(grid(), {0, 0, 0, 0}));
    std::size_t filled = 0;
    for (std::size_t row = 0; row < image.height; ++row) {
      for (std::size_t column = 0; column < image.width; ++column) {
        const Point centre{(static_cast<double>(column) + 0.5) * kPixel_m,
                           80.0 - (static_cast<double>(row) + 0.5) * kPixel_m};
        if (locate(shape, centre) != Side::kInside || boundary_distance_m(shape, centre) < 0.1)
          continue;
        ASSERT_EQ(image.at(column, row).alpha, 255) << column << ' ' << row;
        ++filled;
      }
    }
    EXPECT_GT(filled, 800U);
  }
}

TEST_F(CarriedImage, TheSamePixelsForAnyThreadCountAndWindow) {
  const Affine turn = Affine::rotation(0.3, {60.0, 40.0});
  const std::vector<CarriedPiece> pieces{
      {transformed(turn, rectangle(40, 20, 40, 40)), *turn.inverse()},
      {rectangle(5, 5, 10, 10), Colour{200, 0, 0, 255}}};
  const auto wave = [](Point p) {
    return p + 6.0 * Point{std::sin(p.y / 9.0), std::cos(p.x / 7.0)};
  };
  const auto ground = carried_ground(*source_, wave, grid());
  const Raster whole = draw(pieces, ground, Jobs{1});
  EXPECT_EQ(draw(pieces, ground, Jobs{3}).pixels, whole.pixels);
  const PixelWindow window{33, 41, 57, 29};
  const Raster part = draw_carried_image({pieces, source_.get(), ground}, grid(), window, Jobs{1});
  for (std::size_t row = 0; row < window.height; ++row) {
    for (std::size_t column = 0; column < window.width; ++column)
      ASSERT_EQ(part.at(column, row), whole.at(window.column + column, window.row + row));
  }
}

TEST_F(CarriedImage, GroundGoesWhereItsMapSays) {
  // Linear maps are the lattice's own: the shift is by whole pixels.
  const auto shift = [](Point p) { return p - Point{3.0, 2.0}; };
  const Raster image = draw({}, over_ground(carried_ground(*source_, shift, grid()), bare()));
  for (std::size_t row = 0; row < image.height; ++row) {
    for (std::size_t column = 0; column < image.width; ++column) {
      const bool is_known = column >= 6 && row + 4 < image.height;
      ASSERT_EQ(image.at(column, row), is_known ? noise_.at(column - 6, row + 4) : kBare)
          << column << ' ' << row;
    }
  }
}

TEST_F(CarriedImage, APieceOfOneColourHidesTheGround) {
  const Raster image =
      draw(std::vector<CarriedPiece>{{rectangle(10, 10, 20, 20), Colour{1, 2, 3, 255}}}, bare());
  EXPECT_EQ(image.at(40, 120), (Colour{1, 2, 3, 255}));
  EXPECT_EQ(image.at(10, 120), kBare);
}

}  // namespace
}  // namespace plat::imagery
