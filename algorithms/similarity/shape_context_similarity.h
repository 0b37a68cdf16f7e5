#pragma once

#include <string_view>
#include <tuple>

#include "core/options.h"
#include "similarity/outline_samples.h"
#include "similarity/shape_contexts.h"
#include "similarity/shape_similarity.h"

namespace plat::similarity {

/// Compares outlines by the shape contexts of uniform samples, matched by cyclic dynamic time
/// warping: the distance is the cost of the cheapest warping per sample. Holes, labels and zones
/// are not looked at.
///
/// Guarantees: 1. the distance is between 0 and 1: 0 for an outline itself, moved, turned (unless
/// alignment is none) or begun at another vertex;  2. no warping of the samples is cheaper;  3. the
/// correspondence is that warping, every sample of both outlines in it;  4. the transformation is
/// the rotation and translation that lay it on itself best, in least squares.
/// Complexity:  O(samples^2 * bins) a pair
/// Paper:       [Har, Sec. 4.1.3 and 5.1.3], eq. (4.2) with gamma = 1; contexts [BMP02]
/// Deviation:   the elevation term of eq. (4.2) is left out, as in Sec. 5.1.3: no terrain is known;
///              the rest in ADR 0035
class ShapeContextSimilarity {
 public:
  static constexpr std::string_view kName = "shape_context";
  static constexpr std::string_view kSummary =
      "Shape contexts of uniform samples, matched by cyclic dynamic time warping [Har 4.1.3].";
  struct Options {
    int samples = 100;
    int angular_bins = 8;
    int distance_bins = 5;
    double inner_radius_m = 8.0;
    double outer_radius_m = 256.0;
    ContextAlignment alignment = ContextAlignment::kTangent;
    static constexpr auto fields() {
      using O = Options;
      using enum ContextAlignment;
      return std::tuple{
          Field{"samples", &O::samples, 8, 300, "Points on an outline."},
          Field{"angular_bins", &O::angular_bins, 1, 24, "Sectors of a histogram."},
          Field{"distance_bins", &O::distance_bins, 1, 12, "Rings of a histogram."},
          Field{"inner_radius_m", &O::inner_radius_m, 0.1, 50.0,
                "Inside of the innermost ring, metres; nearer points count in it."},
          Field{"outer_radius_m", &O::outer_radius_m, 60.0, 20000.0,
                "Outside of the outermost ring, metres; farther points count in it."},
          EnumField<O, ContextAlignment, 3>{
              "alignment",
              &O::alignment,
              {{"tangent", kTangent}, {"centroid", kCentroid}, {"none", kNone}},
              "Where a histogram has its zero angle: along the outline, towards the centroid, or "
              "east."}};
    }
  };
  struct Prepared {
    OutlineSamples outline;
    ShapeContexts contexts;
  };

  explicit ShapeContextSimilarity(const Options& options) : options_(options) {}

  [[nodiscard]] Expected<Prepared> prepare(const LabelledShape& shape) const;
  [[nodiscard]] double distance(const Prepared& a, const Prepared& b) const;
  [[nodiscard]] ShapeComparison compare(const Prepared& a, const Prepared& b) const;
  [[nodiscard]] SimilarityClaims claims() const;
  [[nodiscard]] const Options& options() const { return options_; }

 private:
  Options options_;
};
static_assert(ShapeSimilarity<ShapeContextSimilarity> && Registrable<ShapeContextSimilarity>);

}  // namespace plat::similarity
