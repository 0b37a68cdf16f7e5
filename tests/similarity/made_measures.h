#pragma once

#include <cmath>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "core/registry.h"
#include "core/rng.h"
#include "similarity/shape_similarity.h"
#include "similarity/weighted_k_means.h"

namespace plat::similarity::testing {

/// By area and perimeter only; optionally not symmetric. What is built on measures is tested with
/// it.
class MadeMeasure {
 public:
  static constexpr std::string_view kName = "made";
  static constexpr std::string_view kSummary = "Difference in area and perimeter.";
  struct Options {
    double perimeter_weight = 1.0;
    double asymmetry = 0.0;
    static constexpr auto fields() {
      return std::tuple{
          Field{"perimeter_weight", &Options::perimeter_weight, 0.0, 10.0, "Factor."},
          Field{"asymmetry", &Options::asymmetry, 0.0, 10.0, "Price of a shape that is larger."}};
    }
  };
  struct Prepared {
    double area = 0.0;
    double perimeter = 0.0;
  };

  explicit MadeMeasure(const Options& options) : options_(options) {}
  [[nodiscard]] Expected<Prepared> prepare(const LabelledShape& shape) const {
    const double area = area_m2(shape.polygon);
    if (!(area > 0.0)) return fail(FailureCode::kTooSmall, "no area");
    return Prepared{area, perimeter_m(shape.polygon)};
  }
  [[nodiscard]] double distance(const Prepared& a, const Prepared& b) const {
    return std::abs(a.area - b.area) +
           options_.perimeter_weight * std::abs(a.perimeter - b.perimeter) +
           options_.asymmetry * std::fmax(0.0, a.area - b.area);
  }
  [[nodiscard]] ShapeComparison compare(const Prepared& a, const Prepared& b) const {
    return {distance(a, b), {}, {}};
  }
  [[nodiscard]] SimilarityClaims claims() const {
    return {.is_symmetric = options_.asymmetry == 0.0};
  }
  [[nodiscard]] const Options& options() const { return options_; }

 private:
  Options options_;
};
static_assert(ShapeSimilarity<MadeMeasure> && Registrable<MadeMeasure>);

inline AnyShapeSimilarity made_measure(double asymmetry = 0.0) {
  return AnyShapeSimilarity(MadeMeasure({.asymmetry = asymmetry}));
}

inline LabelledShape rectangle(double width, double height, std::string zone = "") {
  return {{{{0, 0}, {width, 0}, {width, height}, {0, height}}, {}}, {}, std::move(zone)};
}

/// Rectangles of 5 to 60 m, some of them twice, in zones "a", "b" and "c".
inline std::vector<LabelledShape> random_rectangles(std::size_t count, Rng& rng) {
  std::vector<LabelledShape> out;
  while (out.size() < count) {
    if (!out.empty() && rng.uniform_01() < 0.1) {
      out.push_back(out[rng.index(out.size())]);
      continue;
    }
    const double width = rng.uniform(5, 60);
    const double height = rng.uniform(5, 60);
    out.push_back(rectangle(width, height, std::string(1, "abc"[rng.index(3)])));
  }
  return out;
}

/// Width and height of rectangles as a table.
inline NumberTable extents_of(const std::vector<LabelledShape>& shapes) {
  NumberTable table{2, {}};
  for (const LabelledShape& shape : shapes) {
    table.values.push_back(shape.polygon.outer[2].x);
    table.values.push_back(shape.polygon.outer[2].y);
  }
  return table;
}

inline Clusters clusters_of_rectangles(const std::vector<LabelledShape>& shapes,
                                       std::size_t clusters, std::uint64_t seed = 1) {
  Rng rng(seed);
  const double weights[] = {1.0, 1.0};
  return weighted_k_means(extents_of(shapes), weights, clusters, rng).clusters;
}

}  // namespace plat::similarity::testing
