#include "harness/option_search.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numeric>

#include "statistics/noise_floor.h"

namespace plat::harness {
namespace {

using nlohmann::json;

/// Random parts whose sizes differ by one at most.
std::vector<std::size_t> deal_folds(std::size_t blocks, int folds, std::string_view dataset,
                                    std::uint64_t seed) {
  std::vector<std::size_t> order(blocks);
  std::iota(order.begin(), order.end(), std::size_t{0});
  Rng rng(derive_seed(seed, {seed_key("folds"), seed_key(dataset)}));
  for (std::size_t i = blocks; i > 1; --i)
    std::swap(order[i - 1], order[static_cast<std::size_t>(rng.index(i))]);
  std::vector<std::size_t> fold(blocks);
  for (std::size_t i = 0; i < blocks; ++i) fold[order[i]] = i % static_cast<std::size_t>(folds);
  return fold;
}

std::vector<const parcels::MeasureColumn*> columns_of(const std::vector<std::string>& measures) {
  std::vector<const parcels::MeasureColumn*> out;
  for (const std::string& name : measures) {
    for (const parcels::MeasureColumn& column : parcels::measure_columns()) {
      if (column.name == name) out.push_back(&column);
    }
  }
  expects(out.size() == measures.size(), "measures are known");
  return out;
}

using Measures = std::vector<parcels::ParcelMeasures>;

statistics::GroupedSample sample_of(std::span<const Measures> per_block,
                                    const parcels::MeasureColumn& column) {
  statistics::GroupedSample out;
  std::vector<double> values;
  for (const Measures& block : per_block) {
    values.clear();
    for (const parcels::ParcelMeasures& m : block) values.push_back(column.value(m));
    out.add_group(values);
  }
  return out;
}

/// What the score of a fold is measured with: the blocks outside it and what is observed there.
struct Yardstick {
  std::vector<std::size_t> blocks;
  std::vector<statistics::GroupedSample> observed;  ///< per measure
  std::vector<double> noise;                        ///< per measure, above zero
};

class Search {
 public:
  Search(const SearchPlace& place, const StrategyConfig& strategy, int noise_repetitions,
         std::uint64_t seed, Jobs jobs)
      : place_(place),
        strategy_(strategy),
        seed_(seed),
        jobs_(jobs),
        columns_(columns_of(strategy.search->measures)) {
    const auto folds = static_cast<std::size_t>(strategy.search->folds);
    if (place.blocks.size() < std::max<std::size_t>(folds, 4)) {
      throw InputError(
          fmt::format("data set \"{}\": {} blocks are too few for the search of \"{}\" "
                      "in {} folds",
                      place.dataset, place.blocks.size(), strategy.label, folds));
    }
    result_.measures = strategy.search->measures;
    result_.fold_of_block =
        deal_folds(place.blocks.size(), strategy.search->folds, place.dataset, seed);
    for (std::size_t fold = 0; fold < folds; ++fold) add_yardstick(fold, noise_repetitions);
  }

  SearchResult run() {
    const std::vector<OptionMap> points = grid_points(*strategy_.search);
    Progress progress(fmt::format("search for {} on {}", strategy_.label, place_.dataset),
                      points.size() * place_.blocks.size());
    std::vector<std::vector<SearchRow>> rows(yardsticks_.size());
    for (const OptionMap& point : points) {
      const std::vector<Measures> generated = divide(point, progress);
      for (std::size_t fold = 0; fold < yardsticks_.size(); ++fold)
        rows[fold].push_back(score(fold, point, generated));
    }
    for (std::vector<SearchRow>& of_fold : rows) {
      std::min_element(of_fold.begin(), of_fold.end(), [](const auto& a, const auto& b) {
        return a.score < b.score;
      })->is_chosen = true;
      result_.rows.insert(result_.rows.end(), of_fold.begin(), of_fold.end());
    }
    return std::move(result_);
  }

 private:
  void add_yardstick(std::size_t fold, int noise_repetitions) {
    Yardstick yardstick;
    for (std::size_t i = 0; i < place_.blocks.size(); ++i) {
      if (result_.fold_of_block[i] != fold) yardstick.blocks.push_back(i);
    }
    const std::uint64_t seed = derive_seed(seed_, {seed_key("noise floor")});
    for (const parcels::MeasureColumn* column : columns_) {
      yardstick.observed.push_back(
          statistics::select_groups(sample_of(place_.observed, *column), yardstick.blocks));
      const auto& values = yardstick.observed.back().values;
      const statistics::Bins bins =
          statistics::shared_bins(values, statistics::ValueKind::kContinuous);  // KS needs none
      const double floor =
          statistics::noise_floor(yardstick.observed.back(), bins, noise_repetitions, seed, jobs_)
              .mean[statistics::DistanceKind::kKolmogorovSmirnov];
      yardstick.noise.push_back(std::max(floor, 1.0 / static_cast<double>(values.size())));
    }
    result_.search_blocks.push_back(yardstick.blocks.size());
    result_.noise.push_back(yardstick.noise);
    yardsticks_.push_back(std::move(yardstick));
  }

  /// Measures per block; `is_undivided_` tells which blocks failed.
  std::vector<Measures> divide(const OptionMap& point, Progress& progress) {
    StrategyConfig strategy = strategy_;
    strategy.options.insert(point.begin(), point.end());
    std::vector<DividedBlock> divided = subdivide_blocks(place_.blocks, strategy, place_.styles,
                                                         place_.dataset, seed_, 0, jobs_, progress);
    std::vector<Measures> out;
    is_undivided_.clear();
    for (std::size_t i = 0; i < divided.size(); ++i) {
      is_undivided_.push_back(!divided[i].parcels.has_value());
      if (is_undivided_.back()) {
        const std::vector<Polygon> whole{place_.blocks[i].contour};
        divided[i].measures = parcels::measure_parcels(place_.blocks[i], whole);
      }
      out.push_back(std::move(divided[i].measures));
    }
    return out;
  }

