#pragma once

#include <string_view>
#include <tuple>

#include "parcels/block_subdivider.h"
#include "parcels/strips.h"

namespace plat::parcels {

/// Divides a block into rows of parcels along its streets, cut from the strips of its straight
/// skeleton.
///
/// Guarantees, besides the family's contract: 1. every parcel has street access if the block has
/// any street edge. Paper:      [VKW12, Sec. 4.2, Alg. 1]; `irregularity` is its omega. No offset:
/// d_offset is infinite. Deviation:  triangular lots are merged only below the mean of the area
/// bounds; a strip's spacings are scaled to fill
///             its front; without street labels every outer edge counts as a street; the skeleton
///             is that of a simplified contour, the parcels that of the full one (ADR 0006).
class SkeletonSubdivider {
 public:
  static constexpr std::string_view kName = "skeleton";
  static constexpr std::string_view kSummary =
      "strips of the straight skeleton, sliced into lots [VKW12, Sec. 4.2]";

  struct Options {
    double area_min_m2 = 150.0;  ///< smaller lots are merged
    double area_max_m2 = 900.0;  ///< upper bound of area
    double width_min_m = 10.0;   ///< lots are as wide as the mean of the width bounds
    double width_max_m = 20.0;   ///< upper bound of width
    double irregularity = 0.2;   ///< omega: the variance of spacings is 3 omega m2
    CornerScheme corners = CornerScheme::kStreetWidth;  ///< which strip gets a corner region
    double simplify_m = 0.35;     ///< tolerance of the contour that the skeleton is built on
    double fit_deviations = 2.0;  ///< k: bounds fitted to observed parcels are mean +- k deviations

    static constexpr auto fields() {
      return std::tuple{
          Field{"area_min_m2", &Options::area_min_m2, 0.0, 1e9,
                "A_min: smaller lots are merged with a neighbour, m2"},
          Field{"area_max_m2", &Options::area_max_m2, 1.0, 1e12,
                "A_max: with A_min, the mean below which triangular lots are merged, m2"},
          Field{"width_min_m", &Options::width_min_m, -1e6, 1e5,
                "W_min: lots are (W_min + W_max) / 2 wide on average, m; negative where the "
                "observed spread is large"},
          Field{"width_max_m", &Options::width_max_m, 0.5, 1e6,
                "W_max: lots are (W_min + W_max) / 2 wide on average, m"},
          Field{"irregularity", &Options::irregularity, 0.0, 1.0,
                "omega: spacings have variance 3 omega, m2"},
          EnumField<Options, CornerScheme, 2>{"corners",
                                              &Options::corners,
                                              {{"street_width", CornerScheme::kStreetWidth},
                                               {"street_length", CornerScheme::kStreetLength}},
                                              "which strip a corner region goes to: that on the "
                                              "wider street, or that with the longer front"},
          Field{"simplify_m", &Options::simplify_m, 0.0, 10.0,
                "tolerance of the contour that the skeleton is built on, m"},
          Field{"fit_deviations", &Options::fit_deviations, 0.0, 10.0,
                "k: fitted bounds are mean +- k deviations"}};
    }
  };

  explicit SkeletonSubdivider(const Options& options) : options_(options) {}

  [[nodiscard]] Expected<std::vector<Parcel>> subdivide(const blocks::Block& block, Rng& rng) const;
  [[nodiscard]] SkeletonSubdivider fitted(const ParcelStyle& style) const;
  [[nodiscard]] const Options& options() const { return options_; }

 private:
  Options options_;
};
static_assert(BlockSubdivider<SkeletonSubdivider> && Registrable<SkeletonSubdivider>);

}  // namespace plat::parcels
