#pragma once

#include <string_view>
#include <tuple>
#include <vector>

#include "core/options.h"
#include "similarity/outline_walk.h"
#include "similarity/shape_similarity.h"

namespace plat::similarity {

/// Compares outlines by their turning functions, the direction of the outline over its length,
/// which is normalised to 1: the root mean square of their difference, radians, for the best
/// rotation and the best start. Holes, labels and zones are not looked at.
///
/// Guarantees: 1. with size_weight = 0 a metric but for what is told apart by size only: symmetric,
/// 0 for similar outlines only, and the triangle inequality holds;  2. exact: no rotation and no
/// start is better, up to rounding;  3. the correspondence has, for each corner of either outline,
/// the points at the same share of the length behind the best start;  4. the transformation is the
/// rotation and translation that lay these on each other best, in least squares.
/// A shape of more than 2,000 vertices is kTooManyVertices.
/// Complexity:  O(mn log mn) a pair
/// Paper:       [ACHKM91]: the minimum lies where two corners meet
/// Deviation:   the difference is summed up over all such starts by its second derivative, and only
///              the best are integrated (ADR 0035)
class TurningSimilarity {
 public:
  static constexpr std::string_view kName = "turning";
  static constexpr std::string_view kSummary =
      "Root mean square difference of turning functions, best rotation and start [ACHKM91].";
  struct Options {
    double size_weight = 0.0;
    static constexpr auto fields() {
      return std::tuple{Field{"size_weight", &Options::size_weight, 0.0, 100.0,
                              "Weight of the difference in log length of the outlines, radians."}};
    }
  };
  struct Prepared {
    OutlineWalk outline;
    std::vector<double> starts_01;  ///< of the vertices, in shares of the length
    std::vector<double> turns_rad;  ///< at the vertices; their sum is a full turn
  };

  explicit TurningSimilarity(const Options& options) : options_(options) {}

  [[nodiscard]] Expected<Prepared> prepare(const LabelledShape& shape) const;
  [[nodiscard]] double distance(const Prepared& a, const Prepared& b) const;
  [[nodiscard]] ShapeComparison compare(const Prepared& a, const Prepared& b) const;
  [[nodiscard]] SimilarityClaims claims() const;
  [[nodiscard]] const Options& options() const { return options_; }

 private:
  Options options_;
};
static_assert(ShapeSimilarity<TurningSimilarity> && Registrable<TurningSimilarity>);

}  // namespace plat::similarity
