#include "rcksp_scaling/scaling_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/rng.h"
#include "harness/csv.h"
#include "harness/power_law.h"

namespace plat::rcksp {
namespace {

using harness::CsvTable;
using harness::Duration;
using harness::fit_power_law;
using harness::GrowthPoint;

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return statistics::sorted_quantile(values, 0.5);
}

template <class Pick>
std::optional<double> median_of(const ContenderResult& contender, Pick pick) {
  if (!contender.is_ok() || contender.rounds.empty()) return std::nullopt;
  std::vector<double> values;
  for (const SearchRun& run : contender.rounds) values.push_back(pick(run));
  return median(std::move(values));
}

double total_s(const SearchRun& run) { return run.total().wall_s; }
double build_s(const SearchRun& run) { return run.build.wall_s; }
double search_s(const SearchRun& run) { return run.first.wall_s; }
double rest_s(const SearchRun& run) { return run.rest.wall_s; }
double cpu_s(const SearchRun& run) { return run.total().cpu_s; }

std::optional<double> least_total_s(const ContenderResult& contender) {
  if (!contender.is_ok() || contender.rounds.empty()) return std::nullopt;
  return total_s(*std::ranges::min_element(contender.rounds, {}, total_s));
}

/// A quantity that exponents are fitted to.
struct Quantity {
  const char* name;
  std::optional<double> (*of)(const ContenderResult&);
};
constexpr std::array<Quantity, 6> kQuantities{{
    {"total_s", [](const ContenderResult& c) { return median_of(c, total_s); }},
    {"total_cpu_s", [](const ContenderResult& c) { return median_of(c, cpu_s); }},
    {"build_s", [](const ContenderResult& c) { return median_of(c, build_s); }},
    {"search_s", [](const ContenderResult& c) { return median_of(c, search_s); }},
    {"states",
     [](const ContenderResult& c) -> std::optional<double> {
       if (!c.is_ok()) return std::nullopt;
       return static_cast<double>(c.guarded.statistics.states_created);
     }},
    {"peak_mb",
     [](const ContenderResult& c) -> std::optional<double> {
       return c.is_ok() ? std::optional(c.guarded.peak_mb) : std::nullopt;
     }},
}};

/// The cells of one study, in the order of their values.
std::vector<const CellResult*> cells_of(const std::vector<CellResult>& cells, std::size_t study) {
  std::vector<const CellResult*> out;
  for (const CellResult& cell : cells)
    if (cell.study == study) out.push_back(&cell);
  return out;
}

void add_exponent(CsvTable& table, const Study& study, const std::string& label,
                  std::string_view quantity, std::vector<GrowthPoint> points) {
  std::erase_if(points, [](const GrowthPoint& p) { return !(p.x > 0.0 && p.y > 0.0); });
  const auto law = fit_power_law(points);
  if (!law) return;
  table.add_row(study.name, study.vary, label, quantity, law->exponent,
                law->interval ? std::optional(law->interval->low) : std::nullopt,
                law->interval ? std::optional(law->interval->high) : std::nullopt, law->factor,
                points.size());
}

const ContenderResult* reference_of(const ScalingConfig& config, const CellResult& cell) {
  for (std::size_t i = 0; i < config.strategies.size(); ++i)
    if (config.strategies[i].label == config.reference) return &cell.contenders[i];
  return nullptr;
}

template <class T>
std::optional<T> if_ok(const ContenderResult& contender, T value) {
  return contender.is_ok() ? std::optional(value) : std::nullopt;
}

std::optional<double> median_in(const std::optional<Ratio>& ratio) {
  return ratio ? std::optional(ratio->median) : std::nullopt;
}
std::optional<double> low_in(const std::optional<Ratio>& ratio) {
  return ratio ? std::optional(ratio->interval.low) : std::nullopt;
}
std::optional<double> high_in(const std::optional<Ratio>& ratio) {
  return ratio ? std::optional(ratio->interval.high) : std::nullopt;
}

void add_cell(CsvTable& table, const ScalingConfig& config, const CellResult& cell,
              std::size_t index) {
  const ContenderResult& contender = cell.contenders[index];
  const StrategyChoice& choice = config.strategies[index];
  const ContenderResult* reference = reference_of(config, cell);
  const auto ratio = [&](Clock clock) {
    return reference == nullptr ? std::nullopt
                                : ratio_to(*reference, contender, clock, config.resamples,
                                           derive_seed(config.seed, {index}));
  };
  const auto wall = ratio(Clock::kWall);
  const auto processor = ratio(Clock::kProcessor);
  const auto least = least_total_s(contender);
  const SearchRun& run = contender.guarded;
  table.add_row(
      config.studies[cell.study].name, config.studies[cell.study].vary, cell.value,
      to_string(to_option_map(cell.options)), choice.label, choice.name, to_string(choice.options),
      status_name(run.status), contender.rounds.size(), median_of(contender, build_s),
      median_of(contender, search_s), median_of(contender, rest_s), median_of(contender, total_s),
      least, median_of(contender, cpu_s), median_in(wall), low_in(wall), high_in(wall),
      median_in(processor), low_in(processor), high_in(processor), if_ok(contender, run.found),
      if_ok(contender, run.first_cost), if_ok(contender, run.statistics.states_created),
      if_ok(contender, run.statistics.states_expanded),
      if_ok(contender, run.statistics.arcs_relaxed), if_ok(contender, run.statistics.states_pruned),
      if_ok(contender, static_cast<double>(run.statistics.bytes_held) / 1e6),
      if_ok(contender, run.peak_mb));
}

}  // namespace

