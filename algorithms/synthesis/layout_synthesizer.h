#pragma once

#include <concepts>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>

#include "blocks/block_extraction.h"
#include "core/parallel.h"
#include "core/rng.h"
#include "parcels/block_subdivider.h"
#include "parcels/coverage.h"
#include "streets/street_grower.h"
#include "streets/street_width.h"
#include "synthesis/layout.h"
#include "synthesis/layout_steps.h"

namespace plat::synthesis {

struct SynthesisOptions {
  std::uint64_t seed = 1;
  streets::WidthOptions widths{};          ///< of streets that have none
  blocks::ExtractionOptions extraction{};  ///< of the blocks
};

/// Is told when a stage begins, with the number of its steps, and of every step; step() may be
/// called from any thread.
template <class W>
concept SynthesisWatcher = requires(W& watcher, SynthesisStage stage, std::size_t steps) {
  watcher.begin(stage, steps);
  watcher.step();
};

/// Does not care.
struct NoWatcher {
  void begin(SynthesisStage, std::size_t) {}
  void step() {}
};

namespace detail {

/// Name and options of a strategy, typed or chosen by name.
template <class S>
std::string strategy_name(const S& subdivider) {
  if constexpr (requires { subdivider.name(); }) {
    return std::string(subdivider.name());
  } else if constexpr (requires { S::kName; }) {
    return std::string(S::kName);
  } else {
    return {};
  }
}

template <class S>
OptionMap options_of(const S& subdivider) {
  if constexpr (requires {
                  { subdivider.options() } -> std::convertible_to<OptionMap>;
                }) {
    return subdivider.options();
  } else if constexpr (requires { to_option_map(subdivider.options()); }) {
    return to_option_map(subdivider.options());
  } else {
    return {};
  }
}

}  // namespace detail

/// Synthesizes a layout from attributed points: streets, their widths, blocks, and in each block
/// parcels of the size that the points around it store.
///
/// Guarantees: 1. the parcels of a block are a coverage of it, or it is a failure row;  2. the same
/// site, strategies and seed give the same layout, bit for bit, whatever the thread count;  3. a
/// strategy gives the same layout by its type and by its name;  4. each block has a random stream
/// of its own, from the seed and its id.
/// Paper: [AVB08, Fig. 3], without the images (stage `imagery`)
template <streets::StreetGrower G, parcels::BlockSubdivider S>
class LayoutSynthesizer {
 public:
  LayoutSynthesizer(G grower, S subdivider, SynthesisOptions options = {})
      : grower_(std::move(grower)),
        subdivider_(std::move(subdivider)),
        options_(std::move(options)) {}

  /// @returns the grower's Failure where the site cannot be used
  template <SynthesisWatcher W>
  [[nodiscard]] Expected<Layout> synthesize(const LayoutSite& site, Jobs jobs, W& watcher) const {
    watcher.begin(SynthesisStage::kStreets, 1);
    Rng rng(derive_seed(options_.seed, {seed_key("streets")}));
    Expected<streets::Growth> growth = grower_.grow(site.growth, rng);
    if (!growth) return tl::unexpected<Failure>(std::move(growth.error()));
    Layout layout = layout_of_streets(site, *std::move(growth), options_.widths, jobs);
    watcher.step();
    watcher.begin(SynthesisStage::kBlocks, 1);
    add_blocks(layout, site, options_.extraction, jobs);
    watcher.step();
    watcher.begin(SynthesisStage::kParcels, layout.blocks.size());
    parallel_for(layout.blocks.size(), jobs, [&](std::size_t b) {
      divide(layout.blocks[b]);
      watcher.step();
    });
    add_parcel_failures(layout);
    return layout;
  }
  [[nodiscard]] Expected<Layout> synthesize(const LayoutSite& site, Jobs jobs = {}) const {
    NoWatcher nobody;
    return synthesize(site, jobs, nobody);
  }

 private:
  void divide(LayoutBlock& block) const {
    const S subdivider =
        block.style_source == StyleSource::kNone ? subdivider_ : subdivider_.fitted(block.style);
    block.strategy = detail::strategy_name(subdivider);
    block.options = detail::options_of(subdivider);
    block.seed = derive_seed(options_.seed, {seed_key("parcels"), block.block.id.value});
    Rng rng(block.seed);
    block.parcels = subdivider.subdivide(block.block, rng);
    if (!block.parcels) return;
    if (auto defect = parcels::find_coverage_defect(block.block.contour, *block.parcels,
                                                    parcels::kContourTolerance_m))
      block.parcels = tl::unexpected<Failure>(*std::move(defect));
  }

  G grower_;
  S subdivider_;
  SynthesisOptions options_;
};

}  // namespace plat::synthesis
