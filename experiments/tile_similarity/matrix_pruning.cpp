#include "tile_similarity/matrix_pruning.h"

#include <algorithm>
#include <chrono>
#include <numeric>
#include <utility>

#include "harness/csv.h"
#include "harness/tile_shapes.h"
#include "similarity/shape_clusters.h"
#include "similarity/similarity_matrix.h"
#include "tile_similarity/tile_gallery.h"

namespace plat::tile_similarity {
namespace {

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

}  // namespace

std::vector<PruningRow> run_pruning(const SimilarityConfig& config, Jobs jobs) {
  std::vector<PruningRow> rows;
  if (!config.pruning) return rows;
  harness::ParcelShapeSources sources;
  sources.parcels = {file_of(config.pruning->dataset), "parcels"};
  const harness::ReadTileShapes tiles = harness::read_tile_shapes(sources, jobs);
  add_rows(*config.pruning, config.seed,
           middle_part(tiles.shapes, static_cast<std::size_t>(config.pruning->tiles)), jobs, rows);
  add_rows(*config.pruning, config.seed, tiles.shapes, jobs, rows);
  return rows;
}

std::string pruning_csv(const std::vector<PruningRow>& rows) {
  harness::CsvTable table("tiles,clusters,cheap,keep,entries,recall_at_1,recall_at_10,seconds");
  for (const PruningRow& row : rows)
    table.add_row(row.tiles, row.clusters, row.cheap.empty() ? "none" : row.cheap.c_str(), row.keep,
                  row.entries, row.recall_at_1, row.recall_at_10, row.seconds);
  return table.text();
}

}  // namespace plat::tile_similarity
