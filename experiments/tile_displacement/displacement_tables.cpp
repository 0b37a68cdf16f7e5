#include "tile_displacement/displacement_tables.h"

#include <map>
#include <tuple>

#include "core/rng.h"
#include "harness/csv.h"
#include "statistics/quantile.h"

namespace plat::displacement {
namespace {

using harness::CsvTable;

constexpr double kLevel_01 = 0.95;

/// Rows that belong to one point of a curve, in the order of groups.
struct CurveKey {
  std::size_t city = 0;
  std::string way;
  std::string similarity;
  double displacement_m = 0.0;

  friend auto operator<=>(const CurveKey&, const CurveKey&) = default;
};

using Curves = std::map<CurveKey, std::vector<const DisplacementRow*>>;

Curves curves_of(const DisplacementResult& result) {
  Curves out;
  for (const DisplacementRow& row : result.rows) {
    if (row.status == "ok")
      out[{row.city, row.way, row.similarity, row.displacement_m}].push_back(&row);
  }
  return out;
}

double mean_of(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

/// Of a mean over groups. The same draws for everything that as many groups stand for.
statistics::Interval interval_of(const std::vector<double>& values,
                                 const DisplacementConfig& config) {
  Rng rng(derive_seed(config.seed, {seed_key("bootstrap")}));
  std::vector<double> replicates;
  for (int r = 0; r < config.resamples; ++r) {
    double sum = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) sum += values[rng.index(values.size())];
    replicates.push_back(sum / static_cast<double>(values.size()));
  }
  return statistics::percentile_interval(replicates, kLevel_01);
}

}  // namespace

std::string displacements_csv(const DisplacementConfig& config, const DisplacementResult& result) {
  std::string header =
      "dataset,group,displacement_m,way,similarity,status,moved_tiles,free_tiles,held_tiles";
  for (const Measure& measure : measures()) header += "," + std::string(measure.name);
  CsvTable table(header + ",replacements_refused,rounds");
  for (const DisplacementRow& row : result.rows) {
    std::string text =
        fmt::format("{},{},{},{},{},{},{},{},{}", config.cities[row.city].dataset, row.group,
                    row.displacement_m, row.way, row.similarity, row.status, row.moved_tiles,
                    row.errors.free_tiles, row.errors.held_tiles);
    for (const Measure& measure : measures())
      text += row.status == "ok" ? fmt::format(",{}", measure.of(row)) : ",";
    table.add_raw_row(fmt::format("{},{},{}", text, row.replacements_refused, row.rounds));
  }
  return table.text();
}

std::string curves_csv(const DisplacementConfig& config, const DisplacementResult& result) {
  CsvTable table("dataset,way,similarity,displacement_m,measure,unit,mean,low,high,groups");
  for (const auto& [key, rows] : curves_of(result)) {
    for (const Measure& measure : measures()) {
      std::vector<double> values;
      for (const DisplacementRow* row : rows) values.push_back(measure.of(*row));
      const auto interval = interval_of(values, config);
      table.add_row(config.cities[key.city].dataset, key.way, key.similarity, key.displacement_m,
                    measure.name, measure.unit, mean_of(values), interval.low, interval.high,
                    values.size());
    }
  }
  return table.text();
}

std::string replacements_csv(const DisplacementConfig& config, const DisplacementResult& result) {
  CsvTable table("dataset,similarity,displacement_m,measure,unit,difference,low,high,groups");
  using Cell = std::tuple<std::size_t, int, double>;
  std::map<Cell, const DisplacementRow*> without;
  for (const DisplacementRow& row : result.rows) {
    if (row.way == "operation" && row.status == "ok")
      without.emplace(Cell{row.city, row.group, row.displacement_m}, &row);
  }
  for (const auto& [key, rows] : curves_of(result)) {
    if (key.similarity.empty()) continue;
    for (const Measure& measure : measures()) {
      std::vector<double> differences;
      for (const DisplacementRow* row : rows) {
        const auto other = without.find({row->city, row->group, row->displacement_m});
        if (other != without.end())
          differences.push_back(measure.of(*row) - measure.of(*other->second));
      }
      if (differences.empty()) continue;
      const auto interval = interval_of(differences, config);
      table.add_row(config.cities[key.city].dataset, key.similarity, key.displacement_m,
                    measure.name, measure.unit, mean_of(differences), interval.low, interval.high,
                    differences.size());
    }
  }
  return table.text();
}

std::string cities_csv(const DisplacementConfig& config, const DisplacementResult& result) {
  CsvTable table("dataset,tiles,blocks,joints,links,failures");
  for (const CityRow& row : result.cities)
    table.add_row(config.cities[row.city].dataset, row.tiles, row.blocks, row.joints, row.links,
                  row.failures);
  return table.text();
}

}  // namespace plat::displacement
