// Do the measures of similarity agree, and which finds what it should: README.md.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/failure.h"
#include "core/progress.h"
#include "harness/atomic_file.h"
#include "harness/build_info.h"
#include "tile_similarity/matrix_pruning.h"
#include "tile_similarity/similarity_tables.h"

namespace plat::tile_similarity {
namespace {

using nlohmann::json;

json read_json(const std::string& file) {
  std::ifstream in(file);
  if (!in) throw InputError(file + ": cannot be read");
  json object = json::parse(in, nullptr, false);
  if (object.is_discarded()) throw InputError(file + ": is no JSON");
  return object;
}

std::vector<PlaceResult> run_places(const SimilarityConfig& config, Jobs jobs) {
  const auto& menu = similarity::shape_similarities();
  const std::vector<std::string> names = menu.names();
  std::vector<PlaceResult> out;
  Progress progress("places and measures", config.places.size() * names.size());
  for (const PlaceChoice& place : config.places) {
    PlaceResult result{place.name, read_gallery(place, config, jobs), {}, {}};
    if (result.gallery.queries.size() < 2)
      throw InputError(fmt::format("{}: fewer than two usable tiles in blocks", place.name));
    for (const std::string& name : names) {
      result.measures.push_back(
          run_retrieval(result.gallery, menu.make(name), config, place.name, jobs));
      progress.step();
    }
    out.push_back(std::move(result));
  }
  // Apart, so that no other thread is at work.
  for (PlaceResult& place : out) {
    for (const std::string& name : names)
      place.times.push_back(time_pairs(place.gallery, menu.make(name), config, place.place));
  }
  return out;
}

void run(const std::string& config_file, const std::filesystem::path& out, Jobs jobs) {
  const json object = read_json(config_file);
  const SimilarityConfig config = parse_similarity_config(object, config_file);
  const std::vector<PlaceResult> places = run_places(config, jobs);
  const PruningResult pruning = run_pruning(config, jobs);
  std::filesystem::create_directories(out);
  harness::write_file(out / "retrieval.csv", retrieval_csv(config, places));
  harness::write_file(out / "differences.csv", differences_csv(config, places));
  harness::write_file(out / "correlation.csv", correlation_csv(config, places));
  harness::write_file(out / "times.csv", times_csv(places));
  harness::write_file(out / "examples.csv", examples_csv(places));
  harness::write_file(out / "places.csv", places_csv(places));
  harness::write_file(out / "pruning.csv", pruning_csv(pruning.matrices));
  harness::write_file(out / "candidates.csv", candidates_csv(pruning.candidates));
  const json manifest{{"build", harness::build_info()}, {"config", object}};
  harness::write_file(out / "manifest.json", manifest.dump(2) + "\n");
}

}  // namespace
}  // namespace plat::tile_similarity

int main(int argc, char** argv) {
  CLI::App app{
      "Do measures of shape similarity agree, and which finds tiles of the same zone, of the same\n"
      "block, and perturbed copies?\n"
      "Example: tile_similarity --out out/tile_similarity && \\\n"
      "    python3 experiments/tile_similarity/draw.py out/tile_similarity\n"
      "Exit status: 0 done, 2 bad input"};
  std::string config =
      (plat::harness::experiments_folder() / "tile_similarity" / "config.json").string();
  std::string out;
  plat::Jobs jobs;
  app.add_option("--config", config, "what to run")->capture_default_str();
  app.add_option("--out", out, "folder for the tables and manifest.json")->required();
  app.add_option("--jobs", jobs.count, "threads, 0 = all cores; results do not depend on it");
  CLI11_PARSE(app, argc, argv);
  try {
    plat::tile_similarity::run(config, out, jobs);
    return 0;
  } catch (const plat::InputError& error) {
    fmt::print(stderr, "tile_similarity: {}\n", error.what());
    return 2;
  }
}
