#pragma once

#include <cstdint>
#include <string_view>
#include <tuple>
#include <vector>

#include "core/options.h"
#include "similarity/shape_similarity.h"

namespace plat::similarity {

/// How an outline is turned before it is compared.
enum class OutlineTurn : std::uint8_t {
  kNone,  ///< as it is
  kBox,   ///< so that the oriented boxes are parallel, in the best of the four ways
};

/// Compares outlines by their Hausdorff distance, metres, laid on each other by the centroids of
/// their areas. Holes, labels and zones are not looked at.
///
/// Guarantees: 1. the transformation lays the first outline on the second, and then the distance is
/// their Hausdorff distance, edges included, to kHausdorffResolution_m;  2. no other of the ways to
/// lay box on box is better: where several boxes of an outline have the least area, all are tried.
/// Not claimed: that no other rotation is better.
/// Complexity:  O(mn) for each of the ways, mostly 4
/// Deviation:   [Har] and [ABVA08] have no such measure; it is here as the plainest (ADR 0035)
class HausdorffSimilarity {
 public:
  static constexpr std::string_view kName = "hausdorff";
  static constexpr std::string_view kSummary =
      "Hausdorff distance of the outlines, centroid on centroid, oriented box along oriented box.";
  struct Options {
    OutlineTurn turn = OutlineTurn::kBox;
    static constexpr auto fields() {
      using enum OutlineTurn;
      return std::tuple{EnumField<Options, OutlineTurn, 2>{
          "turn",
          &Options::turn,
          {{"none", kNone}, {"box", kBox}},
          "How outlines are turned: not at all, or so that their oriented boxes are parallel."}};
    }
  };
  struct Prepared {
    Ring outline;  ///< relative to its centroid
    Point centroid;
    std::vector<Point> axes;  ///< of the boxes of least area, in the first quadrant
  };

  explicit HausdorffSimilarity(const Options& options) : options_(options) {}

  [[nodiscard]] Expected<Prepared> prepare(const LabelledShape& shape) const;
  [[nodiscard]] double distance(const Prepared& a, const Prepared& b) const;
  [[nodiscard]] ShapeComparison compare(const Prepared& a, const Prepared& b) const;
  [[nodiscard]] SimilarityClaims claims() const;
  [[nodiscard]] const Options& options() const { return options_; }

 private:
  Options options_;
};
static_assert(ShapeSimilarity<HausdorffSimilarity> && Registrable<HausdorffSimilarity>);

}  // namespace plat::similarity
