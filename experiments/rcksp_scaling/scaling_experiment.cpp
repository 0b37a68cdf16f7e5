#include "rcksp_scaling/scaling_experiment.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/rng.h"
#include "statistics/quantile.h"

namespace plat::rcksp {
namespace {

using sequences::AnySequenceSearch;
using sequences::CompiledProblem;

std::vector<CellResult> cells_of(const ScalingConfig& config) {
  std::vector<CellResult> cells;
  for (std::size_t s = 0; s < config.studies.size(); ++s) {
    for (const double value : config.studies[s].values) {
      CellResult cell;
      cell.study = s;
      cell.value = value;
      cell.options = config.studies[s].cell(value);
      cell.contenders.resize(config.strategies.size());
      cells.push_back(std::move(cell));
    }
  }
  return cells;
}

/// Whoever found other costs than the first that finished.
void mark_disagreement(CellResult& cell) {
  const auto agreed = std::ranges::find_if(cell.contenders, &ContenderResult::is_ok);
  for (auto it = agreed; it != cell.contenders.end(); ++it) {
    if (it->is_ok() && (it->guarded.found != agreed->guarded.found ||
                        it->guarded.cost_digest != agreed->guarded.cost_digest))
      it->guarded.status = RunStatus::kDisagrees;
  }
}

bool is_unfinished(RunStatus status) {
  return status == RunStatus::kFailed || status == RunStatus::kTimeLimit ||
         status == RunStatus::kMemoryLimit || status == RunStatus::kNotTried;
}

/// The median over the paired rounds so far, else the guarded run's.
double typical_s(const ContenderResult& contender) {
  if (contender.rounds.empty()) return contender.guarded.total().wall_s;
  std::vector<double> values_s;
  for (const SearchRun& run : contender.rounds) values_s.push_back(run.total().wall_s);
  std::ranges::sort(values_s);
  return statistics::sorted_quantile(values_s, 0.5);
}

std::string line_of(const ScalingConfig& config, const CellResult& cell, const char* phase) {
  const Study& study = config.studies[cell.study];
  std::string line = fmt::format("{} {}, {} = {}:", phase, study.name, study.vary, cell.value);
  const char* separator = " ";
  for (std::size_t i = 0; i < cell.contenders.size(); ++i) {
    const ContenderResult& contender = cell.contenders[i];
    line += fmt::format("{}{} {}", separator, config.strategies[i].label,
                        contender.is_ok() ? fmt::format("{:.4g} s", typical_s(contender))
                                          : std::string(status_name(contender.guarded.status)));
    separator = ", ";
  }
  return line;
}

class ScalingExperiment {
 public:
  ScalingExperiment(const ScalingConfig& config, const Registry<AnySequenceSearch>& menu)
      : config_(config) {
    for (const StrategyChoice& choice : config.strategies)
      searches_.push_back(menu.make(choice.name, choice.options));
  }

  /// `easier` is the cell before this one in the same study, or null.
  void run_guarded_cell(CellResult& cell, const CellResult* easier) const {
    const CompiledProblem problem = compile(cell_problem(cell.options, config_.seed));
    for (std::size_t i = 0; i < searches_.size(); ++i) {
      SearchRun& run = cell.contenders[i].guarded;
      if (easier != nullptr && is_unfinished(easier->contenders[i].guarded.status))
        run.status = RunStatus::kNotTried;
      else
        run = run_guarded(searches_[i], problem.graph, count_of(cell), config_.limits);
    }
    mark_disagreement(cell);
  }

  void run_paired_cell(CellResult& cell) const {
    const CompiledProblem problem = compile(cell_problem(cell.options, config_.seed));
    for (int round = 0; round < config_.rounds; ++round) {
      for (const std::size_t i : order(cell, round)) {
        ContenderResult& contender = cell.contenders[i];
        if (!contender.is_ok() || round >= rounds_of(contender)) continue;
        const bool is_best_missing = cell.best.steps.empty();
        contender.rounds.push_back(run_search(searches_[i], problem.graph, count_of(cell),
                                              is_best_missing ? &cell.best : nullptr));
        // Not the same costs as alone: no strategy may depend on what ran before it.
        if (contender.rounds.back().cost_digest != contender.guarded.cost_digest)
          contender.guarded.status = RunStatus::kDisagrees;
      }
    }
  }

 private:
  static std::uint64_t count_of(const CellResult& cell) {
    return static_cast<std::uint64_t>(cell.options.k);
  }

  [[nodiscard]] int rounds_of(const ContenderResult& contender) const {
    const double fitting = config_.cell_budget_s / std::max(contender.guarded.total().wall_s, 1e-6);
    const int least = std::min(kLeastRounds, config_.rounds);
    return fitting >= config_.rounds ? config_.rounds : std::max(least, static_cast<int>(fitting));
  }

  /// Fisher and Yates; the best path is kept of the first strategy in the first round, so that this
  /// round is not shuffled.
  [[nodiscard]] std::vector<std::size_t> order(const CellResult& cell, int round) const {
    std::vector<std::size_t> out(searches_.size());
    std::iota(out.begin(), out.end(), std::size_t{0});
    if (round == 0) return out;
    Rng rng(derive_seed(config_.seed, {seed_key("order"), cell.study, seed_key(to_string(cell)),
                                       static_cast<std::uint64_t>(round)}));
    for (std::size_t i = out.size(); i > 1; --i) std::swap(out[i - 1], out[rng.index(i)]);
    return out;
  }
  static std::string to_string(const CellResult& cell) { return fmt::format("{}", cell.value); }

  const ScalingConfig& config_;
  std::vector<AnySequenceSearch> searches_;
};

}  // namespace

sequences::SequenceProblem cell_problem(const CellOptions& options, std::uint64_t seed) {
  return street_problem(street_database(options, seed), options);
}

std::vector<CellResult> run_scaling(const ScalingConfig& config,
                                    const Registry<AnySequenceSearch>& menu,
                                    const std::function<void(const std::string&)>& tell) {
  const ScalingExperiment experiment(config, menu);
  std::vector<CellResult> cells = cells_of(config);
  // All guarded runs first: a process that has begun threads is not forked any more.
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const bool is_behind = c > 0 && cells[c - 1].study == cells[c].study &&
                           config.studies[cells[c].study].is_easiest_first;
    experiment.run_guarded_cell(cells[c], is_behind ? &cells[c - 1] : nullptr);
    tell(line_of(config, cells[c], "alone"));
  }
  for (CellResult& cell : cells) {
    experiment.run_paired_cell(cell);
    tell(line_of(config, cell, "paired"));
  }
  return cells;
}

}  // namespace plat::rcksp
