#include "harness/experiment.h"

#include <fmt/format.h>

#include <chrono>
#include <nlohmann/json.hpp>

#include "core/atomic_file.h"
#include "core/progress.h"
#include "geodata/dataset_catalogue.h"
#include "harness/build_info.h"
#include "harness/cell_store.h"
#include "harness/city.h"
#include "harness/city_layers.h"
#include "harness/comparison_tables.h"
#include "harness/option_search.h"
#include "harness/run_tables.h"

namespace plat::harness {
namespace {

using nlohmann::json;

/// Seconds per step, for timings.json.
class Stopwatch {
 public:
  void lap(const std::string& step) {
    const auto now = std::chrono::steady_clock::now();
    laps_.push_back(
        {{"step", step}, {"seconds", std::chrono::duration<double>(now - last_).count()}});
    last_ = now;
  }
  [[nodiscard]] const json& laps() const { return laps_; }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
  json laps_ = json::array();
};

/// One data set on its way through the grid.
class DatasetRun {
 public:
  DatasetRun(const ExperimentConfig& config, const geodata::Dataset& dataset,
             std::filesystem::path out, Jobs jobs, Stopwatch& watch)
      : config_(config),
        dataset_(dataset),
        out_(std::move(out)),
        jobs_(jobs),
        watch_(watch),
        city_(load_city(dataset, jobs)) {
    watch_.lap("read " + dataset.name);
    for (const ObservedBlock& observed : city_.blocks) blocks_.push_back(observed.block);
    styles_ = parallel_map<parcels::ParcelStyle>(blocks_.size(), jobs, [&](std::size_t i) {
      return parcels::style_of(blocks_[i], city_.blocks[i].parcels);
    });
    observed_.label = "observed";
    observed_.per_block = parallel_map<std::vector<parcels::ParcelMeasures>>(
        city_.blocks.size(), jobs, [&](std::size_t i) {
          return parcels::measure_parcels(city_.blocks[i].block, city_.blocks[i].parcels);
        });
    input_digest_ = input_digest(blocks_, styles_);
    watch_.lap("measure observed " + dataset.name);
  }

  void run_strategy(const StrategyConfig& strategy, Resume resume, ExperimentOutcome& outcome) {
    searches_.push_back(find_options(strategy, resume, outcome));
    MeasuredLayer measured{strategy.label,
                           std::vector<std::vector<parcels::ParcelMeasures>>(blocks_.size())};
    std::vector<std::vector<DividedBlock>> repetitions;
    for (int repetition = 0; repetition < config_.repetitions; ++repetition) {
      repetitions.push_back(run_cell(strategy, searches_.back(), repetition, resume, outcome));
      for (std::size_t i = 0; i < blocks_.size(); ++i) {
        const DividedBlock& block = repetitions.back()[i];
        measured.per_block[i].insert(measured.per_block[i].end(), block.measures.begin(),
                                     block.measures.end());
        ++outcome.blocks;
        outcome.failures += block.parcels ? 0 : 1;
      }
    }
    layers_.push_back(std::move(measured));
    divided_.push_back(std::move(repetitions));
    watch_.lap(fmt::format("subdivide {} {}", dataset_.name, strategy.label));
  }

  void write_rows(RunTables& tables) const {
    for (std::size_t i = 0; i < blocks_.size(); ++i) {
      for (std::size_t k = 0; k < observed_.per_block[i].size(); ++k) {
        tables.add_parcel(dataset_.name, "observed", 0, blocks_[i].id,
                          city_.blocks[i].parcel_ids[k], observed_.per_block[i][k]);
      }
      BlockRow row = row_of("observed", 0, i);
      row.style = styles_[i];
      row.ks_area = 0.0;
      tables.add_block(dataset_.name, row);
    }
    for (std::size_t s = 0; s < divided_.size(); ++s) {
      for (int repetition = 0; repetition < config_.repetitions; ++repetition) {
        const std::vector<DividedBlock>& cell = divided_[s][static_cast<std::size_t>(repetition)];
        for (std::size_t i = 0; i < cell.size(); ++i)
          write_divided(config_.strategies[s].label, repetition, i, cell[i], tables);
      }
    }
  }

  void write_searches(SearchTable& table) const {
    for (std::size_t s = 0; s < searches_.size(); ++s) {
      if (searches_[s]) table.add(dataset_.name, config_.strategies[s].label, *searches_[s]);
    }
  }

  void write_comparison(ComparisonTables& tables) {
    const std::vector<statistics::MeasureSamples> samples = measure_samples(observed_, layers_);
    tables.add(dataset_.name, layers_,
               statistics::compare(samples, config_.statistics, config_.seed, jobs_));
    watch_.lap("statistics " + dataset_.name);
  }

