#pragma once

#include <optional>
#include <string_view>
#include <tuple>

#include "streets/street_grower.h"

namespace plat::streets {

/// Connects each point with the nearest ones, whatever their levels and angles: the baseline that
/// knows distances only.
///
/// Guarantees, besides the family's contract: 1. no point has more connections than its streets, no
/// open end more than one;  2. no grown street is longer than the site's largest length;  3. two
/// points of which one is among the `neighbours` nearest of the other are connected, or one of them
/// has no connection left, or the way is barred;  4. the result does not depend on the order of the
/// points, nor on the stream;  5. no street passes a vertex nearer than `clearance_widths` of its
/// width.
/// Complexity: O(n log n) for `neighbours` fixed and segments of similar length.
/// Deviation:  none of [AVB08], which has no baselines (ADR 0028).
class NearestGrower {
 public:
  static constexpr std::string_view kName = "nearest";
  static constexpr std::string_view kSummary =
      "nearest points first, levels and angles ignored: the baseline by distance";

  struct Options {
    /// k: a street is at most as long as mean + k deviations of all distances that the points know
    std::optional<double> length_deviations = 2.0;
    int neighbours = 16;  ///< how many of the nearest points of each are looked at
    /// of a point; none: as many as its streets have
    std::optional<double> max_connections = std::nullopt;
    double clearance_widths = 0.0;  ///< of the street's own width

    static constexpr auto fields() {
      return std::tuple{
          OptionalField{"length_deviations", &Options::length_deviations, 0.0, 100.0,
                        "k: no street is longer than mean + k deviations of all distances that the "
                        "points know; none: any length"},
          Field{"neighbours", &Options::neighbours, 1, 256,
                "how many of the nearest points of each are looked at"},
          OptionalField{"max_connections", &Options::max_connections, 1.0, 16.0,
                        "a point is connected at most so often; none: as often as its streets say"},
          Field{"clearance_widths", &Options::clearance_widths, 0.0, 10.0,
                "a street passes no point nearer than this share of its width; 0: through none "
                "exactly"}};
    }
  };

  explicit NearestGrower(const Options& options) : options_(options) {}

  [[nodiscard]] Expected<Growth> grow(const GrowthSite& site, Rng& rng) const;
  [[nodiscard]] const Options& options() const { return options_; }

 private:
  Options options_;
};
static_assert(StreetGrower<NearestGrower> && Registrable<NearestGrower>);

}  // namespace plat::streets
