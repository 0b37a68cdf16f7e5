#pragma once

#include <string_view>
#include <tuple>

#include "parcels/block_subdivider.h"

namespace plat::parcels {

/// Covers a block by rows of lots in its minimum-area bounding box.
///
/// Guarantees, besides the family's contract: 1. every cut runs along or across the box;  2. no
/// parcel is smaller than `area_min_m2`, but for a block that is.
/// Paper:     [WCP11] as [VKW12, fig. 2c] shows it, "a minimum area bounding box approach".
/// Deviation: a block is bounded by streets already, so none are laid between the rows, and lots of
///            inner rows have no street access; the box's sides are divided into whole numbers of
///            rows and lots; lots that the contour cuts below `area_min_m2` are joined to the
///            neighbour with the longest common boundary; widths may spread (ADR 0011).
class MinBoxSubdivider {
 public:
  static constexpr std::string_view kName = "min_box";
  static constexpr std::string_view kSummary =
      "rows of lots in the minimum-area box [WCP11; VKW12, fig. 2c]";

  struct Options {
    double lot_width_m = 15.0;      ///< mean width of a lot, along the longer side of the box
    double lot_depth_m = 30.0;      ///< depth of a row of lots
    double width_deviation = 0.05;  ///< standard deviation of lot widths over their mean
    double area_min_m2 = 150.0;     ///< smaller cells at the block's border are joined
    double fit_deviations = 2.0;    ///< k: the smallest area fitted is mean - k deviations

    static constexpr auto fields() {
      return std::tuple{
          Field{"lot_width_m", &Options::lot_width_m, 0.5, 1e6,
                "mean width of a lot, along the longer side of the box, m"},
          Field{"lot_depth_m", &Options::lot_depth_m, 0.5, 1e6, "depth of a row of lots, m"},
          Field{"width_deviation", &Options::width_deviation, 0.0, 10.0,
                "standard deviation of lot widths over their mean"},
          Field{"area_min_m2", &Options::area_min_m2, 0.0, 1e12,
                "smaller cells are joined to the neighbour with the longest common boundary, m2"},
          Field{"fit_deviations", &Options::fit_deviations, 0.0, 10.0,
                "k: the smallest area fitted is mean - k deviations"}};
    }
  };

  explicit MinBoxSubdivider(const Options& options) : options_(options) {}

  [[nodiscard]] Expected<std::vector<Parcel>> subdivide(const blocks::Block& block, Rng& rng) const;
  [[nodiscard]] MinBoxSubdivider fitted(const ParcelStyle& style) const;
  [[nodiscard]] const Options& options() const { return options_; }

 private:
  Options options_;
};
static_assert(BlockSubdivider<MinBoxSubdivider> && Registrable<MinBoxSubdivider>);

}  // namespace plat::parcels
