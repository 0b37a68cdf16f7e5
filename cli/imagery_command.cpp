#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>

#include "command.h"
#include "core/progress.h"
#include "harness/city_layers.h"
#include "harness/parcel_shapes.h"
#include "imagery/image_mosaic.h"
#include "imagery/imagery_plan.h"
#include "imagery/imagery_report.h"
#include "imagery/map_reader.h"
#include "imagery/rendered_orthophoto.h"
#include "output_file.h"
#include "set_option.h"

namespace plat::cli {
namespace {

/// As many as `plat orthophoto` writes.
constexpr double kMostPixels = 4e9;
/// Land shown around the parcels, metres.
constexpr double kMargin_m = 15.0;
/// Asphalt, as light as the rendered orthophoto's.
constexpr geodata::Colour kPlainGround{122, 122, 120, 255};

struct ExampleArguments {
  std::string parcels;
  std::string image;
};

struct Arguments {
  std::string city;
  ExampleArguments first;
  ExampleArguments second;
  std::vector<double> weight;
  std::vector<double> ramp;
  std::string zone_field;
  std::vector<std::string> settings;
  bool not_itself = false;
  bool jpeg = false;
  std::string ground = "map";
  std::optional<double> pixel_m;
  std::vector<double> window;
  std::vector<std::size_t> grid;
  std::uint64_t seed = 1;
  Jobs jobs;
  std::string out;
  std::string report;
};

/// A city whose parcels have images.
struct Example {
  std::string name;  // as on the command line
  imagery::ImageExample parcels;
  std::unique_ptr<imagery::SharedImage> image;
  std::size_t beyond_image = 0;
  std::size_t refused = 0;
};

harness::ReadParcelShapes read_city(const std::string& city, const std::string& zone_field,
                                    Jobs jobs) {
  harness::ParcelShapeSources sources = harness::parcel_shape_sources(city);
  sources.zone_field = zone_field;
  return harness::read_parcel_shapes(sources, jobs);
}

Box corners_of(const OrientedBox& box) {
  Box out;
  const imagery::BoxFrame frame(box);
  for (const double x : {0.0, frame.length_m()}) {
    for (const double y : {0.0, frame.width_m()}) out.add(frame.to_world({x, y}));
  }
  return out;
}

Example read_example(const ExampleArguments& arguments, const std::string& zone_field, Jobs jobs) {
  Example example;
  example.name = arguments.parcels;
  harness::ReadParcelShapes read = read_city(arguments.parcels, zone_field, jobs);
  example.refused = read.failures.size();
  example.image = std::make_unique<imagery::SharedImage>(
      arguments.image, geodata::RasterReadOptions{.frame = read.frame});
  const Box seen = example.image->grid().box();
  for (imagery::ParcelShape& shape : read.shapes) {
    const Box box = corners_of(shape.box);
    if (seen.contains(box.min) && seen.contains(box.max)) {
      example.parcels.parcels.push_back(std::move(shape));
    } else {
      ++example.beyond_image;
    }
  }
  if (example.parcels.parcels.empty())
    throw InputError(
        fmt::format("{}: shows none of the {} parcels of {}; is it the image of this "
                    "city?",
                    arguments.image, example.beyond_image, arguments.parcels));
  return example;
}

std::vector<Example> read_examples(const Arguments& args) {
  std::vector<Example> examples;
  examples.push_back(read_example(args.first, args.zone_field, args.jobs));
  if (!args.second.parcels.empty())
    examples.push_back(read_example(args.second, args.zone_field, args.jobs));
  return examples;
}

imagery::SourceWeight weight_of(const Arguments& args, Point origin) {
  imagery::SourceWeight weight;
  if (args.weight.empty()) return weight;
  weight.begin_01 = args.weight.front();
  weight.end_01 = args.weight.back();
  if (!args.ramp.empty())
    weight.ramp = Segment{Point{args.ramp[0], args.ramp[1]} - origin,
                          Point{args.ramp[2], args.ramp[3]} - origin};
  return weight;
}

void expect_consistent(const Arguments& args) {
  if (args.second.parcels.empty() != args.second.image.empty())
    throw InputError("--example2 and --image2: give both or none");
  if (args.second.parcels.empty() && !args.weight.empty())
    throw InputError("--weight: is the share of --example2, which is not given");
  if (!args.second.parcels.empty() && args.weight.empty())
    throw InputError("--example2: say with --weight how many parcels take their image from it");
  if (args.ramp.empty() == (args.weight.size() == 2))
    throw InputError("--ramp: goes with two values of --weight, at its start and at its end");
  if (!args.grid.empty() && args.report.empty())
    throw InputError("--grid: goes into --report, which is not given");
  for (const double w : args.weight) {
    if (!(w >= 0.0 && w <= 1.0)) throw InputError(fmt::format("--weight {}: allowed 0..1", w));
  }
}

/// North up, lines at multiples of the pixel in the local frame.
geodata::RasterGrid grid_of(const Arguments& args, const harness::ReadParcelShapes& city,
                            double pixel_m) {
  Box box;
  for (const imagery::ParcelShape& shape : city.shapes) box.add(box_of(shape.polygon));
  box = box.expanded(kMargin_m);
  if (!args.window.empty()) {
    const Point origin = city.frame.origin;
    box = {Point{args.window[0], args.window[1]} - origin,
           Point{args.window[2], args.window[3]} - origin};
    if (!(box.width() >= pixel_m && box.height() >= pixel_m))
      throw InputError("--window: wanted LEFT BOTTOM RIGHT TOP, in the CRS of --city");
  }
  const double left = std::floor(box.min.x / pixel_m);
  const double top = std::ceil(box.max.y / pixel_m);
  const double width = std::ceil(box.max.x / pixel_m) - left;
  const double height = top - std::floor(box.min.y / pixel_m);
  if (width * height > kMostPixels)
    throw InputError(
        fmt::format("{:.0f} x {:.0f} pixels of {} m, at most {:.0f} million; choose a "
                    "--window or a larger --pixel",
                    width, height, pixel_m, kMostPixels / 1e6));
  return {city.frame,
          left * pixel_m,
          top * pixel_m,
          pixel_m,
          static_cast<std::size_t>(width),
          static_cast<std::size_t>(height)};
}

/// The map between the parcels, rendered as `plat orthophoto` does, or one colour where the city
/// has no streets to draw.
imagery::GroundPainter ground_of(const Arguments& args, const harness::ReadParcelShapes& city,
                                 const geodata::RasterGrid& grid) {
  const harness::ParcelShapeSources sources = harness::parcel_shape_sources(args.city);
  if (args.ground != "map" || !sources.streets) return imagery::plain_ground(grid, kPlainGround);
  imagery::MapSources map = imagery::map_sources_in(sources.parcels.file);
  map.parcels = sources.parcels;  // widths are measured between them
  map.footprints.reset();
  imagery::MapLayers layers = imagery::read_map(map, args.jobs);
  expects(layers.frame == city.frame, "both are read in the frame of the parcels");
  layers.parcels.clear();
  imagery::OrthophotoOptions options;
  options.pixel_m = grid.pixel_m;
  options.missing = imagery::MissingFootprints::kLeave;
  const auto picture = std::make_shared<imagery::RenderedOrthophoto>(layers, options, args.seed);
  return [picture, grid](const geodata::PixelWindow& window) {
    // Pixels of both grids are the same; the box is kept off its neighbours.
    const Box box = geodata::grid_of(geodata::empty_raster(grid, window)).box();
    geodata::Raster ground = picture->render(box.expanded(-0.25 * grid.pixel_m), Jobs{1});
    expects(ground.width == window.width && ground.height == window.height,
            "the grids have common lines");
    return ground;
  };
}

/// Says what the picture is made of, and that a part was rendered where it was.
std::string description_of(const std::vector<Example>& examples) {
  std::string text = "synthesised by plat from images of example parcels";
  for (const Example& example : examples) {
    if (!example.image->description().empty()) text += "; " + example.image->description();
  }
  return text;
}

void print_summary(const Arguments& args, const geodata::RasterGrid& grid,
                   const std::vector<Example>& examples,
                   const std::vector<std::optional<imagery::ParcelImage>>& plan) {
  std::map<imagery::WarpKind, std::size_t> kinds;
  std::size_t filled = 0;
  for (const auto& image : plan) {
    if (!image) continue;
    ++filled;
    ++kinds[image->grid.kind];
  }
  fmt::print("{}: {} x {} pixels of {} m; {} of {} parcels have an image", args.out, grid.width,
             grid.height, grid.pixel_m, filled, plan.size());
  for (const imagery::WarpKind kind : imagery::kWarpKinds)
    fmt::print(", {} {}", imagery::warp_kind_name(kind), kinds[kind]);
  fmt::print("\n");
  for (const Example& example : examples)
    fmt::print("{}: {} example parcels, {} beyond the image, {} refused\n", example.name,
               example.parcels.parcels.size(), example.beyond_image, example.refused);
}

harness::FailureLayer failures_of(const harness::ReadParcelShapes& city,
                                  const std::vector<std::optional<imagery::ParcelImage>>& plan) {
  harness::FailureLayer failures(city.frame);
  for (const blocks::BlockFailure& failure : city.failures)
    failures.add(failure.feature_id, "imagery", 0, failure.failure, failure.shape);
  for (std::size_t i = 0; i < plan.size(); ++i) {
    if (plan[i]) continue;
    failures.add(city.shapes[i].id, "imagery", 0,
                 {FailureCode::kNoObservation, "the only example parcel is the parcel itself"},
                 city.shapes[i].polygon);
  }
  return failures;
}

void write_report(const Arguments& args, const harness::ReadParcelShapes& city,
                  const std::vector<Example>& examples,
                  const std::vector<imagery::ImageExample>& parcels,
                  const std::vector<std::optional<imagery::ParcelImage>>& plan,
                  const geodata::Layer& failures) {
  std::vector<std::string> names;
  for (const Example& example : examples) names.push_back(example.name);
  const auto rows = imagery::imagery_rows(city.shapes, parcels, plan, args.jobs);
  std::vector<geodata::Layer> layers{
      imagery::imagery_layer(city.frame, city.shapes, parcels, names, plan, rows), failures};
  if (!args.grid.empty()) {
    layers.push_back(
        imagery::target_grid_layer(city.frame, city.shapes, plan, args.grid[0], args.grid[1]));
    for (std::size_t e = 0; e < examples.size(); ++e)
      layers.push_back(imagery::source_grid_layer(examples[e].image->grid().frame, city.shapes,
                                                  plan, e, args.grid[0], args.grid[1]));
  }
  geodata::write_layers(args.report, layers);
}

ExitStatus run(const Arguments& args) {
  expect_consistent(args);
  imagery::PlanOptions options;
  options.retrieval =
      from_option_map<imagery::RetrievalOptions>("imagery", options_from_settings(args.settings));
  expect_output(args.out, {args.city, args.first.image, args.second.image}, "--out", ".tif");
  if (!args.report.empty())
    expect_output(args.report, {args.city, args.first.parcels, args.second.parcels}, "--report");
  const harness::ReadParcelShapes city = read_city(args.city, args.zone_field, args.jobs);
  if (city.shapes.empty())
    throw InputError(fmt::format("{}: none of its {} features is a usable parcel", args.city,
                                 city.failures.size()));
  std::vector<Example> examples = read_examples(args);
  std::vector<imagery::ImageExample> parcels;
  std::vector<const imagery::SharedImage*> images;
  for (Example& example : examples) {
    parcels.push_back(example.parcels);
    images.push_back(example.image.get());
  }
  options.weight = weight_of(args, city.frame.origin);
  options.own_image = args.not_itself ? imagery::OwnImage::kForbidden : imagery::OwnImage::kAllowed;
  options.seed = args.seed;
  const auto plan = imagery::plan_imagery(city.shapes, parcels, options, args.jobs);
  const geodata::RasterGrid grid =
      grid_of(args, city, args.pixel_m.value_or(images.front()->grid().pixel_m));
  const imagery::MosaicInput input{city.shapes, plan, images, ground_of(args, city, grid)};
  const auto compression =
      args.jpeg ? geodata::RasterCompression::kJpeg : geodata::RasterCompression::kLossless;
  imagery::write_mosaic(args.out, input, grid,
                        {geodata::RasterBands::kOpaque, compression, description_of(examples)},
                        args.jobs, Progress::Style::kAutomatic);
  const geodata::Layer failures = failures_of(city, plan).layer();
  if (!args.report.empty()) write_report(args, city, examples, parcels, plan, failures);
  print_summary(args, grid, examples, plan);
  if (failures.features.empty()) return kDone;
  fmt::print("{} parcels without an image\n", failures.features.size());
  return kFinishedWithFailures;
}

void add_input_options(CLI::App& command, Arguments& args) {
  command
      .add_option("--city", args.city,
                  "parcels to fill, FILE[:layer]; of a file, its layers parcels, blocks and "
                  "streets: they tell which sides face a street")
      ->required();
  command.add_option("--example", args.first.parcels, "example parcels, likewise")->required();
  command.add_option("--image", args.first.image, "image of --example, whatever GDAL opens")
      ->required();
  command.add_option("--example2", args.second.parcels, "parcels of a second source");
  command.add_option("--image2", args.second.image, "its image");
  command
      .add_option("--weight", args.weight,
                  "probability of the second source; two values: at the start and at the end of "
                  "--ramp")
      ->expected(1, 2);
  command
      .add_option("--ramp", args.ramp,
                  "X Y X Y, start and end of the line along which the weight changes, in the CRS "
                  "of --city")
      ->expected(4);
  command.add_option("--zone-field", args.zone_field,
                     "field of the parcel layers: examples of the same zone are taken first");
  command.add_flag("--not-itself", args.not_itself,
                   "no parcel takes the image of the example parcel of its own id: for a city "
                   "that is its own example");
}

}  // namespace

void add_imagery_command(CLI::App& app, Action& action) {
  auto args = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand(
      "imagery", "Fill parcels with images of similar example parcels [AVB08, Sec. 3.2]");
  add_input_options(*command, *args);
  command
      ->add_option("--set", args->settings,
                   "area_weight, aspect_weight (of the differences of the boxes), variety (one of "
                   "as many of the nearest), mirroring=allowed|forbidden, zones=same|any; may be "
                   "repeated")
      ->take_all();
  command->add_option("--out", args->out, "GeoTIFF to write, .tif")->required();
  command->add_option("--report", args->report,
                      "GeoPackage to write as well: layer imagery, per parcel its source, the "
                      "kind of warp, stretch and repetition; layer failures");
  command
      ->add_option("--grid", args->grid,
                   "S N: layers target_grid and source_grid in --report: S scan lines with N "
                   "samples each, which correspond")
      ->expected(2)
      ->check(CLI::Range(2, 1000));
  command->add_option("--pixel", args->pixel_m, "side of a pixel, metres (default: of --image)")
      ->check(CLI::Range(0.01, 100.0));
  command
      ->add_option("--window", args->window,
                   "LEFT BOTTOM RIGHT TOP in the CRS of --city (default: all parcels)")
      ->expected(4);
  command
      ->add_option("--ground", args->ground,
                   "between parcels: map (streets, water and open space of --city, rendered), or "
                   "plain (one colour)")
      ->capture_default_str()
      ->check(CLI::IsMember({"map", "plain"}));
  command->add_flag("--jpeg", args->jpeg, "JPEG in the GeoTIFF: a tenth of the size, lossy");
  command->add_option("--seed", args->seed, "of what is drawn: variety, the source")
      ->capture_default_str()
      ->check(CLI::NonNegativeNumber);
  command->add_option("--jobs", args->jobs.count, "threads, 0 = all cores")
      ->capture_default_str()
      ->check(CLI::Range(0, 1024));
  command->footer(
      "Example:\n  plat orthophoto --city old.gpkg --out old.tif\n"
      "  plat imagery --city new.gpkg --example old.gpkg --image old.tif --out new.tif "
      "--report new_imagery.gpkg\n"
      "Exit status: 0 done, 1 finished with failures listed in the layer, 2 bad input.");
  command->callback([args, &action] { action = [args] { return run(*args); }; });
}

}  // namespace plat::cli
