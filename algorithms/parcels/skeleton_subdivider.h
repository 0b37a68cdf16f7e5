#pragma once

#include <optional>
#include <string_view>
#include <tuple>
#include <vector>

#include "parcels/block_subdivider.h"
#include "parcels/strips.h"

namespace plat::parcels {

class StripLots;

/// What a block's patio (what the strips do not reach) is divided by.
enum class InnerDivision {
  kKeep,      ///< one parcel
  kObb,       ///< ObbSubdivider, by the same bounds
  kSkeleton,  ///< as the block itself, without an offset and with its rim as the street
};

/// Divides a block into rows of parcels along its streets, cut from the strips of its straight
/// skeleton; what is deeper than `offset_m` becomes a patio.
///
/// Guarantees, besides the family's contract: 1. every parcel outside the patios has street access
/// if the block has any street edge;  2. no parcel outside the patios is below area_min_m2, or a
/// triangle below the mean of the area bounds, unless it is the only one. Paper: [VKW12, Sec. 4.2,
/// Alg. 1]; `offset_m` is its d_offset, `irregularity` its omega. Deviation: triangular lots are
/// merged only below the mean of the area bounds; a strip's spacings are scaled to fill its front;
/// a row counts as shallow by `shallow_share`; a large lot is halved only while its front keeps
/// half the mean width; without street labels every outer edge counts as a street; the skeleton is
/// that of a simplified contour, the parcels those of the full one; a patio that its inner division
/// cannot divide stays whole; fitted bounds of area are at most half and at least four thirds of
/// the mean (ADR 0006).
class SkeletonSubdivider {
 public:
  static constexpr std::string_view kName = "skeleton";
  static constexpr std::string_view kSummary =
      "strips of the straight skeleton, sliced into lots [VKW12, Sec. 4.2]";

  struct Options {
    double area_min_m2 = 150.0;  ///< smaller lots are merged
    double area_max_m2 = 900.0;  ///< larger lots are cut once more
    double width_min_m = 10.0;   ///< lots are as wide as the mean of the width bounds
    double width_max_m = 20.0;   ///< upper bound of width
    double irregularity = 0.2;   ///< omega: the variance of spacings is 3 omega m2
    CornerScheme corners = CornerScheme::kStreetWidth;  ///< which strip gets a corner region
    std::optional<double> offset_m =
        std::nullopt;  ///< d_offset: depth of the strips; absent: infinite
    InnerDivision inner = InnerDivision::kKeep;  ///< what a patio is divided by
    /// Two rows become one where they are less deep than this share of the expected depth of a lot,
    /// mean area by mean width. At 1 / sqrt(2) one row is as much too deep as two are too shallow.
    double shallow_share = 0.7;
    double simplify_m = 0.35;     ///< tolerance of the contour that the skeleton is built on
    double fit_deviations = 2.0;  ///< k: bounds fitted to observed parcels are mean +- k deviations

    static constexpr auto fields() {
      return std::tuple{
          Field{"area_min_m2", &Options::area_min_m2, -1e9, 1e9,
                "A_min: smaller lots are merged with a neighbour, m2; negative where the observed "
                "spread is large"},
          Field{"area_max_m2", &Options::area_max_m2, 1.0, 1e12,
                "A_max: larger lots are cut once more by a ray from the street, m2"},
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
          OptionalField{"offset_m", &Options::offset_m, 1.0, 1e5,
                        "d_offset: depth of the rows along the streets, m; what lies deeper is a "
                        "patio; none = no patio"},
          EnumField<Options, InnerDivision, 3>{"inner",
                                               &Options::inner,
                                               {{"keep", InnerDivision::kKeep},
                                                {"obb", InnerDivision::kObb},
                                                {"skeleton", InnerDivision::kSkeleton}},
                                               "what a patio is divided by"},
          Field{"shallow_share", &Options::shallow_share, 0.0, 1.0,
                "two rows less deep than this share of a lot's expected depth become one; 0 = "
                "never"},
          Field{"simplify_m", &Options::simplify_m, 0.0, 10.0,
                "tolerance of the contour that the skeleton is built on, m"},
          Field{"fit_deviations", &Options::fit_deviations, 0.0, 10.0,
                "k: fitted bounds are mean +- k deviations"}};
    }
  };

  explicit SkeletonSubdivider(const Options& options) : options_(options) {}

  [[nodiscard]] Expected<std::vector<Parcel>> subdivide(const blocks::Block& block, Rng& rng) const;
  /// The same parcels, the steps shown (skeleton_steps.h).
  [[nodiscard]] Expected<std::vector<Parcel>> subdivide(const blocks::Block& block, Rng& rng,
                                                        SubdivisionTrace& trace) const;
  [[nodiscard]] SkeletonSubdivider fitted(const ParcelStyle& style) const;
  [[nodiscard]] const Options& options() const { return options_; }

 private:
  struct Plan;
  [[nodiscard]] Expected<Plan> plan(const blocks::Block& block, Rng& rng) const;
  [[nodiscard]] Expected<std::vector<Parcel>> divide(const Plan& plan, Rng& rng) const;
  [[nodiscard]] Expected<StripLots> cut_lots(const Plan& plan, Rng& rng) const;
  [[nodiscard]] std::vector<Segment> inner_cuts(const blocks::Block& block, const Polygon& patio,
                                                Rng& rng) const;

  Options options_;
};
static_assert(BlockSubdivider<SkeletonSubdivider> && Registrable<SkeletonSubdivider>);

}  // namespace plat::parcels
