#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "blocks/block.h"
#include "core/parallel.h"
#include "core/progress.h"
#include "harness/experiment_config.h"
#include "parcels/block_subdivider.h"
#include "parcels/parcel_measures.h"

namespace plat::harness {

/// A strategy of the menu whose given options win over those that a style implies.
class ConfiguredSubdivider {
 public:
  /// @throws InputError for an unknown name, key or value
  explicit ConfiguredSubdivider(std::string_view name, OptionMap given = {});

  [[nodiscard]] Expected<std::vector<parcels::Parcel>> subdivide(const blocks::Block& block,
                                                                 Rng& rng) const {
    return subdivider_.subdivide(block, rng);
  }
  [[nodiscard]] Expected<std::vector<parcels::Parcel>> subdivide(
      const blocks::Block& block, Rng& rng, parcels::SubdivisionTrace& trace) const {
    return subdivider_.subdivide(block, rng, trace);
  }
  [[nodiscard]] ConfiguredSubdivider fitted(const parcels::ParcelStyle& style) const;
  [[nodiscard]] std::string_view name() const { return subdivider_.name(); }
  [[nodiscard]] OptionMap options() const { return subdivider_.options(); }

 private:
  OptionMap given_;
  parcels::AnyBlockSubdivider subdivider_;
};
static_assert(parcels::TracedBlockSubdivider<ConfiguredSubdivider>);

/// A block divided by one strategy.
struct DividedBlock {
  BlockId block;
  OptionMap options;       ///< as they ran, fitted ones included
  std::uint64_t seed = 0;  ///< of the block's stream
  Expected<std::vector<parcels::Parcel>> parcels = fail(FailureCode::kNoObservation, "");
  std::vector<parcels::ParcelMeasures> measures;  ///< one per parcel
};

/// Divides every block. Each meets its own stream, from (seed, data set, block, repetition) but not
/// from the strategy, so that strategies meet the same randomness. What a strategy returns is
/// checked to be a coverage; where it is not, the block is a failure kNotCovered. The result does
/// not depend on the thread count.
/// @param styles  one per block to fit the options to, or empty; a style of no parcels is a failure
/// kNoObservation
/// @param traces  one per block, to be filled with the inner steps, or empty
std::vector<DividedBlock> subdivide_blocks(std::span<const blocks::Block> blocks,
                                           const StrategyConfig& strategy,
                                           std::span<const parcels::ParcelStyle> styles,
                                           std::string_view dataset, std::uint64_t seed,
                                           int repetition, Jobs jobs, Progress& progress,
                                           std::span<parcels::SubdivisionTrace> traces = {});

}  // namespace plat::harness
