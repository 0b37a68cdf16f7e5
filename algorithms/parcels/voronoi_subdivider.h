#pragma once

#include <string_view>
#include <tuple>

#include "parcels/block_subdivider.h"

namespace plat::parcels {

/// Divides a block by the Voronoi diagram of sites along its long axis, in one row or in two.
///
/// Guarantees, besides the family's contract: 1. every parcel holds exactly one site, the part of a
/// cell that the contour cuts off goes to the neighbour with the longest common boundary. Paper:
/// [AVB08, Sec. 3.1.2, fig. 6]; `row_offset_m` is its delta, the number of sites its n_b.
/// Deviation:  n_b sites where the paper samples n_b - 1, so that n_b parcels result; the number of
/// rows is the one
///             whose parcels come nearest to the expected aspect ratio (the paper leaves the choice
///             open); where the axis leaves the block, its parts inside are joined end to end for
///             sampling (ADR 0005).
class VoronoiSubdivider {
 public:
  static constexpr std::string_view kName = "voronoi";
  static constexpr std::string_view kSummary =
      "Voronoi cells of sites along the block's axis [AVB08, Sec. 3.1.2]";

  enum class Rows { kAutomatic, kOne, kTwo };

  struct Options {
    double area_mean_m2 =
        450.0;  ///< average parcel area: the block's area over this is the number of parcels
    double area_deviation_m2 =
        150.0;  ///< standard deviation of parcel areas: gives the spread of the spacing
    double aspect_ratio = 2.0;  ///< expected longer over shorter side of a parcel: decides on rows
    Rows rows = Rows::kAutomatic;  ///< rows of parcels
    double row_offset_m = 1.0;     ///< delta: distance of the two rows of sites from the axis

    static constexpr auto fields() {
      return std::tuple{
          Field{"area_mean_m2", &Options::area_mean_m2, 1.0, 1e9, "average parcel area, m2"},
          Field{"area_deviation_m2", &Options::area_deviation_m2, 0.0, 1e9,
                "standard deviation of parcel areas, m2"},
          Field{"aspect_ratio", &Options::aspect_ratio, 1.0, 100.0,
                "expected longer over shorter side of a parcel"},
          EnumField<Options, Rows, 3>{
              "rows",
              &Options::rows,
              {{"automatic", Rows::kAutomatic}, {"one", Rows::kOne}, {"two", Rows::kTwo}},
              "rows of parcels in a block"},
          Field{"row_offset_m", &Options::row_offset_m, 0.01, 50.0,
                "delta: distance of two rows of sites from the axis, m"}};
    }
  };

  explicit VoronoiSubdivider(const Options& options) : options_(options) {}

  [[nodiscard]] Expected<std::vector<Parcel>> subdivide(const blocks::Block& block, Rng& rng) const;
  [[nodiscard]] VoronoiSubdivider fitted(const ParcelStyle& style) const;
  [[nodiscard]] const Options& options() const { return options_; }

 private:
  Options options_;
};
static_assert(BlockSubdivider<VoronoiSubdivider> && Registrable<VoronoiSubdivider>);

}  // namespace plat::parcels
