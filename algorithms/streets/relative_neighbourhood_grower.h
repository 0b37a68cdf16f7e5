#pragma once

#include <string_view>
#include <tuple>

#include "streets/street_grower.h"

namespace plat::streets {

/// Connects points between which no other point lies: the lune-based beta-skeleton of the points
/// and open ends, cut where the plane bars it. The baseline that knows the points' arrangement.
///
/// Guarantees, besides the family's contract: 1. no street is grown that is not in the
/// beta-skeleton, and none of it is left out that the plane admits and whose open ends are free;
/// 2. no open end has more than one connection;  3. the result does not depend on the order of the
/// points, nor on the stream.
/// Complexity: O(n log n) for points whose lunes are small (beta_skeleton.h).
/// Paper:      [KR85]
/// Deviation:  a skeleton's edge that crosses the boundary, an obstacle or an existing street is
///             left out, and nothing takes its place; points have as many connections as the
///             skeleton gives them (ADR 0028).
class RelativeNeighbourhoodGrower {
 public:
  static constexpr std::string_view kName = "relative_neighbourhood";
  static constexpr std::string_view kSummary =
      "beta-skeleton of the points [KR85], levels and angles ignored: the baseline by arrangement";

  struct Options {
    double beta = 2.0;  ///< 1: Gabriel graph, 2: relative neighbourhood graph

    static constexpr auto fields() {
      return std::tuple{Field{"beta", &Options::beta, 1.0, 8.0,
                              "size of the lune between two points that must be empty: 1 Gabriel "
                              "graph, 2 relative neighbourhood graph, more gives fewer streets"}};
    }
  };

  explicit RelativeNeighbourhoodGrower(const Options& options) : options_(options) {}

  [[nodiscard]] Expected<Growth> grow(const GrowthSite& site, Rng& rng) const;
  [[nodiscard]] const Options& options() const { return options_; }

 private:
  Options options_;
};
static_assert(StreetGrower<RelativeNeighbourhoodGrower> &&
              Registrable<RelativeNeighbourhoodGrower>);

}  // namespace plat::streets
