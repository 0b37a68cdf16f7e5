#include <fmt/format.h>

#include <memory>
#include <numbers>
#include <optional>

#include "command.h"
#include "core/failure.h"
#include "core/progress.h"
#include "imagery/map_reader.h"
#include "imagery/rendered_orthophoto.h"
#include "output_file.h"
#include "set_option.h"

namespace plat::cli {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
/// Bytes a pixel of the picture, and how many pixels a TIFF may have on a side.
constexpr double kMostPixels = 4e9;

struct Arguments {
  std::string city;
  std::string streets;
  std::string parcels;
  std::string footprints;
  std::string water;
  std::string open_space;
  std::string out;
  imagery::MapSources fields;
  std::optional<double> pixel_m;
  std::optional<double> sun_azimuth_deg;
  std::optional<double> sun_elevation_deg;
  std::vector<double> window;
  std::vector<std::string> settings;
  std::uint64_t seed = 0;
  Jobs jobs;
  bool is_jpeg = false;
};

imagery::MapSources sources_of(const Arguments& args) {
  imagery::MapSources out =
      args.city.empty() ? imagery::MapSources{} : imagery::map_sources_in(args.city);
  const auto take = [](std::optional<geodata::LayerSource>& to, const std::string& text) {
    if (!text.empty()) to = geodata::parse_layer_source(text);
  };
  take(out.streets, args.streets);
  take(out.parcels, args.parcels);
  take(out.footprints, args.footprints);
  take(out.water, args.water);
  take(out.open_space, args.open_space);
  out.street_fields = args.fields.street_fields;
  out.height_field = args.fields.height_field;
  out.storeys_field = args.fields.storeys_field;
  return out;
}

imagery::OrthophotoOptions options_of(const Arguments& args) {
  OptionMap map = options_from_settings(args.settings);
  if (args.pixel_m) map["pixel_m"] = *args.pixel_m;
  if (args.sun_azimuth_deg) map["sun_azimuth_rad"] = *args.sun_azimuth_deg * kDegree;
  if (args.sun_elevation_deg) map["sun_elevation_rad"] = *args.sun_elevation_deg * kDegree;
  return from_option_map<imagery::OrthophotoOptions>("orthophoto", map);
}

/// The wanted part of the map, in its local frame.
Box window_of(const Arguments& args, const imagery::MapLayers& layers, double pixel_m) {
  const Box all = imagery::box_of(layers);
  if (all.is_empty()) throw InputError("plat orthophoto: no layer has a feature with a place");
  Box window = all;
  if (!args.window.empty()) {
    const Point origin = layers.frame.origin;
    window = {Point{args.window[0], args.window[1]} - origin,
              Point{args.window[2], args.window[3]} - origin};
    if (window.width() < pixel_m || window.height() < pixel_m || !window.intersects(all)) {
      throw InputError(fmt::format(
          "--window {} {} {} {}: wanted LEFT BOTTOM RIGHT TOP of a part of the map, which covers "
          "{:.0f} {:.0f} {:.0f} {:.0f}",
          args.window[0], args.window[1], args.window[2], args.window[3], all.min.x + origin.x,
          all.min.y + origin.y, all.max.x + origin.x, all.max.y + origin.y));
    }
  }
  const double pixels = window.width() / pixel_m * (window.height() / pixel_m);
  if (pixels > kMostPixels) {
    throw InputError(fmt::format(
        "plat orthophoto: {:.0f} x {:.0f} m at {} m are {:.0f} million pixels, at most {:.0f} "
        "million; choose a --window or a larger --pixel",
        window.width(), window.height(), pixel_m, pixels / 1e6, kMostPixels / 1e6));
  }
  return window;
}

ExitStatus run(const Arguments& args) {
  expect_output(args.out, {}, "--out", ".tif");
  const imagery::OrthophotoOptions options = options_of(args);
  const imagery::MapLayers layers = imagery::read_map(sources_of(args), args.jobs);
  const Box window = window_of(args, layers, options.pixel_m);
  const imagery::RenderedOrthophoto picture(layers, options, args.seed);
  picture.write(
      args.out, window, args.jobs, Progress::Style::kAutomatic,
      args.is_jpeg ? geodata::RasterCompression::kJpeg : geodata::RasterCompression::kLossless);
  const geodata::RasterGrid grid = picture.grid(window);
  fmt::print("{}: {} x {} pixels of {} m, {}; {} footprints assumed, {} heights assumed\n",
             args.out, grid.width, grid.height, grid.pixel_m, imagery::kRenderedDescription,
             picture.assumed_footprints(), picture.assumed_heights());
  return kDone;
}

void add_layer_options(CLI::App& command, Arguments& args) {
  command.add_option("--city", args.city,
                     "GeoPackage with layers streets, parcels, footprints (or buildings), water, "
                     "open_space, as plat synthesize writes it");
  command.add_option("--streets", args.streets, "centrelines, FILE[:layer]");
  command.add_option("--parcels", args.parcels, "parcels, FILE[:layer]");
  command.add_option("--footprints", args.footprints,
                     "buildings, FILE[:layer]; without any, houses are assumed on the parcels");
  command.add_option("--water", args.water, "water, FILE[:layer]");
  command.add_option("--open-space", args.open_space, "parks and fields, FILE[:layer]");
  command.add_option("--width-field", args.fields.street_fields.width,
                     "field with street widths, metres (default: width, width_m; else the gap "
                     "between parcels)");
  command.add_option("--class-field", args.fields.street_fields.street_class,
                     "field with street classes (default: highway, class)");
  command.add_option("--height-field", args.fields.height_field,
                     "field with heights of footprints, metres (default: height_m, height)");
  command.add_option("--storeys-field", args.fields.storeys_field,
                     "field with storeys of footprints, 3 m each (default: storeys, floors, ...)");
}

}  // namespace

void add_orthophoto_command(CLI::App& app, Action& action) {
  auto args = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand(
      "orthophoto",
      "Render a plausible aerial picture from map layers, for cities that no photograph covers.\n"
      "The file says of itself that it is rendered. Pixels depend on the map, the options and the\n"
      "seed only: a window has the pixels of the whole.\n"
      "Exit status: 0 done, 2 bad input.\n"
      "Example: plat orthophoto --city city.gpkg --pixel 0.25 --out city.tif");
  add_layer_options(*command, *args);
  command->add_option("--out", args->out, "GeoTIFF to write, .tif")->required();
  command->add_option("--pixel", args->pixel_m, "side of a pixel, metres (default 0.25)");
  command
      ->add_option("--window", args->window,
                   "LEFT BOTTOM RIGHT TOP in the layers' projected CRS, metres (default: all)")
      ->expected(4);
  command->add_option("--sun-azimuth", args->sun_azimuth_deg,
                      "degrees clockwise from north (default 160)");
  command->add_option("--sun-elevation", args->sun_elevation_deg,
                      "degrees above the horizon (default 48)");
  command->add_option("--set", args->settings,
                      "key=value: climate=temperate|dry, roofs=shingle|clay|mixed, "
                      "missing_footprints=assume|leave; may be repeated");
  command->add_flag("--jpeg", args->is_jpeg, "JPEG in the GeoTIFF: a tenth of the size, lossy");
  command->add_option("--seed", args->seed, "of gardens, trees, roofs, cars and grain")
      ->capture_default_str();
  command->add_option("--jobs", args->jobs.count, "threads, 0 = all")->check(CLI::Range(0, 1024));
  command->callback([args, &action] { action = [args] { return run(*args); }; });
}

}  // namespace plat::cli
