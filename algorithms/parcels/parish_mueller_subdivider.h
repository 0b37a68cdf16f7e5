#pragma once

#include <string_view>
#include <tuple>

#include "parcels/block_subdivider.h"

namespace plat::parcels {

/// Divides the longest pair of approximately parallel sides of a block, and of its lots, until they
/// are small enough.
///
/// Guarantees, besides the family's contract: 1. with `interior = join` every parcel has street
/// access if the block has any;  2. with `interior = keep` no parcel is larger than `area_max_m2`.
/// Paper:     [PM01] as [VKW12, Sec. 2] describes it.
/// Deviation: the paper discards lots without street access; a coverage cannot, so they are kept
///            as they are or joined to the neighbour with the longest common boundary; a pair is as
///            long as its sides face each other, and divided in the middle of that, or a little off
///            it; where no pair is parallel, the longest side is divided at a right angle (ADR
///            0011).
class ParishMuellerSubdivider {
 public:
  static constexpr std::string_view kName = "parish_mueller";
  static constexpr std::string_view kSummary =
      "recursive splits of the longest parallel sides [PM01; VKW12, Sec. 2]";

  enum class Interior {
    kKeep,  ///< lots without street access stay parcels
    kJoin,  ///< they are joined to a neighbour
  };

  struct Options {
    double area_max_m2 = 800.0;         ///< lots below this are not divided
    double parallel_within_deg = 30.0;  ///< sides within this angle are approximately parallel
    double irregularity = 0.1;          ///< largest shift of a split along a side, over its length
    Interior interior = Interior::kKeep;  ///< what becomes of lots without street access
    double fit_deviations = 2.0;          ///< k: the fitted bound of area is mean + k deviations

    static constexpr auto fields() {
      return std::tuple{
          Field{"area_max_m2", &Options::area_max_m2, 1.0, 1e12,
                "lots below this area are not divided, m2"},
          Field{"parallel_within_deg", &Options::parallel_within_deg, 0.0, 90.0,
                "sides within this angle are approximately parallel, degrees"},
          Field{"irregularity", &Options::irregularity, 0.0, 0.4,
                "largest shift of a split along a side, over the side's length"},
          EnumField<Options, Interior, 2>{
              "interior",
              &Options::interior,
              {{"keep", Interior::kKeep}, {"join", Interior::kJoin}},
              "whether lots without street access stay parcels or join a neighbour (the paper "
              "discards them)"},
          Field{"fit_deviations", &Options::fit_deviations, 0.0, 10.0,
                "k: the fitted bound of area is mean + k deviations"}};
    }
  };

  explicit ParishMuellerSubdivider(const Options& options) : options_(options) {}

  [[nodiscard]] Expected<std::vector<Parcel>> subdivide(const blocks::Block& block, Rng& rng) const;
  [[nodiscard]] ParishMuellerSubdivider fitted(const ParcelStyle& style) const;
  [[nodiscard]] const Options& options() const { return options_; }

 private:
  Options options_;
};
static_assert(BlockSubdivider<ParishMuellerSubdivider> && Registrable<ParishMuellerSubdivider>);

}  // namespace plat::parcels