std::optional<Ratio> ratio_to(const ContenderResult& reference, const ContenderResult& contender,
                              Clock clock, int resamples, std::uint64_t seed) {
  const auto spent_s = clock == Clock::kWall ? total_s : cpu_s;
  if (!reference.is_ok() || !contender.is_ok()) return std::nullopt;
  const std::size_t shared = std::min(reference.rounds.size(), contender.rounds.size());
  std::vector<double> ratios;
  for (std::size_t i = 0; i < shared; ++i)
    ratios.push_back(spent_s(contender.rounds[i]) / spent_s(reference.rounds[i]));
  if (ratios.empty()) return std::nullopt;
  constexpr double kLevel_01 = 0.95;
  Rng rng(seed);
  std::vector<double> replicates;
  std::vector<double> drawn(ratios.size());
  for (int r = 0; r < resamples; ++r) {
    for (double& ratio : drawn) ratio = ratios[rng.index(ratios.size())];
    replicates.push_back(median(drawn));
  }
  return Ratio{median(ratios), statistics::percentile_interval(replicates, kLevel_01)};
}

std::string runs_csv(const ScalingConfig& config, const std::vector<CellResult>& cells) {
  CsvTable table(
      "study,vary,value,strategy,round,build_s,search_s,rest_s,total_s,total_cpu_s,found");
  for (const CellResult& cell : cells) {
    for (std::size_t i = 0; i < cell.contenders.size(); ++i) {
      for (std::size_t r = 0; r < cell.contenders[i].rounds.size(); ++r) {
        const SearchRun& run = cell.contenders[i].rounds[r];
        table.add_row(config.studies[cell.study].name, config.studies[cell.study].vary, cell.value,
                      config.strategies[i].label, r, build_s(run), search_s(run), rest_s(run),
                      total_s(run), cpu_s(run), run.found);
      }
    }
  }
  return table.text();
}

std::string cells_csv(const ScalingConfig& config, const std::vector<CellResult>& cells) {
  CsvTable table(
      "study,vary,value,cell,strategy,name,options,status,rounds,build_s,search_s,rest_s,total_s,"
      "total_min_s,total_cpu_s,ratio,ratio_low,ratio_high,cpu_ratio,"
      "cpu_ratio_low,cpu_ratio_high,found,cost,states_created,"
      "states_expanded,arcs_relaxed,states_pruned,held_mb,peak_mb");
  for (const CellResult& cell : cells)
    for (std::size_t i = 0; i < cell.contenders.size(); ++i) add_cell(table, config, cell, i);
  return table.text();
}

std::string exponents_csv(const ScalingConfig& config, const std::vector<CellResult>& cells) {
  CsvTable table("study,vary,strategy,quantity,exponent,low,high,factor,points");
  for (std::size_t s = 0; s < config.studies.size(); ++s) {
    const Study& study = config.studies[s];
    const auto of_study = cells_of(cells, s);
    for (std::size_t i = 0; i < config.strategies.size(); ++i) {
      for (const Quantity& quantity : kQuantities) {
        std::vector<GrowthPoint> points;
        for (const CellResult* cell : of_study)
          points.push_back({cell->value, quantity.of(cell->contenders[i]).value_or(0.0)});
        add_exponent(table, study, config.strategies[i].label, quantity.name, std::move(points));
      }
    }
    for (const PublishedCurve& curve : config.published) {
      if (curve.study != study.name) continue;
      std::vector<GrowthPoint> points;
      for (std::size_t p = 0; p < curve.values.size(); ++p)
        points.push_back({curve.values[p], curve.numbers[p]});
      add_exponent(table, study, curve.label, curve.quantity, std::move(points));
    }
  }
  return table.text();
}

std::string solutions_csv(const ScalingConfig& config, const std::vector<CellResult>& cells) {
  CsvTable table("study,vary,value,cost_m2,position,building,start_m,length_m,height_m,depth_m");
  for (const CellResult& cell : cells) {
    if (cell.best.steps.empty()) continue;
    const StreetDatabase street = street_database(cell.options, config.seed);
    double start_m = 0.0;
    for (std::size_t i = 0; i < cell.best.steps.size(); ++i) {
      const std::uint32_t node = cell.best.steps[i].node;
      const Building& building = street.buildings[node];
      const double length_m = building.length * kLengthStep_m;
      table.add_row(config.studies[cell.study].name, config.studies[cell.study].vary, cell.value,
                    static_cast<double>(cell.best.cost) * kCostStep_m2, i,
                    street.database.elements[node].name, start_m, length_m, building.height_m,
                    building.depth_m);
      start_m += length_m;
    }
  }
  return table.text();
}

std::string buildings_csv(const ScalingConfig& config) {
  CsvTable table("building,length_m,height_m,depth_m,doors,balconies,solar_panels");
  const StreetDatabase street = street_database(
      config.studies.front().cell(config.studies.front().values.front()), config.seed);
  for (std::size_t i = 0; i < street.buildings.size(); ++i) {
    const Building& building = street.buildings[i];
    table.add_row(street.database.elements[i].name, building.length * kLengthStep_m,
                  building.height_m, building.depth_m, building.others[0], building.others[1],
                  building.others[2]);
  }
  return table.text();
}

}  // namespace plat::rcksp
