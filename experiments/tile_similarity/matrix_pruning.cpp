#include "tile_similarity/matrix_pruning.h"

#include <algorithm>
#include <chrono>
#include <numeric>
#include <span>
#include <utility>

#include "core/rng.h"
#include "harness/csv.h"
#include "harness/tile_shapes.h"
#include "similarity/candidate_search.h"
#include "similarity/shape_clusters.h"
#include "similarity/similarity_matrix.h"
#include "tile_similarity/tile_gallery.h"

namespace plat::tile_similarity {
namespace {

using harness::CsvTable;
using similarity::Candidate;
using similarity::LabelledShape;
using similarity::SimilarityMatrix;

/// The `count` shapes whose middles are nearest to the mean of all middles, in file order.
std::vector<LabelledShape> middle_part(const std::vector<LabelledShape>& shapes,
                                       std::size_t count) {
  std::vector<Point> middles;
  Point mean{};
  for (const LabelledShape& shape : shapes) {
    middles.push_back(centroid(shape.polygon));
    mean = mean + (1.0 / static_cast<double>(shapes.size())) * middles.back();
  }
  std::vector<std::uint32_t> order(shapes.size());
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::stable_sort(order, {}, [&](std::uint32_t i) { return distance(middles[i], mean); });
  order.resize(std::min(order.size(), count));
  std::ranges::sort(order);
  std::vector<LabelledShape> out;
  for (const std::uint32_t i : order) out.push_back(shapes[i]);
  return out;
}

struct Timed {
  SimilarityMatrix matrix;
  double seconds = 0.0;
};

Timed timed_matrix(const similarity::MatrixInputs& inputs, Jobs jobs) {
  const auto start = std::chrono::steady_clock::now();
  Timed out{similarity::compute_matrix(inputs, jobs), 0.0};
  out.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return out;
}

void add_rows(const PruningChoice& choice, std::uint64_t seed,
              const std::vector<LabelledShape>& shapes, Jobs jobs, std::vector<PruningRow>& rows) {
  const auto& menu = similarity::shape_similarities();
  const similarity::Clusters clusters =
      similarity::cluster_shapes(shapes, {.percent = choice.percent}, seed, jobs);
  similarity::MatrixInputs inputs{shapes, clusters, menu.make(choice.measure)};
  const Timed full = timed_matrix(inputs, jobs);
  rows.push_back({shapes.size(), clusters.members.size(), "", 0, full.matrix.entries.size(), 1.0,
                  1.0, full.seconds});
  for (const std::string& cheap : choice.cheap) {
    for (const std::uint32_t keep : choice.keep) {
      inputs.pruning = similarity::MatrixPruning{menu.make(cheap), keep};
      const Timed pruned = timed_matrix(inputs, jobs);
      rows.push_back({shapes.size(), clusters.members.size(), cheap, keep,
                      pruned.matrix.entries.size(), recall_01(pruned.matrix, full.matrix, 1),
                      recall_01(pruned.matrix, full.matrix, 10), pruned.seconds});
    }
  }
}

/// The share of `wanted` that is among `found`.
double share_found(std::span<const Candidate> wanted, std::span<const Candidate> found) {
  const auto count = std::ranges::count_if(wanted, [&](const Candidate& candidate) {
    return std::ranges::find(found, candidate.shape, &Candidate::shape) != found.end();
  });
  return static_cast<double>(count) / static_cast<double>(wanted.size());
}

/// Searches for tiles drawn at random, each as a place that is to be filled by another one.
std::vector<CandidateRow> candidate_rows(const PruningChoice& choice, std::uint64_t seed,
                                         const std::vector<LabelledShape>& shapes, Jobs jobs) {
  constexpr int kWanted = 5;
  const similarity::Clusters clusters =
      similarity::cluster_shapes(shapes, {.percent = choice.percent}, seed, jobs);
  const similarity::CandidateSearch search(
      shapes, clusters, similarity::shape_similarities().make(choice.measure), jobs);
  Rng rng(derive_seed(seed, {seed_key("candidates")}));
  std::vector<std::uint32_t> places;
  for (int i = 0; i < choice.places; ++i)
    places.push_back(static_cast<std::uint32_t>(rng.index(shapes.size())));
  const auto found = [&](std::uint32_t place, int looked_into) {
    auto candidates = search.most_similar(
        shapes[place], {.count = kWanted, .clusters = looked_into}, std::span(&place, 1));
    return candidates ? *candidates : std::vector<Candidate>{};
  };
  const auto all = static_cast<int>(clusters.members.size());
  const auto best = parallel_map<std::vector<Candidate>>(
      places.size(), jobs, [&](std::size_t i) { return found(places[i], all); });
  std::vector<CandidateRow> rows;
  for (const int looked_into : {1, 2, 3, 5, 10}) {
    CandidateRow row{shapes.size(), clusters.members.size(), looked_into, 0, 0.0, 0.0, 0.0};
    const auto start = std::chrono::steady_clock::now();
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (best[i].empty()) continue;  // the measure refuses the place
      const std::vector<Candidate> some = found(places[i], looked_into);
      ++row.places;
      row.recall_at_1 += share_found(std::span(best[i]).first(1), some);
      row.recall_at_5 += share_found(best[i], some);
    }
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const auto count = static_cast<double>(std::max<std::size_t>(1, row.places));
    row.recall_at_1 /= count;
    row.recall_at_5 /= count;
    row.milliseconds = 1000.0 * seconds / count;
    rows.push_back(row);
  }
  return rows;
}

}  // namespace

PruningResult run_pruning(const SimilarityConfig& config, Jobs jobs) {
  PruningResult out;
  if (!config.pruning) return out;
  harness::ParcelShapeSources sources;
  sources.parcels = {file_of(config.pruning->dataset), "parcels"};
  const harness::ReadTileShapes tiles = harness::read_tile_shapes(sources, jobs);
  const std::vector<LabelledShape> part =
      middle_part(tiles.shapes, static_cast<std::size_t>(config.pruning->tiles));
  add_rows(*config.pruning, config.seed, part, jobs, out.matrices);
  add_rows(*config.pruning, config.seed, tiles.shapes, jobs, out.matrices);
  out.candidates = candidate_rows(*config.pruning, config.seed, part, jobs);
  return out;
}

std::string pruning_csv(const std::vector<PruningRow>& rows) {
  CsvTable table("tiles,clusters,cheap,keep,entries,recall_at_1,recall_at_10,seconds");
  for (const PruningRow& row : rows)
    table.add_row(row.tiles, row.clusters, row.cheap.empty() ? "none" : row.cheap.c_str(), row.keep,
                  row.entries, row.recall_at_1, row.recall_at_10, row.seconds);
  return table.text();
}

std::string candidates_csv(const std::vector<CandidateRow>& rows) {
  CsvTable table(
      "tiles,clusters,looked_into,places,recall_at_1,recall_at_5,milliseconds_per_search");
  for (const CandidateRow& row : rows)
    table.add_row(row.tiles, row.clusters, row.looked_into, row.places, row.recall_at_1,
                  row.recall_at_5, row.milliseconds);
  return table.text();
}

}  // namespace plat::tile_similarity
