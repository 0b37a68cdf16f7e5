#include "harness/subdivision.h"

#include "parcels/coverage.h"

namespace plat::harness {
namespace {

/// The strategy as it divides one block: fitted, but for what the config asks for.
ConfiguredSubdivider strategy_for(const StrategyConfig& strategy,
                                  const parcels::ParcelStyle* style) {
  const ConfiguredSubdivider base(strategy.name, strategy.options);
  return style == nullptr || strategy.fit == Fit::kNone ? base : base.fitted(*style);
}

}  // namespace

ConfiguredSubdivider::ConfiguredSubdivider(std::string_view name, OptionMap given)
    : given_(std::move(given)), subdivider_(parcels::block_subdividers().make(name, given_)) {}

ConfiguredSubdivider ConfiguredSubdivider::fitted(const parcels::ParcelStyle& style) const {
  ConfiguredSubdivider out = *this;
  OptionMap options = subdivider_.fitted(style).options();
  for (const auto& [key, value] : given_) options.insert_or_assign(key, value);
  out.subdivider_ = parcels::block_subdividers().make(subdivider_.name(), options);
  return out;
}

std::vector<DividedBlock> subdivide_blocks(std::span<const blocks::Block> blocks,
                                           const StrategyConfig& strategy,
                                           std::span<const parcels::ParcelStyle> styles,
                                           std::string_view dataset, std::uint64_t seed,
                                           int repetition, Jobs jobs, Progress& progress,
                                           std::span<parcels::SubdivisionTrace> traces) {
  expects(traces.empty() || traces.size() == blocks.size(), "one trace per block");
  expects(styles.empty() || styles.size() == blocks.size(), "one style per block");
  const std::uint64_t dataset_key = seed_key(dataset);
  return parallel_map<DividedBlock>(blocks.size(), jobs, [&](std::size_t i) {
    const blocks::Block& block = blocks[i];
    DividedBlock out;
    out.block = block.id;
    out.seed =
        derive_seed(seed, {dataset_key, block.id.value, static_cast<std::uint64_t>(repetition)});
    const parcels::ParcelStyle* style = styles.empty() ? nullptr : &styles[i];
    if (style != nullptr && style->count == 0 && strategy.fit == Fit::kPerBlock) {
      out.options = parcels::block_subdividers().make(strategy.name, strategy.options).options();
      out.parcels = fail(FailureCode::kNoObservation,
                         "no observed parcels in this block to fit the options to");
      progress.step();
      return out;
    }
    const ConfiguredSubdivider subdivider = strategy_for(strategy, style);
    out.options = subdivider.options();
    Rng rng(out.seed);
    out.parcels = traces.empty() ? subdivider.subdivide(block, rng)
                                 : subdivider.subdivide(block, rng, traces[i]);
    if (out.parcels) {
      if (auto defect = parcels::find_coverage_defect(block.contour, *out.parcels,
                                                      parcels::kContourTolerance_m)) {
        out.parcels = tl::unexpected<Failure>(*std::move(defect));
      }
    }
    if (out.parcels) {
      std::vector<Polygon> shapes;
      for (const parcels::Parcel& p : *out.parcels) shapes.push_back(p.shape);
      out.measures = parcels::measure_parcels(block, shapes);
    }
    progress.step();
    return out;
  });
}

}  // namespace plat::harness
