#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <memory>
#include <optional>
#include <sstream>

#include "command.h"
#include "core/progress.h"
#include "geodata/layer_io.h"
#include "harness/layout_layers.h"
#include "harness/scripted_site.h"
#include "harness/subdivision.h"
#include "harness/synthesis_script.h"
#include "output_file.h"
#include "streets/street_grower.h"
#include "synthesis/layout_synthesizer.h"

namespace plat::cli {
namespace {

using synthesis::SynthesisStage;

/// What [AVB08] grows streets and divides blocks by, where a script does not say.
constexpr std::string_view kDefaultGrower = "random_walk";
constexpr std::string_view kDefaultSubdivider = "voronoi";

struct Arguments {
  std::string script;
  std::string out;
  std::optional<std::uint64_t> seed;
  Jobs jobs;
};

/// Progress on the terminal, and how long each stage took.
class StageTimes {
 public:
  void begin(SynthesisStage stage, std::size_t steps) {
    end();
    progress_.emplace(std::string(synthesis::stage_name(stage)), steps);
    stage_ = stage;
    started_ = Clock::now();
  }
  void step() { progress_->step(); }
  void end() {
    if (stage_) times_s_[static_cast<std::size_t>(*stage_)] = seconds_since(started_);
    stage_.reset();
    progress_.reset();
  }
  [[nodiscard]] double of(SynthesisStage stage) const {
    return times_s_[static_cast<std::size_t>(stage)];
  }

  using Clock = std::chrono::steady_clock;
  static double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
  }

 private:
  std::optional<Progress> progress_;
  std::optional<SynthesisStage> stage_;
  Clock::time_point started_;
  std::array<double, std::size(synthesis::kSynthesisStages)> times_s_{};
};

std::string text_of(const std::string& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

/// The files of a script, which --out must not overwrite.
std::vector<std::string> inputs_of(const harness::SynthesisScript& script,
                                   const std::string& file) {
  std::vector<std::string> out{file};
  const auto add = [&](const std::optional<geodata::LayerSource>& source) {
    if (source) out.push_back(source->file);
  };
  const auto add_region = [&](const std::optional<harness::ScriptRegion>& region) {
    if (region) add(region->layer);
  };
  const auto add_source = [&](const harness::ScriptSource& source) {
    add(source.streets);
    add(source.parcels);
    add(source.points);
    add_region(source.region);
  };
  for (const harness::ScriptExample& example : script.examples) add_source(example.source);
  if (script.city) add_source(*script.city);
  for (const harness::ScriptOperation& operation : script.operations) add_region(operation.region);
  add_region(script.boundary);
  for (const harness::ScriptRegion& region : script.obstacles) add(region.layer);
  return out;
}

harness::LayoutOrigin origin_of(const harness::SynthesisScript& script, const Arguments& args) {
  const harness::StrategyChoice grower =
      script.grower.value_or(harness::StrategyChoice{std::string(kDefaultGrower), {}});
  const harness::StrategyChoice subdivider =
      script.subdivider.value_or(harness::StrategyChoice{std::string(kDefaultSubdivider), {}});
  return {args.seed.value_or(script.seed),
          grower.name,
          grower.options,
          subdivider.name,
          subdivider.options,
          text_of(args.script)};
}

void print_summary(const synthesis::Layout& layout, const StageTimes& times, double reading_s) {
  const std::size_t grown = layout.network.streets.size() - layout.existing_count;
  fmt::print("points: {}, {} left alone; {:.2f} s\n", layout.points.size(),
             layout.left_alone.size(), reading_s);
  fmt::print("streets: {} grown, {} existing; {:.2f} s\n", grown, layout.existing_count,
             times.of(SynthesisStage::kStreets));
  fmt::print("blocks: {}, {} of them existing; {:.2f} s\n", layout.blocks.size(),
             std::count_if(layout.blocks.begin(), layout.blocks.end(),
                           [](const synthesis::LayoutBlock& b) { return b.is_existing; }),
             times.of(SynthesisStage::kBlocks));
  fmt::print("parcels: {}; {:.2f} s\n", synthesis::parcel_count(layout),
             times.of(SynthesisStage::kParcels));
}

ExitStatus run(const Arguments& args) {
  const harness::SynthesisScript script = harness::read_synthesis_script(args.script);
  const harness::LayoutOrigin origin = origin_of(script, args);
  for (const std::string& input : inputs_of(script, args.script)) expect_output(args.out, {input});

  const auto start = StageTimes::Clock::now();
  const harness::ScriptedSite scripted = harness::scripted_site(script, origin.seed, args.jobs);
  const double reading_s = StageTimes::seconds_since(start);

  const synthesis::LayoutSynthesizer synthesizer(
      streets::street_growers().make(origin.grower, origin.grower_options),
      harness::ConfiguredSubdivider(origin.subdivider, origin.subdivider_options),
      {.seed = origin.seed});
  StageTimes times;
  const auto layout = synthesizer.synthesize(scripted.site, args.jobs, times);
  times.end();
  if (!layout) {
    throw InputError(fmt::format("{}: streets cannot be grown: {}: {}", args.script,
                                 failure_name(layout.error().code), layout.error().message));
  }
  geodata::write_layers(args.out,
                        harness::layout_layers(*layout, scripted.frame, origin, args.jobs));
  print_summary(*layout, times, reading_s);
  fmt::print("{}: {} failures\n", args.out, layout->failures.size());
  return layout->failures.empty() ? kDone : kFinishedWithFailures;
}

}  // namespace

void add_synthesize_command(CLI::App& app, Action& action) {
  auto args = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand(
      "synthesize",
      "Make a city by example: points taken from real streets are placed, joined, blended, or\n"
      "expand a city; streets grow between them, enclose blocks, and blocks are divided");
  command->add_option("script", args->script, "JSON file (docs/synthesis_script.md)")->required();
  command
      ->add_option("--out", args->out,
                   "GeoPackage to write: layers points, streets (level, chain, width), blocks, "
                   "parcels (block and parcel id, strategy, measures), failures, and synthesis, "
                   "which says what it was made by")
      ->required();
  command
      ->add_option("--seed", args->seed,
                   "random seed, wins over the script's; same seed, same bytes")
      ->check(CLI::NonNegativeNumber);
  command
      ->add_option("--jobs", args->jobs.count,
                   "threads, 0 = all cores; results do not depend on it")
      ->capture_default_str()
      ->check(CLI::Range(0, 1024));
  command->footer(
      "Example:\n  plat synthesize docs/examples/synthesis/expand.json --out grown.gpkg\n"
      "The output is in the CRS of the script's city, else of its first example (UTM where that "
      "is\n"
      "in degrees). A written city can be edited: plat edit --city grown.gpkg.\n"
      "Exit status: 0 done, 1 finished with failures listed in the layer, 2 bad input.");
  command->callback([args, &action] { action = [args] { return run(*args); }; });
}

}  // namespace plat::cli
