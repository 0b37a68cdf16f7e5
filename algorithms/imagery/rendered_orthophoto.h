#pragma once

#include <cstdint>
#include <memory>
#include <numbers>
#include <string>
#include <tuple>

#include "core/options.h"
#include "core/parallel.h"
#include "core/progress.h"
#include "geodata/raster_io.h"
#include "imagery/map_layers.h"
#include "imagery/map_scene.h"

namespace plat::imagery {

/// What a rendered picture says of itself, in the TIFF's description.
inline constexpr std::string_view kRenderedDescription =
    "rendered by plat from map layers, not a photograph";

struct OrthophotoOptions {
  double pixel_m = 0.25;  ///< side of a pixel on the ground, metres
  double sun_azimuth_rad = 160.0 * std::numbers::pi / 180.0;   ///< clockwise from north
  double sun_elevation_rad = 48.0 * std::numbers::pi / 180.0;  ///< above the horizon
  Climate climate = Climate::kTemperate;
  RoofStyle roofs = RoofStyle::kShingle;
  MissingFootprints missing = MissingFootprints::kAssume;
  std::size_t tile_px = 1024;  ///< side of the tiles that are painted at once; changes no pixel

  static constexpr auto fields() {
    using O = OrthophotoOptions;
    return std::tuple{
        Field{"pixel_m", &O::pixel_m, 0.05, 5.0, "side of a pixel on the ground, metres"},
        Field{"sun_azimuth_rad", &O::sun_azimuth_rad, 0.0, 2.0 * std::numbers::pi,
              "where the sun stands, clockwise from north"},
        Field{"sun_elevation_rad", &O::sun_elevation_rad, 0.25, 1.5,
              "of the sun above the horizon"},
        EnumField{"climate",
                  &O::climate,
                  {EnumName{"temperate", Climate::kTemperate}, EnumName{"dry", Climate::kDry}},
                  "lawns and many trees, or bare ground and pools"},
        EnumField{"roofs",
                  &O::roofs,
                  {EnumName{"shingle", RoofStyle::kShingle}, EnumName{"clay", RoofStyle::kClay},
                   EnumName{"mixed", RoofStyle::kMixed}},
                  "what small buildings are covered with"},
        EnumField{"missing_footprints",
                  &O::missing,
                  {EnumName{"assume", MissingFootprints::kAssume},
                   EnumName{"leave", MissingFootprints::kLeave}},
                  "whether houses are assumed where the map has no footprints"},
        Field{"tile_px", &O::tile_px, std::size_t{64}, std::size_t{8192},
              "side of the tiles that are painted at once; changes no pixel"}};
  }
};

/// A plausible aerial picture of a map, for places that no photograph covers: rendered, and it says
/// so wherever it goes.
///
/// Ground by land use, streets by width with lines and cars, plots with gardens of their own, roofs
/// lit by their slope, trees, shadows by height, and the grain and softness of a camera.
/// Guarantees: 1. the same map, options and seed give the same pixels, whatever the thread count,
/// the tiles or the window: pixels are those of one grid anchored at the frame's origin;  2.
/// shadows fall away from the sun and are as long as the height says;  3. no parcel looks like its
/// neighbour but by chance. Deviation: [AVB08] takes its images from Google Maps; no aerial image
/// covers our cities (ADR 0031).
class RenderedOrthophoto {
 public:
  RenderedOrthophoto(const MapLayers& layers, const OrthophotoOptions& options, std::uint64_t seed);
  ~RenderedOrthophoto();
  RenderedOrthophoto(RenderedOrthophoto&&) noexcept;
  RenderedOrthophoto& operator=(RenderedOrthophoto&&) noexcept;

  [[nodiscard]] std::size_t assumed_footprints() const;
  [[nodiscard]] std::size_t assumed_heights() const;

  /// The pixels that touch `window`.
  [[nodiscard]] geodata::RasterGrid grid(const Box& window) const;
  [[nodiscard]] geodata::Raster render(const Box& window, Jobs jobs = {}) const;
  /// Strip by strip into a GeoTIFF: a city is never held in memory.
  /// @throws InputError where the path cannot be written
  void write(const std::string& path, const Box& window, Jobs jobs = {},
             Progress::Style progress = Progress::Style::kQuiet,
             geodata::RasterCompression compression = geodata::RasterCompression::kLossless) const;

 private:
  class Painter;
  std::unique_ptr<Painter> painter_;
};

}  // namespace plat::imagery
