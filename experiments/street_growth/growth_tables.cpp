#include "street_growth/growth_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <tuple>

#include "harness/csv.h"
#include "statistics/holm.h"
#include "street_growth/tile_statistics.h"

namespace plat::growth {
namespace {

using harness::CsvTable;
using streets::RecoveryShares;

/// One of the two ways in which recovery is judged.
struct Judgement {
  std::string_view name;
  const TiledShares& (*of)(const GrowthCell&);
};
constexpr std::array<Judgement, 2> kJudgements{{
    {"edges", [](const GrowthCell& cell) -> const TiledShares& { return cell.edges; }},
    {"length", [](const GrowthCell& cell) -> const TiledShares& { return cell.length; }},
}};

using Tile = std::pair<std::int64_t, std::int64_t>;

std::string text_of(const OptionMap& options) {
  std::string out;
  for (const auto& [key, value] : options) {
    out += out.empty() ? "" : ";";
    out += key + "=";
    if (const auto* text = std::get_if<std::string>(&value)) {
      out += *text;
    } else {
      out += fmt::format("{}", std::get<double>(value));
    }
  }
  return out;
}

std::string flattened_of(const Variant& variant) {
  std::string out;
  for (const Attribute attribute : variant.flattened) {
    out += out.empty() ? "" : ";";
    out += attribute_name(attribute);
  }
  return out;
}

/// Every square in which any variant was judged, so that all have the same ones.
std::vector<Tile> tiles_of(const CityResult& city, const Judgement& judgement) {
  std::set<Tile> tiles;
  for (const auto& cells : city.cells) {
    for (const GrowthCell& cell : cells) {
      for (const auto& [at, shares] : judgement.of(cell)) tiles.insert({at.column, at.row});
    }
  }
  return {tiles.begin(), tiles.end()};
}

/// Per square the sums over the seeds that are ok, of one level or of all.
std::vector<RecoveryShares> pooled(std::span<const GrowthCell> cells, const Judgement& judgement,
                                   const std::vector<Tile>& tiles, std::optional<int> level) {
  std::vector<RecoveryShares> out(tiles.size());
  for (const GrowthCell& cell : cells) {
    for (const auto& [at, shares] : judgement.of(cell)) {
      if (level && at.level != *level) continue;
      const auto it = std::lower_bound(tiles.begin(), tiles.end(), Tile{at.column, at.row});
      out[static_cast<std::size_t>(it - tiles.begin())] += shares;
    }
  }
  return out;
}

RecoveryShares whole(const TiledShares& tiled) {
  RecoveryShares sum;
  for (const auto& [at, shares] : tiled) sum += shares;
  return sum;
}

std::size_t ok_count(std::span<const GrowthCell> cells) {
  return static_cast<std::size_t>(
      std::count_if(cells.begin(), cells.end(), [](const GrowthCell& c) { return c.is_ok(); }));
}

int deepest(const CityResult& city) {
  const auto& levels = city.city->levels;
  return levels.empty() ? 0 : *std::max_element(levels.begin(), levels.end());
}

template <class Visit>
void for_each_known(const std::vector<CityResult>& cities, Visit visit) {
  for (const CityResult& city : cities) {
    if (city.city) visit(city);
  }
}

/// Visits the cells that are ok, with their city, variant and seed.
template <class Visit>
void for_each_ok(const GrowthConfig& config, const std::vector<CityResult>& cities, Visit visit) {
  for_each_known(cities, [&](const CityResult& city) {
    for (std::size_t v = 0; v < config.variants.size(); ++v) {
      for (std::size_t seed = 0; seed < city.cells[v].size(); ++seed) {
        const GrowthCell& cell = city.cells[v][seed];
        if (cell.is_ok()) visit(city, config.variants[v], seed, cell);
      }
    }
  });
}

/// A line of differences.csv before Holm's adjustment.
struct DifferenceRow {
  std::size_t variant = 0;
  std::size_t seeds = 0;
  TileDifference difference;
};

std::vector<DifferenceRow> differences_of(const GrowthConfig& config, const CityResult& city,
                                          const Judgement& judgement, const Quantity& quantity) {
  const std::vector<Tile> tiles = tiles_of(city, judgement);
  std::vector<DifferenceRow> rows;
  for (std::size_t v = 0; v < config.variants.size(); ++v) {
    if (v == config.reference) continue;
    const std::size_t seeds = std::min(city.cells[v].size(), city.cells[config.reference].size());
    const auto a = pooled(std::span(city.cells[v]).first(seeds), judgement, tiles, {});
    const auto b =
        pooled(std::span(city.cells[config.reference]).first(seeds), judgement, tiles, {});
    const auto difference =
        tile_difference(a, b, quantity, config.resamples, config.permutations, config.seed);
    if (difference) rows.push_back({v, seeds, *difference});
  }
  return rows;
}

}  // namespace

std::string cells_csv(const GrowthConfig& config, const std::vector<CityResult>& cities,
                      const std::string& commit) {
  CsvTable table(
      "dataset,variant,strategy,options,flattened,seed,commit,status,message,points,left_alone,"
      "growth_s,known_edges,recovered_edges,grown_edges,true_edges,recall_edges_01,"
      "precision_edges_01,f1_edges_01,recall_length_01,precision_length_01,f1_length_01");
  for (const CityResult& city : cities) {
    if (!city.city) {
      table.add_row(city.label, "", "", "", "", "", commit, "skipped", city.skipped, "", "", "", "",
                    "", "", "", "", "", "", "", "", "");
      continue;
    }
    for (std::size_t v = 0; v < config.variants.size(); ++v) {
      const Variant& variant = config.variants[v];
      const std::string options =
          text_of(streets::street_growers().make(variant.strategy, variant.options).options());
      for (std::size_t seed = 0; seed < city.cells[v].size(); ++seed) {
        const GrowthCell& cell = city.cells[v][seed];
        const RecoveryShares edges = whole(cell.edges);
        const RecoveryShares length = whole(cell.length);
        table.add_row(city.label, variant.label, variant.strategy, options, flattened_of(variant),
                      seed, commit, cell.status, cell.message, city.city->places.size(),
                      cell.left_alone, cell.growth_s, edges.known, edges.recovered, edges.grown,
                      edges.right, edges.recall_01(), edges.precision_01(), edges.f1_01(),
                      length.recall_01(), length.precision_01(), length.f1_01());
      }
    }
  }
  return table.text();
}

std::string recovery_csv(const GrowthConfig& config, const std::vector<CityResult>& cities) {
  CsvTable table(
      "dataset,variant,level,judged_by,quantity,value,ci_low,ci_high,tiles,seeds,known,grown");
  const auto add = [&](const CityResult& city, std::size_t v, const Judgement& judgement,
                       const std::vector<Tile>& tiles, std::optional<int> level) {
    const auto shares = pooled(city.cells[v], judgement, tiles, level);
    const RecoveryShares sum = sum_of(shares);
    const std::size_t seeds = ok_count(city.cells[v]);
    for (const Quantity& quantity : quantities()) {
      const auto value = quantity.value(sum);
      if (!value) continue;
      const auto interval = share_interval(shares, quantity, config.resamples, config.seed);
      table.add_row(city.label, config.variants[v].label,
                    level ? fmt::format("{}", *level) : std::string("all"), judgement.name,
                    quantity.name, *value, interval ? std::optional(interval->low) : std::nullopt,
                    interval ? std::optional(interval->high) : std::nullopt, tiles.size(), seeds,
                    sum.known / static_cast<double>(seeds), sum.grown / static_cast<double>(seeds));
    }
  };
  for_each_known(cities, [&](const CityResult& city) {
    for (const Judgement& judgement : kJudgements) {
      const std::vector<Tile> tiles = tiles_of(city, judgement);
      for (std::size_t v = 0; v < config.variants.size(); ++v) {
        add(city, v, judgement, tiles, std::nullopt);
        for (int level = 0; level <= deepest(city); ++level) add(city, v, judgement, tiles, level);
      }
    }
  });
  return table.text();
}

std::string differences_csv(const GrowthConfig& config, const std::vector<CityResult>& cities) {
  CsvTable table(
      "dataset,variant,reference,judged_by,quantity,difference,ci_low,ci_high,p,p_holm,effect_size,"
      "seeds");
  for_each_known(cities, [&](const CityResult& city) {
    for (const Judgement& judgement : kJudgements) {
      for (const Quantity& quantity : quantities()) {
        const auto rows = differences_of(config, city, judgement, quantity);
        std::vector<double> p_values;
        for (const DifferenceRow& row : rows) p_values.push_back(row.difference.p_value);
        const std::vector<double> p_holm = statistics::holm_adjusted(p_values);
        for (std::size_t i = 0; i < rows.size(); ++i) {
          const TileDifference& d = rows[i].difference;
          table.add_row(city.label, config.variants[rows[i].variant].label,
                        config.variants[config.reference].label, judgement.name, quantity.name,
                        d.difference, d.interval.low, d.interval.high, d.p_value, p_holm[i],
                        d.effect_size, rows[i].seeds);
        }
      }
    }
  });
  return table.text();
}

std::string distances_csv(const GrowthConfig& config, const std::vector<CityResult>& cities) {
  CsvTable table("dataset,variant,seed,measure,unit,ks,wasserstein");
  for_each_ok(config, cities,
              [&](const CityResult& city, const Variant& variant, std::size_t seed,
                  const GrowthCell& cell) {
                const auto samples = streets::network_samples();
                for (std::size_t m = 0; m < samples.size(); ++m) {
                  const auto& distance = cell.distances[m];
                  table.add_row(city.label, variant.label, seed, samples[m].name, samples[m].unit,
                                distance ? std::optional(distance->ks) : std::nullopt,
                                distance ? std::optional(distance->wasserstein) : std::nullopt);
                }
              });
  return table.text();
}

std::string scalars_csv(const GrowthConfig& config, const std::vector<CityResult>& cities) {
  CsvTable table("dataset,variant,seed,measure,unit,known,grown");
  for_each_ok(config, cities,
              [&](const CityResult& city, const Variant& variant, std::size_t seed,
                  const GrowthCell& cell) {
                const auto scalars = streets::network_scalars();
                for (std::size_t m = 0; m < scalars.size(); ++m) {
                  table.add_row(city.label, variant.label, seed, scalars[m].name, scalars[m].unit,
                                scalars[m].value(city.city->measures), cell.scalars[m]);
                }
              });
  return table.text();
}

}  // namespace plat::growth
