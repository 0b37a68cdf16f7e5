#pragma once

#include <string_view>
#include <tuple>

#include "parcels/block_subdivider.h"

namespace plat::parcels {

/// Divides a block along its oriented bounding box, then its lots at right angles to their
/// longest and squarest edges, with an even chance to stop early.
///
/// Guarantees, besides the family's contract: 1. no split leaves a lot without street access where
/// the divided one had it;  2. no split leaves a lot whose box is narrower than `width_min_m` or
/// smaller than `area_min_m2`;  3. a lot above `area_max_m2` does not stop early.
/// Paper:     [GMN, Sec. 4.2], parcel splitting.
/// Deviation: the criterion for the edge is the edge's length times 1 + `squareness` times the mean
///            sine of its two corners (the paper gives none); where its line is not allowed, the
///            next best edges are tried, but only for a lot above `area_max_m2`: lots that are deep
///            enough would fall into slivers; a line cuts wherever it crosses, so a concave lot may
///            fall into more than two (ADR 0011).
class RecursiveSubdivider {
 public:
  static constexpr std::string_view kName = "recursive";
  static constexpr std::string_view kSummary =
      "recursive splits at right angles to the best edge [GMN, Sec. 4.2]";

  struct Options {
    double area_min_m2 = 200.0;   ///< no split leaves a lot whose box is smaller
    double area_max_m2 = 800.0;   ///< larger lots do not stop early
    double width_min_m = 8.0;     ///< no split leaves a lot whose box is narrower
    double jitter = 0.1;          ///< largest shift of a split from the middle, over the side
    double stop_early = 0.5;      ///< probability that a lot within area_max_m2 stays whole
    double squareness = 1.0;      ///< weight of near-orthogonal neighbour edges in the criterion
    double fit_deviations = 2.0;  ///< k: bounds fitted to observed parcels are mean +- k deviations

    static constexpr auto fields() {
      return std::tuple{Field{"area_min_m2", &Options::area_min_m2, 0.0, 1e12,
                              "no split leaves a lot whose box is smaller, m2"},
                        Field{"area_max_m2", &Options::area_max_m2, 1.0, 1e12,
                              "larger lots do not stop early, m2"},
                        Field{"width_min_m", &Options::width_min_m, 0.0, 1e5,
                              "no split leaves a lot whose box is narrower, m"},
                        Field{"jitter", &Options::jitter, 0.0, 0.4,
                              "largest shift of a split from the middle, over the side's length"},
                        Field{"stop_early", &Options::stop_early, 0.0, 1.0,
                              "probability that a lot within area_max_m2 stays whole"},
                        Field{"squareness", &Options::squareness, 0.0, 100.0,
                              "weight of near-orthogonal neighbour edges against length"},
                        Field{"fit_deviations", &Options::fit_deviations, 0.0, 10.0,
                              "k: fitted bounds are mean +- k deviations"}};
    }
  };

  explicit RecursiveSubdivider(const Options& options) : options_(options) {}

  [[nodiscard]] Expected<std::vector<Parcel>> subdivide(const blocks::Block& block, Rng& rng) const;
  [[nodiscard]] RecursiveSubdivider fitted(const ParcelStyle& style) const;
  [[nodiscard]] const Options& options() const { return options_; }

 private:
  Options options_;
};
static_assert(BlockSubdivider<RecursiveSubdivider> && Registrable<RecursiveSubdivider>);

}  // namespace plat::parcels