  void write_layout(ExperimentOutcome& outcome) {
    std::vector<geodata::Layer> layers;
    ParcelLayer observed("observed", city_.frame);
    for (std::size_t i = 0; i < blocks_.size(); ++i) {
      for (std::size_t k = 0; k < city_.blocks[i].parcels.size(); ++k) {
        observed.add(blocks_[i].id, city_.blocks[i].parcel_ids[k], 0, "observed",
                     city_.blocks[i].parcels[k], observed_.per_block[i][k]);
      }
    }
    layers.push_back(observed.layer());
    FailureLayer failures(city_.frame);
    for (const blocks::BlockFailure& failure : city_.failures) {
      failures.add(failure.feature_id, "input", 0, failure.failure, failure.shape);
      ++outcome.input_failures;
    }
    for (std::size_t s = 0; s < divided_.size(); ++s) {
      ParcelLayer parcels(config_.strategies[s].label, city_.frame);
      for (int repetition = 0; repetition < config_.repetitions; ++repetition) {
        const auto& cell = divided_[s][static_cast<std::size_t>(repetition)];
        parcels.add(cell, repetition, config_.strategies[s].label);
        for (std::size_t i = 0; i < cell.size(); ++i) {
          if (cell[i].parcels) continue;
          failures.add(fmt::format("{}", cell[i].block.value), config_.strategies[s].label,
                       repetition, cell[i].parcels.error(), blocks_[i].contour);
        }
      }
      layers.push_back(parcels.layer());
    }
    layers.push_back(block_layer(blocks_, city_.frame));
    layers.push_back(failures.layer());
    geodata::write_layers(out_ / fmt::format("layout_{}.gpkg", dataset_.name), layers);
    watch_.lap("write layout " + dataset_.name);
  }

  [[nodiscard]] json describe() const {
    std::size_t parcels = 0;
    for (const auto& block : observed_.per_block) parcels += block.size();
    return {{"name", dataset_.name},
            {"title", dataset_.title},
            {"licence", dataset_.licence},
            {"attribution", dataset_.attribution},
            {"source", dataset_.source},
            {"plots", geodata::plot_origin_name(city_.plots)},
            {"crs", dataset_.crs},
            {"blocks", blocks_.size()},
            {"parcels", parcels},
            {"input_failures", city_.failures.size()},
            {"repairs", city_.repairs.size()},
            {"searches", describe_searches()}};
  }

 private:
  [[nodiscard]] json describe_searches() const {
    json out = json::array();
    for (std::size_t s = 0; s < searches_.size(); ++s) {
      if (!searches_[s]) continue;
      for (std::size_t fold = 0; fold < searches_[s]->search_blocks.size(); ++fold) {
        const SearchRow& chosen = searches_[s]->chosen(fold);
        out.push_back({{"layer", config_.strategies[s].label},
                       {"fold", fold},
                       {"options", options_json(chosen.options)},
                       {"score", chosen.score}});
      }
    }
    return out;
  }

  [[nodiscard]] BlockRow row_of(std::string layer, int repetition, std::size_t i) const {
    BlockRow row;
    row.layer = std::move(layer);
    row.repetition = repetition;
    row.block = blocks_[i].id;
    row.block_area_m2 = area_m2(blocks_[i].contour);
    row.observed_parcels = styles_[i].count;
    return row;
  }

  void write_divided(const std::string& label, int repetition, std::size_t i,
                     const DividedBlock& block, RunTables& tables) const {
    BlockRow row = row_of(label, repetition, i);
    row.options = to_string(block.options);
    row.seed = block.seed;
    if (block.parcels) {
      std::vector<Polygon> shapes;
      for (std::size_t k = 0; k < block.parcels->size(); ++k) {
        const parcels::Parcel& parcel = (*block.parcels)[k];
        shapes.push_back(parcel.shape);
        tables.add_parcel(dataset_.name, label, repetition, block.block,
                          fmt::format("{}", parcel.id.value), block.measures[k]);
      }
      row.style = parcels::style_of(blocks_[i], shapes);
      row.ks_area = area_ks(observed_.per_block[i], block.measures);
    } else {
      row.failure = block.parcels.error();
    }
    tables.add_block(dataset_.name, row);
  }

  [[nodiscard]] json key_of(const StrategyConfig& strategy) const {
    json key = build_info();
    key["dataset"] = dataset_.name;
    key["input"] = input_digest_;
    key["strategy"] = {strategy.name, to_string(strategy.options),
                       strategy.fit == Fit::kNone ? "none" : "per_block"};
    key["seed"] = config_.seed;
    if (strategy.search) {
      key["search"] = to_json(*strategy.search);
      key["noise_repetitions"] = config_.statistics.noise_repetitions;
    }
    return key;
  }

  [[nodiscard]] SearchPlace place() const {
    return {dataset_.name, blocks_, styles_, observed_.per_block};
  }

