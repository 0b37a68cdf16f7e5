#include <fmt/format.h>

#include <chrono>
#include <memory>

#include "command.h"
#include "core/options.h"
#include "editing/editor.h"
#include "geodata/layer_io.h"
#include "harness/city_file.h"
#include "harness/edit_script.h"
#include "output_file.h"
#include "parcels/block_subdivider.h"
#include "set_option.h"

namespace plat::cli {
namespace {

struct Arguments {
  std::string script;
  std::string city;
  std::string out;
  std::vector<std::string> settings;
  std::string matching{parcels::matching_name(parcels::ParcelMatching::kRelativeDistances)};
  harness::CityReading reading;
};

void read_style(const Arguments& args, editing::Style& style) {
  style.options = options_from_settings(args.settings);
  static_cast<void>(parcels::block_subdividers().make(style.strategy, style.options));
}

ExitStatus run(Arguments args) {
  read_style(args, args.reading.options.style);
  args.reading.options.matching = *parcels::matching_named(args.matching);
  const std::vector<harness::ScriptedEdit> script = harness::read_edit_script(args.script);
  expect_output(args.out, {args.city});
  harness::PlacedCity placed = harness::read_city(args.city, args.reading);
  const geodata::LocalFrame frame = placed.frame;
  editing::Editor editor(std::move(placed.city));
  std::size_t refused = 0;
  for (std::size_t i = 0; i < script.size(); ++i) {
    const auto start = std::chrono::steady_clock::now();
    const auto report = editor.apply(script[i].resolve(editor.city(), frame));
    const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
    if (!report) {
      ++refused;
      fmt::print("edit {} {}: refused, {}: {}\n", i + 1, script[i].name,
                 failure_name(report.error().code), report.error().message);
      continue;
    }
    fmt::print(
        "edit {} {}: blocks {} changed, {} new, {} gone; parcels {} kept, {} new, {} lost; "
        "{:.2f} ms\n",
        i + 1, script[i].name, report->changed.size(), report->appeared.size(),
        report->vanished.size(), report->parcels_kept, report->parcels_new, report->parcels_lost,
        time.count());
  }
  const std::vector<geodata::Layer> layers = harness::city_layers(editor.city(), frame);
  geodata::write_layers(args.out, layers);
  const std::size_t failures = layers.back().features.size();
  fmt::print("{}: {} streets, {} blocks, {} failures; {} of {} edits refused\n", args.out,
             editor.city().streets().size(), editor.city().blocks().size(), failures, refused,
             script.size());
  return refused + failures == 0 ? kDone : kFinishedWithFailures;
}

}  // namespace

void add_edit_command(CLI::App& app, Action& action) {
  auto args = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand(
      "edit",
      "Replay a list of edits on a city: streets move, blocks follow, parcels keep their ids and\n"
      "attributes");
  command->add_option("script", args->script, "JSON file with the edits (docs/edit_script.md)")
      ->required();
  command
      ->add_option("--city", args->city,
                   "GeoPackage: what plat edit wrote, or what plat blocks wrote from streets")
      ->required();
  command
      ->add_option("--out", args->out,
                   "GeoPackage to write: layers document, streets, blocks, parcels (block, parcel "
                   "and predecessor ids, attributes) and failures; --city of a next call")
      ->required();
  command
      ->add_option("--strategy", args->reading.options.style.strategy,
                   "how blocks are divided (plat list strategies), where the city does not say")
      ->capture_default_str();
  command->add_option("--set", args->settings, "option of the strategy, key=value; may be repeated")
      ->take_all();
  command->add_option("--strategy-field", args->reading.strategy_field,
                      "field of the layer blocks with the strategy of each block");
  command->add_option("--options-field", args->reading.options_field,
                      "field of the layer blocks with its options, \"key=value;...\"");
  command
      ->add_option("--matching", args->matching,
                   "which parcel takes the place of which: relative_distances, nearest_centroid, "
                   "largest_overlap")
      ->capture_default_str()
      ->check(CLI::IsMember({"relative_distances", "nearest_centroid", "largest_overlap"}));
  command->add_option("--seed", args->reading.options.seed, "random seed; same seed, same bytes")
      ->capture_default_str()
      ->check(CLI::NonNegativeNumber);
  command
      ->add_option("--jobs", args->reading.options.jobs.count,
                   "threads, 0 = all cores; results do not depend on it")
      ->capture_default_str()
      ->check(CLI::Range(0, 1024));
  command->footer(
      "Example:\n  plat blocks --streets city.gpkg:roads --out blocks.gpkg\n"
      "  plat edit edits.json --city blocks.gpkg --strategy obb --out edited.gpkg\n"
      "Coordinates are metres in the city's CRS. Strategy, options, seed and matching of a city\n"
      "that plat edit wrote are in the file. An edit that would break the network is refused and\n"
      "changes nothing.\n"
      "Exit status: 0 done, 1 finished with edits refused or failures in the layer, 2 bad input.");
  command->callback([args, &action] { action = [args] { return run(*args); }; });
}

}  // namespace plat::cli