  [[nodiscard]] SearchRow score(std::size_t fold, const OptionMap& point,
                                std::span<const Measures> generated) const {
    const Yardstick& yardstick = yardsticks_[fold];
    SearchRow row;
    row.fold = fold;
    row.options = point;
    for (std::size_t m = 0; m < columns_.size(); ++m) {
      const statistics::GroupedSample sample =
          statistics::select_groups(sample_of(generated, *columns_[m]), yardstick.blocks);
      row.ks.push_back(statistics::ks_statistic(yardstick.observed[m].values, sample.values));
      row.score += row.ks.back() / yardstick.noise[m] / static_cast<double>(columns_.size());
    }
    for (const std::size_t i : yardstick.blocks) row.undivided += is_undivided_[i] ? 1 : 0;
    return row;
  }

  const SearchPlace& place_;
  const StrategyConfig& strategy_;
  std::uint64_t seed_;
  Jobs jobs_;
  std::vector<const parcels::MeasureColumn*> columns_;
  std::vector<Yardstick> yardsticks_;  ///< per fold
  std::vector<bool> is_undivided_;
  SearchResult result_;
};

OptionMap options_from(const json& object) {
  OptionMap out;
  for (const auto& [key, value] : object.items()) {
    if (value.is_string()) {
      out.emplace(key, value.get<std::string>());
    } else {
      out.emplace(key, value.get<double>());
    }
  }
  return out;
}

}  // namespace

const SearchRow& SearchResult::chosen(std::size_t fold) const {
  const auto it = std::find_if(rows.begin(), rows.end(), [fold](const SearchRow& row) {
    return row.fold == fold && row.is_chosen;
  });
  expects(it != rows.end(), "every fold has a choice");
  return *it;
}

SearchResult search_options(const SearchPlace& place, const StrategyConfig& strategy,
                            int noise_repetitions, std::uint64_t seed, Jobs jobs) {
  expects(strategy.search.has_value(), "the strategy has a search");
  return Search(place, strategy, noise_repetitions, seed, jobs).run();
}

std::vector<DividedBlock> subdivide_by_fold(const SearchPlace& place,
                                            const StrategyConfig& strategy,
                                            const SearchResult& search, std::uint64_t seed,
                                            int repetition, Jobs jobs) {
  Progress progress(fmt::format("{} on {}", strategy.label, place.dataset), place.blocks.size());
  std::vector<DividedBlock> out(place.blocks.size());
  for (std::size_t fold = 0; fold < search.search_blocks.size(); ++fold) {
    std::vector<std::size_t> own;
    std::vector<blocks::Block> blocks;
    std::vector<parcels::ParcelStyle> styles;
    for (std::size_t i = 0; i < place.blocks.size(); ++i) {
      if (search.fold_of_block[i] != fold) continue;
      own.push_back(i);
      blocks.push_back(place.blocks[i]);
      styles.push_back(place.styles[i]);
    }
    StrategyConfig with_choice = strategy;
    const OptionMap& choice = search.chosen(fold).options;
    with_choice.options.insert(choice.begin(), choice.end());
    std::vector<DividedBlock> divided = subdivide_blocks(blocks, with_choice, styles, place.dataset,
                                                         seed, repetition, jobs, progress);
    for (std::size_t k = 0; k < own.size(); ++k) out[own[k]] = std::move(divided[k]);
  }
  return out;
}

json to_json(const SearchResult& result) {
  json rows = json::array();
  for (const SearchRow& row : result.rows) {
    rows.push_back({{"fold", row.fold},
                    {"options", options_json(row.options)},
                    {"ks", row.ks},
                    {"score", row.score},
                    {"undivided", row.undivided},
                    {"is_chosen", row.is_chosen}});
  }
  return {{"measures", result.measures},
          {"fold_of_block", result.fold_of_block},
          {"search_blocks", result.search_blocks},
          {"noise", result.noise},
          {"rows", std::move(rows)}};
}

std::optional<SearchResult> search_from(const json& object, std::size_t blocks) {
  try {
    SearchResult out;
    object.at("measures").get_to(out.measures);
    object.at("fold_of_block").get_to(out.fold_of_block);
    object.at("search_blocks").get_to(out.search_blocks);
    object.at("noise").get_to(out.noise);
    for (const json& row : object.at("rows")) {
      out.rows.push_back({row.at("fold").get<std::size_t>(), options_from(row.at("options")),
                          row.at("ks").get<std::vector<double>>(), row.at("score").get<double>(),
                          row.at("undivided").get<std::size_t>(), row.at("is_chosen").get<bool>()});
    }
    if (out.fold_of_block.size() != blocks || out.rows.empty()) return std::nullopt;
    return out;
  } catch (const json::exception&) {
    return std::nullopt;
  }
}

SearchTable::SearchTable()
    : table_("dataset,layer,fold,options,is_chosen,score,measure,ks,noise_mean,blocks,undivided") {}

void SearchTable::add(std::string_view dataset, const std::string& label,
                      const SearchResult& result) {
  for (const SearchRow& row : result.rows) {
    for (std::size_t m = 0; m < result.measures.size(); ++m) {
      table_.add_row(dataset, label, row.fold, to_string(row.options), row.is_chosen ? 1 : 0,
                     row.score, result.measures[m], row.ks[m], result.noise[row.fold][m],
                     result.search_blocks[row.fold], row.undivided);
    }
  }
}

}  // namespace plat::harness
