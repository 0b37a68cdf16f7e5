#pragma once

#include <string_view>
#include <tuple>

#include "core/options.h"
#include "similarity/shape_descriptor.h"
#include "similarity/shape_similarity.h"

namespace plat::similarity {

/// Compares shapes by zone, area, number of corners, and mean and deviation of their interior
/// angles.
///
/// Guarantees: 1. a pseudometric where all zones are known: shapes at 0 may
/// differ in what it does not look at;  2. each weight scales its entry alone.
/// Complexity: O(1) a pair
/// Paper:      [ABVA08, Sec. 5], the vector S
/// Deviation:  the paper does not say how entries of different units are weighed: area counts by
///             its logarithm, so that twice and half are equally far and no large tile outweighs
///             all else (ADR 0034)
class DescriptorSimilarity {
 public:
  static constexpr std::string_view kName = "descriptor";
  static constexpr std::string_view kSummary =
      "Weighted distance of zone, log area, corners and interior angles [ABVA08 5].";
  struct Options {
    double zone_weight = 1.0;
    double area_weight = 1.0;
    double corner_count_weight = 0.25;
    double mean_angle_weight = 1.0;
    double angle_deviation_weight = 1.0;
    static constexpr auto fields() {
      using O = Options;
      return std::tuple{Field{"zone_weight", &O::zone_weight, 0.0, 100.0,
                              "Added, squared, where two known zones differ."},
                        Field{"area_weight", &O::area_weight, 0.0, 100.0,
                              "Weight of the difference in log area."},
                        Field{"corner_count_weight", &O::corner_count_weight, 0.0, 100.0,
                              "Weight of a corner more or less."},
                        Field{"mean_angle_weight", &O::mean_angle_weight, 0.0, 100.0,
                              "Weight of a radian of the mean interior angle."},
                        Field{"angle_deviation_weight", &O::angle_deviation_weight, 0.0, 100.0,
                              "Weight of a radian of the interior angles' standard deviation."}};
    }
  };
  struct Prepared {
    ShapeDescriptor descriptor;
  };

  explicit DescriptorSimilarity(const Options& options) : options_(options) {}

  [[nodiscard]] Expected<Prepared> prepare(const LabelledShape& shape) const;
  [[nodiscard]] double distance(const Prepared& a, const Prepared& b) const;
  [[nodiscard]] ShapeComparison compare(const Prepared& a, const Prepared& b) const;
  [[nodiscard]] SimilarityClaims claims() const;
  [[nodiscard]] const Options& options() const { return options_; }

 private:
  Options options_;
};
static_assert(ShapeSimilarity<DescriptorSimilarity> && Registrable<DescriptorSimilarity>);

}  // namespace plat::similarity
