#pragma once

#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

#include "blocks/block.h"
#include "core/failure.h"
#include "core/options.h"
#include "parcels/parcel.h"

namespace plat::footprints {

/// Plots approximated from the footprints of one block: to each footprint the land nearer to it
/// than to any other.
struct Tessellation {
  std::vector<parcels::Parcel> plots;  ///< ordered by footprint
  /// Per plot: the index of its footprint in the input.
  std::vector<std::uint32_t> footprint_of_plot;
  /// Footprints that got no plot: below the least area, or hidden within another one.
  std::vector<std::uint32_t> without_plot;
};

/// Enclosed morphological tessellation of a block: what stands in for plots where there is no
/// cadastre. The result must be named so ("tessellated plots").
///
/// Method: the footprints' outlines, moved inside by `shrink_m`, are sampled every `segment_m`; the
/// Voronoi cells of the samples are joined per footprint and cut to the block.
///
/// Guarantees: 1. the plots are a coverage of the block's contour (parcels/coverage.h);  2. one
/// plot, one simple region, per footprint; none without a footprint;  3. where footprints do not
/// overlap, the plots do not depend on their order, but for the numbers.
/// Complexity:   O(n log n) for n samples
/// Paper:        [FFRP20]
/// Deviation:    boundaries between plots are simplified by at most `simplify_m`; where a cell
/// falls
///               apart at the contour, its smaller parts go to the neighbour of the longest common
///               boundary, so that each plot is one region; footprints that vanish when moved
///               inside keep one sample instead of being dropped.
class MorphologicalTessellation {
 public:
  struct Options {
    double shrink_m = 0.4;           ///< footprints are shrunk by this, so that touching ones part
    double segment_m = 0.5;          ///< distance of the samples along an outline
    double simplify_m = 0.1;         ///< boundaries may move by this: flattens the samples' ripple
    double min_footprint_m2 = 10.0;  ///< smaller footprints (sheds, kiosks) get no plot
    static constexpr auto fields() {
      return std::tuple{
          Field{"shrink_m", &Options::shrink_m, 0.0, 5.0,
                "Footprints are shrunk by this before sampling, so that touching ones part."},
          Field{"segment_m", &Options::segment_m, 0.05, 10.0,
                "Distance of the samples along an outline."},
          Field{"simplify_m", &Options::simplify_m, 0.0, 2.0,
                "Boundaries between plots may move by this: it flattens the samples' ripple."},
          Field{"min_footprint_m2", &Options::min_footprint_m2, 0.0, 1000.0,
                "Smaller footprints get no plot of their own."}};
    }
  };
  MorphologicalTessellation() = default;
  explicit MorphologicalTessellation(const Options& options) : options_(options) {}

  /// @param footprints  of this block, in its frame, as observed; may stick out of it or overlap
  /// @returns  Failure kNoObservation without a footprint; kNotCovered, kNotSimple from noding
  [[nodiscard]] Expected<Tessellation> tessellate(const blocks::Block& block,
                                                  std::span<const Polygon> footprints) const;

 private:
  Options options_;
};

}  // namespace plat::footprints
