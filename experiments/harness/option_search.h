#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/parallel.h"
#include "harness/csv.h"
#include "harness/subdivision.h"

namespace plat::harness {

/// A point of the grid on the blocks outside one fold.
struct SearchRow {
  std::size_t fold = 0;       ///< the blocks that the score says nothing of
  OptionMap options;          ///< those that are searched
  std::vector<double> ks;     ///< per measure, against the observed parcels
  double score = 0.0;         ///< mean over the measures of ks / noise; small is good
  std::size_t undivided = 0;  ///< blocks that failed
  bool is_chosen = false;     ///< the best of its fold
};

/// What a search found on one data set.
struct SearchResult {
  std::vector<std::string> measures;
  std::vector<std::size_t> fold_of_block;
  std::vector<std::size_t> search_blocks;  ///< per fold: how many blocks the score is over
  std::vector<std::vector<double>> noise;  ///< per fold and measure: floor on those blocks
  std::vector<SearchRow> rows;             ///< by fold, then in the order of grid_points()

  /// What the blocks of a fold are divided with.
  [[nodiscard]] const SearchRow& chosen(std::size_t fold) const;
};

/// The observed place as a search sees it; all spans have one entry per block.
struct SearchPlace {
  std::string_view dataset;
  std::span<const blocks::Block> blocks;
  std::span<const parcels::ParcelStyle> styles;
  std::span<const std::vector<parcels::ParcelMeasures>> observed;
};

/// Scores every point of the strategy's grid on the blocks outside each fold and takes the best: no
/// block's own parcels help to choose the options that divide it. Folds are random parts of equal
/// size, the same for every strategy.
///
/// Guarantees: 1. the choice for a fold depends on no observed parcel of that fold;  2. the same
/// for any number of threads;  3. of equal scores, the point that comes first.
/// A block that a point cannot divide counts as one undivided parcel, so that failing does not pay.
/// A floor of zero (all values equal) counts as one observed parcel's step of the statistic.
/// Deviation: fitting a block's bounds to its own parcels, as in [VKW12, Sec. 6], goes on; only
/// what is searched is held out (ADR 0014).
/// @throws InputError for fewer than two blocks outside or one block in a fold
SearchResult search_options(const SearchPlace& place, const StrategyConfig& strategy,
                            int noise_repetitions, std::uint64_t seed, Jobs jobs);

/// Each block divided with the options chosen for its fold.
std::vector<DividedBlock> subdivide_by_fold(const SearchPlace& place,
                                            const StrategyConfig& strategy,
                                            const SearchResult& search, std::uint64_t seed,
                                            int repetition, Jobs jobs);

/// To keep a search beside the finished cells, and back.
nlohmann::json to_json(const SearchResult& result);
/// nullopt where the JSON is no search over `blocks` blocks.
std::optional<SearchResult> search_from(const nlohmann::json& json, std::size_t blocks);

/// search.csv (docs/run_directory.md): a row per fold, point and measure.
class SearchTable {
 public:
  SearchTable();
  void add(std::string_view dataset, const std::string& label, const SearchResult& result);
  [[nodiscard]] const std::string& text() const { return table_.text(); }

 private:
  CsvTable table_;
};

}  // namespace plat::harness
