// Do the measures of similarity agree, and which finds what it should: README.md.
#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/atomic_file.h"
#include "core/failure.h"
#include "core/progress.h"
#include "harness/experiment_program.h"
#include "tile_similarity/matrix_pruning.h"
#include "tile_similarity/similarity_tables.h"

namespace plat::tile_similarity {
namespace {

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

bool run(const harness::ProgramCall& call) {
  const SimilarityConfig config = parse_similarity_config(call.config, call.config_file);
  const std::vector<PlaceResult> places = run_places(config, call.jobs);
  const PruningResult pruning = run_pruning(config, call.jobs);
  std::filesystem::create_directories(call.out);
  write_file(call.out / "retrieval.csv", retrieval_csv(config, places));
  write_file(call.out / "differences.csv", differences_csv(config, places));
  write_file(call.out / "correlation.csv", correlation_csv(config, places));
  write_file(call.out / "times.csv", times_csv(places));
  write_file(call.out / "examples.csv", examples_csv(places));
  write_file(call.out / "places.csv", places_csv(places));
  write_file(call.out / "pruning.csv", pruning_csv(pruning.matrices));
  write_file(call.out / "candidates.csv", candidates_csv(pruning.candidates));
  harness::write_manifest(call);
  return true;
}

}  // namespace
}  // namespace plat::tile_similarity

int main(int argc, char** argv) {
  return plat::harness::run_program(argc, argv,
                                    {.name = "tile_similarity",
                                     .question = "Do measures of shape similarity agree, and which "
                                                 "finds tiles of the same zone, of the same\n"
                                                 "block, and perturbed copies?",
                                     .trouble = "",
                                     .run = plat::tile_similarity::run});
}
