#include "tile_similarity/similarity_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "harness/csv.h"
#include "statistics/holm.h"
#include "statistics/rank_correlation.h"
#include "tile_similarity/block_statistics.h"

namespace plat::tile_similarity {
namespace {

using harness::CsvTable;

constexpr std::size_t kExampleQueries = 3;
constexpr std::size_t kExampleRanks = 5;

std::vector<std::uint32_t> blocks_of_queries(const TileGallery& gallery) {
  std::vector<std::uint32_t> out;
  for (const std::uint32_t q : gallery.queries) out.push_back(gallery.blocks[q]);
  return out;
}

std::vector<BlockSum> sums_of(const PlaceResult& place, const TaskResult& task,
                              std::optional<double> QueryPrecision::* value) {
  std::vector<std::optional<double>> values;
  for (const QueryPrecision& query : task.queries) values.push_back(query.*value);
  return block_sums(blocks_of_queries(place.gallery), values);
}

/// A pair of measures on one task.
struct DifferenceRow {
  std::size_t a = 0;
  std::size_t b = 0;
  BlockDifference found;
};

/// Only queries that both measures answered: blocks must be the same on both sides.
std::optional<BlockDifference> difference_of(const SimilarityConfig& config,
                                             const PlaceResult& place, std::size_t task,
                                             std::size_t a, std::size_t b) {
  TaskResult of_a = place.measures[a].tasks[task];
  TaskResult of_b = place.measures[b].tasks[task];
  for (std::size_t q = 0; q < of_a.queries.size(); ++q) {
    if (of_a.queries[q].at_10 && of_b.queries[q].at_10) continue;
    of_a.queries[q] = {};
    of_b.queries[q] = {};
  }
  return block_difference(sums_of(place, of_a, &QueryPrecision::at_10),
                          sums_of(place, of_b, &QueryPrecision::at_10), config.resamples,
                          config.permutations, config.seed);
}

/// Spearman of the distances of one query; none where one of the measures failed.
std::optional<double> rank_correlation(const PlaceResult& place, std::size_t q, std::size_t a,
                                       std::size_t b) {
  const std::vector<double>& from_a = place.measures[a].distances[q];
  const std::vector<double>& from_b = place.measures[b].distances[q];
  if (from_a.empty() || from_b.empty()) return std::nullopt;
  std::vector<double> x;
  std::vector<double> y;
  for (std::size_t i = 0; i < from_a.size(); ++i) {
    if (i == place.gallery.queries[q]) continue;
    x.push_back(from_a[i]);
    y.push_back(from_b[i]);
  }
  return statistics::spearman(x, y);
}

std::string wkt_of(const Polygon& polygon) {
  std::string out = "POLYGON ((";
  for (const Point& p : polygon.outer) out += fmt::format("{} {}, ", p.x, p.y);
  return out + fmt::format("{} {}))", polygon.outer.front().x, polygon.outer.front().y);
}

template <class Visit>
void for_each_pair(const PlaceResult& place, Visit visit) {
  for (std::size_t a = 0; a < place.measures.size(); ++a) {
    for (std::size_t b = a + 1; b < place.measures.size(); ++b) visit(a, b);
  }
}

}  // namespace

std::string retrieval_csv(const SimilarityConfig& config, const std::vector<PlaceResult>& places) {
  CsvTable table(
      "place,task,measure,queries,blocks,chance_01,precision_at_1,at_1_low,at_1_high,"
      "precision_at_10,at_10_low,at_10_high,failed_copies");
  for (const PlaceResult& place : places) {
    for (const MeasureResult& measure : place.measures) {
      for (const TaskResult& task : measure.tasks) {
        const auto mean = [&](std::optional<double> QueryPrecision::* value) {
          return block_mean(sums_of(place, task, value), config.resamples, config.seed);
        };
        const auto at_1 = mean(&QueryPrecision::at_1);
        const auto at_10 = mean(&QueryPrecision::at_10);
        const auto chance = mean(&QueryPrecision::chance);
        if (!at_1 || !at_10 || !chance) continue;  // the place has no zones, or blocks of one tile
        table.add_row(place.place, task.task, measure.measure, at_1->queries, at_1->blocks,
                      chance->mean, at_1->mean, at_1->interval.low, at_1->interval.high,
                      at_10->mean, at_10->interval.low, at_10->interval.high, task.failures);
      }
    }
  }
  return table.text();
}

std::string differences_csv(const SimilarityConfig& config,
                            const std::vector<PlaceResult>& places) {
  CsvTable table("place,task,measure_a,measure_b,difference_at_10,low,high,p,p_holm,effect_size");
  for (const PlaceResult& place : places) {
    for (std::size_t task = 0; task < place.measures.front().tasks.size(); ++task) {
      std::vector<DifferenceRow> rows;
      for_each_pair(place, [&](std::size_t a, std::size_t b) {
        if (const auto found = difference_of(config, place, task, a, b))
          rows.push_back({a, b, *found});
      });
      std::vector<double> p_values;
      for (const DifferenceRow& row : rows) p_values.push_back(row.found.p_value);
      const std::vector<double> holm = statistics::holm_adjusted(p_values);
      for (std::size_t i = 0; i < rows.size(); ++i) {
        const BlockDifference& found = rows[i].found;
        table.add_row(place.place, place.measures.front().tasks[task].task,
                      place.measures[rows[i].a].measure, place.measures[rows[i].b].measure,
                      found.difference, found.interval.low, found.interval.high, found.p_value,
                      holm[i], found.effect_size);
      }
    }
  }
  return table.text();
}

std::string correlation_csv(const SimilarityConfig& config,
                            const std::vector<PlaceResult>& places) {
  CsvTable table("place,measure_a,measure_b,spearman,low,high,queries,blocks");
  for (const PlaceResult& place : places) {
    for_each_pair(place, [&](std::size_t a, std::size_t b) {
      std::vector<std::optional<double>> values;
      for (std::size_t q = 0; q < place.gallery.queries.size(); ++q)
        values.push_back(rank_correlation(place, q, a, b));
      const auto mean = block_mean(block_sums(blocks_of_queries(place.gallery), values),
                                   config.resamples, config.seed);
      if (mean)
        table.add_row(place.place, place.measures[a].measure, place.measures[b].measure, mean->mean,
                      mean->interval.low, mean->interval.high, mean->queries, mean->blocks);
    });
  }
  return table.text();
}

std::string times_csv(const std::vector<PlaceResult>& places) {
  CsvTable table("place,measure,pairs,pair_us,prepare_us,mean_vertices");
  for (const PlaceResult& place : places) {
    std::size_t vertices = 0;
    for (const auto& shape : place.gallery.shapes) vertices += shape.polygon.outer.size();
    for (std::size_t m = 0; m < place.measures.size(); ++m) {
      table.add_row(
          place.place, place.measures[m].measure, place.times[m].pairs, place.times[m].pair_us,
          place.times[m].prepare_us,
          static_cast<double>(vertices) / static_cast<double>(place.gallery.shapes.size()));
    }
  }
  return table.text();
}

std::string examples_csv(const std::vector<PlaceResult>& places) {
  CsvTable table("place,query,measure,rank,tile,block,zone,distance,wkt");
  for (const PlaceResult& place : places) {
    const TileGallery& gallery = place.gallery;
    const std::size_t step = std::max<std::size_t>(1, gallery.queries.size() / kExampleQueries);
    const std::size_t end = std::min(gallery.queries.size(), step * kExampleQueries);
    for (std::size_t q = 0; q < end; q += step) {
      const std::uint32_t query = gallery.queries[q];
      for (const MeasureResult& measure : place.measures) {
        const std::vector<double>& distances = measure.distances[q];
        if (distances.empty()) continue;
        std::vector<std::uint32_t> order(distances.size());
        std::iota(order.begin(), order.end(), 0U);
        std::erase(order, query);
        std::ranges::stable_sort(order, {}, [&](std::uint32_t i) { return distances[i]; });
        order.insert(order.begin(), query);  // rank 0
        for (std::size_t rank = 0; rank <= kExampleRanks && rank < order.size(); ++rank) {
          const std::uint32_t i = order[rank];
          table.add_row(place.place, gallery.ids[query], measure.measure, rank, gallery.ids[i],
                        gallery.blocks[i], gallery.shapes[i].zone, distances[i],
                        wkt_of(gallery.shapes[i].polygon));
        }
      }
    }
  }
  return table.text();
}

std::string places_csv(const std::vector<PlaceResult>& places) {
  CsvTable table("place,measure,tiles,refused_features,gallery,queries,refused_by_measure");
  for (const PlaceResult& place : places) {
    for (const MeasureResult& measure : place.measures)
      table.add_row(place.place, measure.measure, place.gallery.tiles, place.gallery.refused,
                    place.gallery.shapes.size(), place.gallery.queries.size(), measure.unprepared);
  }
  return table.text();
}

}  // namespace plat::tile_similarity
