#pragma once

#include <string_view>
#include <tuple>

#include "parcels/block_subdivider.h"
#include "parcels/subdivision_trace.h"

namespace plat::parcels {

/// Splits a block recursively across the longer side of each lot's minimum-area oriented bounding
/// box.
///
/// Guarantees, besides the family's contract: 1. with street_access = 1 every parcel has street
/// access if the block has any;  2. the seeds of a lot's children are fixed before the recursion,
/// so an edit in one part of a block leaves the divisions elsewhere as they are. Paper: [VKW12,
/// Sec. 4.3, Alg. 2]; `street_access` is its xi, `irregularity` its omega. Deviation:  a lot is
/// left whole as soon as its area or front width is below the upper bound (the pseudocode would
///             split lots that are already too small); the pivot's shift is uniform in +-omega
///             d_OBB along the longer side and stays in its middle 80 %; where neither direction
///             gives every child street access and the draw asks for it, the lot stays whole (ADR
///             0004).
class ObbSubdivider {
 public:
  static constexpr std::string_view kName = "obb";
  static constexpr std::string_view kSummary =
      "recursive splits across the oriented bounding box [VKW12, Sec. 4.3]";

  struct Options {
    double area_min_m2 =
        200.0;  ///< a shifted split that leaves less than this is made in the middle instead
    double area_max_m2 = 800.0;  ///< lots below this are not split
    double width_min_m =
        8.0;  ///< no split leaves a lot with a box narrower than half of this, unless it must
    double width_max_m = 22.0;  ///< lots with a front narrower than this are not split
    double irregularity =
        0.2;  ///< omega: largest shift of a split, as a share of the shorter side of the box
    double street_access =
        1.0;              ///< xi: probability that a split must leave every lot with street access
    double snap_m = 1.0;  ///< a split this near to a contour vertex goes through it
    double fit_deviations = 2.0;  ///< k: bounds fitted to observed parcels are mean +- k deviations

    static constexpr auto fields() {
      return std::tuple{Field{"area_min_m2", &Options::area_min_m2, 0.0, 1e9,
                              "A_min: a shifted split that leaves less is made in the middle, m2"},
                        Field{"area_max_m2", &Options::area_max_m2, 1.0, 1e12,
                              "A_max: lots below this area are not split, m2"},
                        Field{"width_min_m", &Options::width_min_m, 0.0, 1e5,
                              "W_min: a split that leaves a box narrower than half of this is made "
                              "in the middle, m"},
                        Field{"width_max_m", &Options::width_max_m, 0.5, 1e6,
                              "W_max: lots with a narrower front are not split, m"},
                        Field{"irregularity", &Options::irregularity, 0.0, 1.0,
                              "omega: largest shift of a split over the box's shorter side"},
                        Field{"street_access", &Options::street_access, 0.0, 1.0,
                              "xi: probability that a split must keep street access"},
                        Field{"snap_m", &Options::snap_m, 0.0, 50.0,
                              "a split this near to a contour vertex goes through it, m"},
                        Field{"fit_deviations", &Options::fit_deviations, 0.0, 10.0,
                              "k: fitted bounds are mean +- k deviations"}};
    }
  };

  explicit ObbSubdivider(const Options& options) : options_(options) {}

  [[nodiscard]] Expected<std::vector<Parcel>> subdivide(const blocks::Block& block, Rng& rng) const;
  /// The same parcels, every split shown: kLotBox and kSplit, numbered by the depth of the
  /// recursion.
  template <SubdivisionVisitor Visitor>
  [[nodiscard]] Expected<std::vector<Parcel>> subdivide(const blocks::Block& block, Rng& rng,
                                                        Visitor& visitor) const;
  [[nodiscard]] ObbSubdivider fitted(const ParcelStyle& style) const;
  [[nodiscard]] const Options& options() const { return options_; }

 private:
  Options options_;
};
static_assert(BlockSubdivider<ObbSubdivider> && Registrable<ObbSubdivider>);

}  // namespace plat::parcels