  std::optional<SearchResult> find_options(const StrategyConfig& strategy, Resume resume,
                                           ExperimentOutcome& outcome) {
    if (!strategy.search) return std::nullopt;
    const CellStore store(out_ / "cells");
    const std::string name = fmt::format("{}__{}__search", dataset_.name, strategy.label);
    const std::string key = key_of(strategy).dump();
    if (resume == Resume::kYes) {
      if (const auto note = store.load_note(name, key)) {
        if (auto search = search_from(*note, blocks_.size())) {
          ++outcome.resumed_cells;
          return search;
        }
      }
    }
    SearchResult search = search_options(place(), strategy, config_.statistics.noise_repetitions,
                                         config_.seed, jobs_);
    store.save_note(name, key, to_json(search));
    watch_.lap(fmt::format("search {} {}", dataset_.name, strategy.label));
    return search;
  }

  std::vector<DividedBlock> run_cell(const StrategyConfig& strategy,
                                     const std::optional<SearchResult>& search, int repetition,
                                     Resume resume, ExperimentOutcome& outcome) {
    const CellStore store(out_ / "cells");
    const std::string name = fmt::format("{}__{}__{}", dataset_.name, strategy.label, repetition);
    const std::string key = key_of(strategy).dump();
    if (resume == Resume::kYes) {
      if (auto cell = store.load(name, key); cell && cell->size() == blocks_.size()) {
        parallel_for(cell->size(), jobs_,
                     [&](std::size_t i) { measure_again((*cell)[i], blocks_[i]); });
        ++outcome.resumed_cells;
        return *std::move(cell);
      }
    }
    std::vector<DividedBlock> cell = divide(strategy, search, repetition);
    store.save(name, key, cell);
    return cell;
  }

  std::vector<DividedBlock> divide(const StrategyConfig& strategy,
                                   const std::optional<SearchResult>& search, int repetition) {
    if (search)
      return subdivide_by_fold(place(), strategy, *search, config_.seed, repetition, jobs_);
    Progress progress(fmt::format("{} on {}", strategy.label, dataset_.name), blocks_.size());
    return subdivide_blocks(blocks_, strategy, styles_, dataset_.name, config_.seed, repetition,
                            jobs_, progress);
  }

  static void measure_again(DividedBlock& divided, const blocks::Block& block) {
    if (!divided.parcels) return;
    std::vector<Polygon> shapes;
    for (const parcels::Parcel& p : *divided.parcels) shapes.push_back(p.shape);
    divided.measures = parcels::measure_parcels(block, shapes);
  }

  const ExperimentConfig& config_;
  const geodata::Dataset& dataset_;
  std::filesystem::path out_;
  Jobs jobs_;
  Stopwatch& watch_;
  City city_;
  std::vector<blocks::Block> blocks_;
  std::vector<parcels::ParcelStyle> styles_;
  std::uint64_t input_digest_ = 0;
  MeasuredLayer observed_;
  std::vector<std::optional<SearchResult>> searches_;  ///< per strategy
  std::vector<MeasuredLayer> layers_;                  ///< per strategy
  std::vector<std::vector<std::vector<DividedBlock>>>
      divided_;  ///< per strategy, repetition, block
};

}  // namespace

ExperimentOutcome run_experiment(const ExperimentConfig& config, const std::filesystem::path& out,
                                 Jobs jobs, Resume resume) {
  std::error_code error;
  if (std::filesystem::exists(out, error) && !std::filesystem::is_directory(out, error))
    throw InputError(fmt::format("{}: is a file; --out names a folder", out.string()));
  for (const std::string& name : config.datasets) expect_present(geodata::dataset(name));
  std::filesystem::create_directories(out, error);
  if (error) throw InputError(fmt::format("{}: cannot be made: {}", out.string(), error.message()));
  std::filesystem::remove(out / "manifest.json", error);  // what is there now is no longer a run
  ExperimentOutcome outcome;
  Stopwatch watch;
  RunTables tables;
  ComparisonTables comparison;
  SearchTable searches;
  json datasets = json::array();
  for (const std::string& name : config.datasets) {
    DatasetRun run(config, geodata::dataset(name), out, jobs, watch);
    for (const StrategyConfig& strategy : config.strategies)
      run.run_strategy(strategy, resume, outcome);
    run.write_rows(tables);
    run.write_searches(searches);
    run.write_comparison(comparison);
    run.write_layout(outcome);
    datasets.push_back(run.describe());
  }
  tables.write(out);
  comparison.write(out);
  write_file(out / "search.csv", searches.text());
  watch.lap("write tables");
  write_file(out / "timings.json", watch.laps().dump(1) + "\n");
  json manifest = build_info();
  const json as_run = to_json(config);
  manifest["experiment"] = config.experiment;
  manifest["config"] = as_run;
  manifest["seed"] = config.seed;
  manifest["repetitions"] = config.repetitions;
  manifest["strategies"] = as_run["strategies"];
  manifest["datasets"] = datasets;
  write_file(out / "manifest.json", manifest.dump(1) + "\n");
  return outcome;
}

}  // namespace plat::harness
