#pragma once

#include <string_view>
#include <tuple>

#include "parcels/block_subdivider.h"

namespace plat::parcels {

/// Packs rectangles of lot size along the streets of a block, greedily from the corners, and joins
/// the land left over to the lots beside it.
///
/// Guarantees, besides the family's contract: 1. every parcel holds exactly one packed rectangle,
/// where any fits;  2. every parcel then has street access.
/// Paper:      [VKW12, fig. 2d], "cube packing [...] leads to badly formed parcels in concave
///             areas": so it does here, and nothing is done against it.
/// Deviation:  the figure is all there is of the method: fronts are packed longest first, a lot
///             whose depth does not fit is made shallower down to `depth_min_share`, and land left
///             over is cut along the prolonged sides of the lots before it is joined (ADR 0011).
/// Complexity: O(lots * (lots + edges)).
class CubePackingSubdivider {
 public:
  static constexpr std::string_view kName = "cube_packing";
  static constexpr std::string_view kSummary =
      "rectangles packed along the streets [VKW12, fig. 2d]";

  struct Options {
    double lot_width_m = 15.0;      ///< mean width of a packed lot
    double lot_depth_m = 30.0;      ///< depth of a packed lot
    double width_deviation = 0.05;  ///< standard deviation of lot widths over their mean
    double depth_min_share = 0.5;   ///< least depth of a packed lot over `lot_depth_m`
    double fit_deviations = 1.0;    ///< k: the fitted deviation of widths is k observed ones

    static constexpr auto fields() {
      return std::tuple{
          Field{"lot_width_m", &Options::lot_width_m, 0.5, 1e6, "mean width of a packed lot, m"},
          Field{"lot_depth_m", &Options::lot_depth_m, 0.5, 1e6, "depth of a packed lot, m"},
          Field{"width_deviation", &Options::width_deviation, 0.0, 10.0,
                "standard deviation of lot widths over their mean"},
          Field{"depth_min_share", &Options::depth_min_share, 0.05, 1.0,
                "least depth of a packed lot over lot_depth_m"},
          Field{"fit_deviations", &Options::fit_deviations, 0.0, 10.0,
                "k: the fitted deviation of widths is k observed ones"}};
    }
  };

  explicit CubePackingSubdivider(const Options& options) : options_(options) {}

  [[nodiscard]] Expected<std::vector<Parcel>> subdivide(const blocks::Block& block, Rng& rng) const;
  [[nodiscard]] CubePackingSubdivider fitted(const ParcelStyle& style) const;
  [[nodiscard]] const Options& options() const { return options_; }

 private:
  Options options_;
};
static_assert(BlockSubdivider<CubePackingSubdivider> && Registrable<CubePackingSubdivider>);

}  // namespace plat::parcels
