#pragma once

#include <concepts>
#include <memory>
#include <string_view>
#include <vector>

#include "blocks/block.h"
#include "core/failure.h"
#include "core/options.h"
#include "core/registry.h"
#include "core/rng.h"
#include "parcels/parcel.h"
#include "parcels/parcel_style.h"
#include "parcels/subdivision_trace.h"

namespace plat::parcels {

/// Divides a block into parcels.
///
/// Contract, tested over the whole registry: 1. the parcels are a coverage of the block, exactly
/// (coverage.h);
/// 2. every parcel is a valid polygon with an area, on the working grid;  3. the same block and
/// stream give the same parcels, bit for bit;  4. ids are 0 .. n-1 in order;  5. `fitted` keeps
/// every option that the style says nothing of. A block that cannot be divided is a Failure, never
/// an exception.
template <class S>
concept BlockSubdivider =
    requires(const S& subdivider, const blocks::Block& block, Rng& rng, const ParcelStyle& style) {
      { subdivider.subdivide(block, rng) } -> std::same_as<Expected<std::vector<Parcel>>>;
      /// The strategy with the options that the observed style implies [VKW12, Sec. 6 (iii)].
      { subdivider.fitted(style) } -> std::same_as<S>;
    };

/// A strategy that shows its inner steps.
///
/// Contract, tested over the registry: the parcels are those that it makes when nobody watches.
template <class S>
concept TracedBlockSubdivider =
    BlockSubdivider<S> &&
    requires(const S& subdivider, const blocks::Block& block, Rng& rng, SubdivisionTrace& trace) {
      { subdivider.subdivide(block, rng, trace) } -> std::same_as<Expected<std::vector<Parcel>>>;
    };

/// Any strategy of the family, chosen at run time.
class AnyBlockSubdivider {
 public:
  template <class S>
    requires(BlockSubdivider<S> && Registrable<S> && !std::same_as<S, AnyBlockSubdivider>)
  explicit AnyBlockSubdivider(S subdivider)
      : self_(std::make_shared<const Model<S>>(std::move(subdivider))) {}

  [[nodiscard]] Expected<std::vector<Parcel>> subdivide(const blocks::Block& block,
                                                        Rng& rng) const {
    return self_->subdivide(block, rng);
  }
  /// The same, inner steps kept in `trace`; a strategy that shows none leaves it as it is.
  [[nodiscard]] Expected<std::vector<Parcel>> subdivide(const blocks::Block& block, Rng& rng,
                                                        SubdivisionTrace& trace) const {
    return self_->subdivide(block, rng, trace);
  }
  [[nodiscard]] AnyBlockSubdivider fitted(const ParcelStyle& style) const {
    return self_->fitted(style);
  }
  [[nodiscard]] std::string_view name() const { return self_->name(); }
  [[nodiscard]] OptionMap options() const { return self_->options(); }

 private:
  struct Interface {
    virtual ~Interface() = default;
    [[nodiscard]] virtual Expected<std::vector<Parcel>> subdivide(const blocks::Block&,
                                                                  Rng&) const = 0;
    [[nodiscard]] virtual Expected<std::vector<Parcel>> subdivide(const blocks::Block&, Rng&,
                                                                  SubdivisionTrace&) const = 0;
    [[nodiscard]] virtual AnyBlockSubdivider fitted(const ParcelStyle&) const = 0;
    [[nodiscard]] virtual std::string_view name() const = 0;
    [[nodiscard]] virtual OptionMap options() const = 0;
  };
  template <class S>
  struct Model final : Interface {
    explicit Model(S s) : subdivider(std::move(s)) {}
    [[nodiscard]] Expected<std::vector<Parcel>> subdivide(const blocks::Block& block,
                                                          Rng& rng) const override {
      return subdivider.subdivide(block, rng);
    }
    [[nodiscard]] Expected<std::vector<Parcel>> subdivide(const blocks::Block& block, Rng& rng,
                                                          SubdivisionTrace& trace) const override {
      if constexpr (TracedBlockSubdivider<S>) return subdivider.subdivide(block, rng, trace);
      return subdivider.subdivide(block, rng);
    }
    [[nodiscard]] AnyBlockSubdivider fitted(const ParcelStyle& style) const override {
      return AnyBlockSubdivider(subdivider.fitted(style));
    }
    [[nodiscard]] std::string_view name() const override { return S::kName; }
    [[nodiscard]] OptionMap options() const override { return to_option_map(subdivider.options()); }
    S subdivider;
  };
  std::shared_ptr<const Interface> self_;
};
static_assert(TracedBlockSubdivider<AnyBlockSubdivider>);

/// The menu of block subdivision strategies.
const Registry<AnyBlockSubdivider>& block_subdividers();

}  // namespace plat::parcels
