#pragma once

#include <string_view>
#include <tuple>

#include "parcels/block_subdivider.h"

namespace plat::parcels {

/// Divides a block by the Voronoi diagram of sites along its street border.
///
/// Guarantees, besides the family's contract: 1. every parcel holds exactly one site, where there
/// is any;  2. a front without a corner gets as many sites as mean spacings fit in its length,
/// rounded; a block without a site is one parcel.
/// Paper:     [VKW12, fig. 2b], "the Voronoi tessellation of points near the border of the street".
/// Deviation: the figure is all there is of the method: number, spacing and setback of the sites
///            are ours (ADR 0011).
class BorderVoronoiSubdivider {
 public:
  static constexpr std::string_view kName = "border_voronoi";
  static constexpr std::string_view kSummary =
      "Voronoi cells of sites along the street border [VKW12, fig. 2b]";

  struct Options {
    double spacing_m = 15.0;          ///< mean distance of sites along a front
    double spacing_deviation = 0.15;  ///< standard deviation of spacings over their mean
    double setback_m = 3.0;           ///< distance of the sites from the street border
    double fit_deviations = 1.0;      ///< k: the fitted deviation of spacings is k observed ones

    static constexpr auto fields() {
      return std::tuple{Field{"spacing_m", &Options::spacing_m, 0.5, 1e6,
                              "mean distance of sites along a front, m"},
                        Field{"spacing_deviation", &Options::spacing_deviation, 0.0, 10.0,
                              "standard deviation of spacings over their mean"},
                        Field{"setback_m", &Options::setback_m, 0.01, 1000.0,
                              "distance of the sites from the street border, m; less where the "
                              "block is thinner"},
                        Field{"fit_deviations", &Options::fit_deviations, 0.0, 10.0,
                              "k: the fitted deviation of spacings is k observed ones"}};
    }
  };

  explicit BorderVoronoiSubdivider(const Options& options) : options_(options) {}

  [[nodiscard]] Expected<std::vector<Parcel>> subdivide(const blocks::Block& block, Rng& rng) const;
  [[nodiscard]] BorderVoronoiSubdivider fitted(const ParcelStyle& style) const;
  [[nodiscard]] const Options& options() const { return options_; }

 private:
  Options options_;
};
static_assert(BlockSubdivider<BorderVoronoiSubdivider> && Registrable<BorderVoronoiSubdivider>);

}  // namespace plat::parcels
