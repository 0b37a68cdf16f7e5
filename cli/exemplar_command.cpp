#include <fmt/format.h>

#include <charconv>
#include <map>
#include <memory>

#include "command.h"
#include "geodata/layer_io.h"
#include "harness/observed_exemplar.h"
#include "output_file.h"
#include "set_option.h"

namespace plat::cli {
namespace {

struct Arguments {
  harness::ExemplarSource source;
  std::string window;
  std::vector<std::string> settings;
  std::string out;
  Jobs jobs;
};

/// "MINX,MINY,MAXX,MAXY"
Box window_from(const std::string& text) {
  double values[4] = {};
  const char* at = text.data();
  const char* const end = text.data() + text.size();
  for (int i = 0; i < 4; ++i) {
    const auto [next, error] = std::from_chars(at, end, values[i]);
    const bool is_last = i == 3;
    if (error != std::errc() || (is_last ? next != end : next == end || *next != ','))
      throw InputError(
          fmt::format("--window {}: must be MINX,MINY,MAXX,MAXY, four numbers in metres", text));
    at = next + (is_last ? 0 : 1);
  }
  const Box box{{values[0], values[1]}, {values[2], values[3]}};
  if (!(box.width() > 0.0 && box.height() > 0.0))
    throw InputError(fmt::format("--window {}: is empty; MINX,MINY,MAXX,MAXY", text));
  return box;
}

void print_summary(const harness::ObservedExemplar& observed, const std::string& out) {
  const streets::Exemplar& exemplar = observed.exemplar;
  std::size_t with_parcels = 0;
  for (const streets::IntersectionPoint& point : exemplar.points)
    with_parcels += point.parcel_area_m2 ? 1 : 0;
  std::map<int, std::size_t> chains_per_level;
  for (const streets::StreetChain& chain : exemplar.chains) ++chains_per_level[chain.hierarchy];
  fmt::print("points: {}, {} of them near parcels\n", exemplar.points.size(), with_parcels);
  fmt::print("streets: {} of {} pieces\n", exemplar.chains.size(), observed.network.streets.size());
  for (const auto& [level, count] : chains_per_level)
    fmt::print("  hierarchy {}: {} streets\n", level, count);
  fmt::print("{}: {}\n", out, streets::summary(observed.repairs));
}

ExitStatus run(Arguments arguments) {
  arguments.source.options = harness::exemplar_options(options_from_settings(arguments.settings));
  if (!arguments.window.empty()) arguments.source.window = window_from(arguments.window);
  expect_output(arguments.out, {arguments.source.city, arguments.source.parcels});
  const harness::ObservedExemplar observed =
      harness::read_exemplar(arguments.source, arguments.jobs);
  geodata::write_layers(arguments.out, harness::exemplar_layers(observed));
  print_summary(observed, arguments.out);
  return kDone;
}

std::string settings_help() {
  std::string text = "option, key=value; may be repeated:";
  for (const FieldDescription& field : harness::exemplar_option_fields()) {
    std::string allowed = fmt::format("{:.4g}..{:.4g}", field.min, field.max);
    if (!field.choices.empty()) allowed = fmt::format("{}", fmt::join(field.choices, ", "));
    text += fmt::format("\n{} ({}; default {}): {}", field.name, allowed,
                        to_string(field.default_value), field.description);
  }
  return text;
}

}  // namespace

void add_exemplar_command(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand(
      "exemplar",
      "Take from observed streets what can be copied: intersection points with the style of the\n"
      "streets through them [AVB08, Sec. 5]. Writes the layers points\n"
      "(docs/intersection_points.md), streets (pieces with chain and hierarchy) and chains (whole\n"
      "streets with their style), in the input's projected CRS or UTM.");
  harness::ExemplarSource& source = arguments->source;
  command->add_option("city", source.city, "data set (plat data list), or centrelines FILE[:layer]")
      ->required();
  command->add_option("--out", arguments->out, "GeoPackage to write")->required();
  command->add_option("--parcels", source.parcels,
                      "observed parcels, FILE[:layer]: areas near each point, and street widths; a "
                      "data set brings its own");
  command->add_option("--window", arguments->window,
                      "MINX,MINY,MAXX,MAXY in the output's CRS, metres: streets that are not "
                      "wholly inside are left out");
  command->add_option("--set", arguments->settings, settings_help())->take_all();
  command->add_option("--name-field", source.fields.name, "field with street names");
  command->add_option("--class-field", source.fields.street_class,
                      "field with street classes (default: highway, class)");
  command->add_option("--width-field", source.fields.width, "field with widths, metres");
  command->add_flag("--all-classes", source.has_all_classes,
                    "paths, service roads and rails are streets too");
  command->add_option("--jobs", arguments->jobs.count, "threads, 0 = all")
      ->check(CLI::Range(0, 1024));
  command->footer(
      "Example:\n  plat exemplar cambridge_ma --set main_share_01=0.05 --out points.gpkg\n"
      "Exit status: 0 done, 2 bad input.");
  command->callback([arguments, &action] { action = [arguments] { return run(*arguments); }; });
}

}  // namespace plat::cli
