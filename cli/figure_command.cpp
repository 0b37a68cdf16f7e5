#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <memory>

#include "command.h"
#include "core/failure.h"
#include "geodata/dataset_catalogue.h"
#include "harness/build_info.h"
#include "harness/figure_listing.h"
#include "python_script.h"

namespace plat::cli {
namespace {

namespace fs = std::filesystem;
using harness::PaperFigure;

/// What the scripts end with when a claim of the caption does not hold.
constexpr int kClaimFailed = 1;

struct Arguments {
  std::vector<std::string> names;
  std::string out = "out/figures";
  bool is_list = false;
};

ExitStatus list(const std::vector<PaperFigure>& figures) {
  for (const PaperFigure& figure : figures) {
    std::string datasets;
    for (const std::string& name : figure.datasets) datasets += " " + name;
    fmt::print("{:<14}{}\n{:14}{} claims, about {:.0f} s,{}\n", figure.id, figure.title, "",
               figure.claim_count, figure.run_time_s,
               datasets.empty() ? " blocks made for it" : datasets);
  }
  return kDone;
}

/// Before any figure is begun: a missing city is told with where to get it.
void expect_data(const std::vector<PaperFigure>& figures) {
  for (const PaperFigure& figure : figures) {
    for (const std::string& name : figure.datasets) {
      const geodata::Dataset& set = geodata::dataset(name);
      if (geodata::locate(set)) continue;
      const bool is_manual = std::holds_alternative<geodata::FetchManually>(set.fetch);
      throw InputError(fmt::format(
          "{}: data set \"{}\" is not in {}; {}", figure.id, name, geodata::data_dir().string(),
          is_manual ? fmt::format("get it from {} and set PLAT_DATA_DIR", set.source)
                    : fmt::format("plat data fetch {}, or get it from {} and set PLAT_DATA_DIR",
                                  name, set.source)));
    }
  }
}

/// The scripts call this very program and read these very folders.
void pass_on_folders() {
  setenv("PLAT_BINARY", fs::read_symlink("/proc/self/exe").c_str(), 1);
  setenv("PLAT_EXPERIMENTS_DIR", harness::experiments_folder().c_str(), 1);
  setenv("PLAT_DATA_DIR", geodata::data_dir().c_str(), 1);
}

ExitStatus draw(const std::vector<PaperFigure>& figures, const std::string& out) {
  ExitStatus worst = kDone;
  for (const PaperFigure& figure : figures) {
    if (!fs::exists(figure.script))
      throw InputError(fmt::format("{}: {}: missing", figure.id, figure.script.string()));
    const int status = run_python(figure.script, std::vector<std::string>{"--out", out});
    if (status == kClaimFailed) {
      worst = std::max(worst, kFinishedWithFailures);
    } else if (status != 0) {
      return kBadInput;  // the script said why
    }
  }
  return worst;
}

ExitStatus run(const Arguments& args) {
  const std::vector<PaperFigure> all = harness::read_figures(harness::figures_folder());
  if (args.is_list) return list(args.names.empty() ? all : choose_figures(all, args.names));
  if (args.names.empty()) throw InputError("plat figure: name a figure or a paper, or --list");
  const std::vector<PaperFigure> chosen = choose_figures(all, args.names);
  expect_data(chosen);
  pass_on_folders();
  return draw(chosen, args.out);
}

}  // namespace

void add_figure_command(CLI::App& app, Action& action) {
  auto args = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand(
      "figure", "Draw a figure of a paper again, on open data, and measure what its caption says");
  command->add_option("names", args->names,
                      "figures (vkw12/fig10) or papers (vkw12: all of its figures)");
  command->add_flag("--list", args->is_list,
                    "name every figure with its number of claims, run time and data sets");
  command
      ->add_option("--out", args->out,
                   "folder: PAPER/FIGURE.pdf, .png and .json (each claim with its measured value, "
                   "bound and verdict); PAPER/work holds what was computed")
      ->capture_default_str();
  command->footer(
      "Example:\n  plat figure vkw12/fig10 --out out/figures\n"
      "Cities are looked for under PLAT_DATA_DIR (plat data list).\n"
      "Exit status: 0 every claim holds, 1 a claim does not, 2 bad input.");
  command->callback([args, &action] { action = [args] { return run(*args); }; });
}

}  // namespace plat::cli
