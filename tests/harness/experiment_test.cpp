#include "harness/experiment.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <map>

#include "geodata/scratch_folder.h"
#include "support/data_folder.h"

namespace plat::harness {
namespace {

namespace fs = std::filesystem;
using testing::ScratchFolder;

ExperimentConfig small_config() {
  ExperimentConfig config;
  config.experiment = "test";
  config.datasets = {"prague_bubenec_cz"};
  config.strategies = {{"obb", "obb", {}, Fit::kPerBlock}, {"plain", "voronoi", {}, Fit::kNone}};
  config.repetitions = 2;
  config.statistics.resamples = 30;
  config.statistics.permutations = 100;
  config.statistics.noise_repetitions = 10;
  return config;
}

/// Bytes of every file but timings.json.
std::map<std::string, std::string> contents(const fs::path& folder) {
  std::map<std::string, std::string> out;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file() || entry.path().filename() == "timings.json") continue;
    out[fs::relative(entry.path(), folder).string()] = testing::bytes_of(entry.path().string());
  }
  return out;
}

TEST(RunExperiment, ResumeGivesTheBytesOfAWholeRun) {
  PLAT_REAL_DATA_OR_SKIP(city, "prague_bubenec_cz/prague_bubenec_cz.gpkg");
  const ScratchFolder folder;
  const fs::path out = folder.file("run");
  const ExperimentConfig config = small_config();
  const auto first = run_experiment(config, out, Jobs{2}, Resume::kYes);
  EXPECT_EQ(first.resumed_cells, 0U);
  const auto whole = contents(out);
  EXPECT_TRUE(fs::remove(out / "cells" / "prague_bubenec_cz__plain__1.json"));
  EXPECT_TRUE(fs::remove(out / "distances.csv"));
  const auto second = run_experiment(config, out, Jobs{1}, Resume::kYes);
  EXPECT_EQ(second.resumed_cells, 3U);
  EXPECT_EQ(second.blocks, first.blocks);
  EXPECT_EQ(second.failures, first.failures);
  EXPECT_EQ(contents(out), whole);
}

TEST(RunExperiment, CellsOfOtherOptionsAreRunAgain) {
  PLAT_REAL_DATA_OR_SKIP(city, "prague_bubenec_cz/prague_bubenec_cz.gpkg");
  const ScratchFolder folder;
  ExperimentConfig config = small_config();
  static_cast<void>(run_experiment(config, folder.file("run"), Jobs{2}, Resume::kNo));
  config.strategies[1].options = {{"area_mean_m2", 700.0}};
  const auto second = run_experiment(config, folder.file("run"), Jobs{2}, Resume::kYes);
  EXPECT_EQ(second.resumed_cells, 2U);
}

TEST(RunExperiment, ASearchIsResumedWithTheBytesOfAWholeRun) {
  PLAT_REAL_DATA_OR_SKIP(city, "prague_bubenec_cz/prague_bubenec_cz.gpkg");
  const ScratchFolder folder;
  const fs::path out = folder.file("run");
  ExperimentConfig config = small_config();
  config.repetitions = 1;
  config.strategies[0].search = SearchConfig{};
  config.strategies[0].search->options = {{"fit_deviations", {0.5, 2.0}}};
  static_cast<void>(run_experiment(config, out, Jobs{2}, Resume::kNo));
  const auto whole = contents(out);
  EXPECT_TRUE(fs::remove(out / "cells" / "prague_bubenec_cz__obb__0.json"));
  EXPECT_EQ(run_experiment(config, out, Jobs{1}, Resume::kYes).resumed_cells, 2U);
  EXPECT_EQ(contents(out), whole);
  config.strategies[0].search->options = {{"fit_deviations", {0.5, 1.0}}};
  EXPECT_EQ(run_experiment(config, out, Jobs{1}, Resume::kYes).resumed_cells, 1U)
      << "another grid is another search";
}

TEST(RunExperiment, MakesNoFolderForADataSetThatIsNotThere) {
  const ScratchFolder folder;
  ExperimentConfig config = small_config();
  config.datasets = {"rcsp_or_library"};  // has no plots
  EXPECT_THROW(static_cast<void>(run_experiment(config, folder.file("run"), Jobs{1}, Resume::kNo)),
               InputError);
  EXPECT_FALSE(fs::exists(folder.file("run")));
}

}  // namespace
}  // namespace plat::harness
