#pragma once

#include <string_view>
#include <tuple>

#include "parcels/block_style.h"
#include "parcels/block_subdivider.h"

namespace plat::parcels {

/// Divides each block by the strategy that its style names, fitted to what was observed there.
///
/// Guarantees, besides the family's contract: 1. the parcels are those of the named strategy with
/// the options of experiments/block_style, fitted to the observed means and deviations. Paper:
/// mixed styles, one per block [VKW12, Sec. 4.1 and 6], chosen there by the user;
///            `fitted` chooses by block_style_of.
/// Deviation: the observed numbers are options, so that a row tells all that ran (ADR 0015).
class HybridSubdivider {
 public:
  static constexpr std::string_view kName = "hybrid";
  static constexpr std::string_view kSummary =
      "another strategy in each block, told from its observed parcels [VKW12, Sec. 6]";

  struct Options {
    BlockStyle style = BlockStyle::kSkeleton;  ///< the strategy that divides
    double parcels = 12.0;                     ///< observed in the block; one: it stays whole
    double area_mean_m2 = 450.0;               ///< of the observed parcels, as all below
    double area_deviation_m2 = 150.0;
    double width_mean_m = 15.0;
    double width_deviation_m = 4.0;
    double irregularity = 0.2;   ///< omega of skeleton and obb
    double street_access = 0.8;  ///< xi of obb

    static constexpr auto fields() {
      return std::tuple{
          EnumField<Options, BlockStyle, 5>{"style",
                                            &Options::style,
                                            {{"skeleton", BlockStyle::kSkeleton},
                                             {"obb", BlockStyle::kObb},
                                             {"min_box", BlockStyle::kMinBox},
                                             {"recursive", BlockStyle::kRecursive},
                                             {"voronoi", BlockStyle::kVoronoi}},
                                            "the strategy that divides the block"},
          Field{"parcels", &Options::parcels, 0.0, 1e9,
                "observed parcels; a block of one stays whole under obb"},
          Field{"area_mean_m2", &Options::area_mean_m2, 0.0, 1e12,
                "mean area of the observed parcels, m2"},
          Field{"area_deviation_m2", &Options::area_deviation_m2, 0.0, 1e13,
                "standard deviation of their areas, m2"},
          Field{"width_mean_m", &Options::width_mean_m, 0.0, 1e6,
                "mean of their minimum widths, m"},
          Field{"width_deviation_m", &Options::width_deviation_m, 0.0, 1e7,
                "standard deviation of their minimum widths, m"},
          Field{"irregularity", &Options::irregularity, 0.0, 1.0, "omega of skeleton and obb"},
          Field{"street_access", &Options::street_access, 0.0, 1.0, "xi of obb"}};
    }
  };

  explicit HybridSubdivider(const Options& options) : options_(options) {}

  [[nodiscard]] Expected<std::vector<Parcel>> subdivide(const blocks::Block& block, Rng& rng) const;
  [[nodiscard]] HybridSubdivider fitted(const ParcelStyle& style) const;
  [[nodiscard]] const Options& options() const { return options_; }

 private:
  Options options_;
};
static_assert(BlockSubdivider<HybridSubdivider> && Registrable<HybridSubdivider>);

}  // namespace plat::parcels
