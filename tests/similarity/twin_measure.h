#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include "similarity/shape_similarity.h"

namespace plat::testing {

/// What may be wrong with a measure.
enum class MeasureFault : std::uint8_t {
  kNone,
  kIsNotZeroForItself,
  kIsNegative,
  kIsNanForSlivers,
  kIsInfiniteForManyVertices,
  kIsNotSymmetric,
  kDependsOnFirstVertex,
  kDependsOnFirstLabel,
  kDependsOnPlace,
  kDependsOnDirection,
  kDependsOnHand,
  kDependsOnCommonScale,
  kDependsOnScale,
  kCountsVertices,
  kComparesOtherwise,
  kCountsCalls,
  kCorrespondsOffTheOutline,
  kCorrespondsOutOfOrder,
  kTransformsToNowhere,
  kTransformsWorseThanATranslation,
  kFailsByAnotherCode,
  kAcceptsWrongShapes,
  kIsWrongInTheLastDigits,
};
inline constexpr auto kLastMeasureFault = MeasureFault::kIsWrongInTheLastDigits;

/// An honest measure with one fault: the difference of perimeter^2 / area, which nothing changes
/// that a claim may name.
class TwinMeasure {
 public:
  struct Prepared {
    Polygon polygon;
    double elongation = 0.0;  ///< perimeter^2 / area
    double extra = 0.0;       ///< what the fault adds
  };

  explicit TwinMeasure(MeasureFault fault) : fault_(fault) {}

  [[nodiscard]] Expected<Prepared> prepare(const similarity::LabelledShape& shape) const {
    const Ring& ring = shape.polygon.outer;
    const double length = perimeter_m(std::span<const Point>(ring));
    const double area = signed_area_m2(ring);
    if (fault_ == MeasureFault::kAcceptsWrongShapes && ring.size() < 3) return Prepared{};
    if (fault_ == MeasureFault::kFailsByAnotherCode && ring.size() > 20)
      return fail(FailureCode::kNoStreet, "no street");
    for (const Point p : ring)
      if (!std::isfinite(p.x) || !std::isfinite(p.y))
        return fail(FailureCode::kNotFinite, "a coordinate is not finite");
    if (ring.size() < 3 || !(area > 0.0)) return fail(FailureCode::kTooSmall, "no area");
    Prepared out{shape.polygon, length * length / area, 0.0};
    out.extra = extra(shape, length, out.elongation);
    return out;
  }

  [[nodiscard]] double distance(const Prepared& a, const Prepared& b) const {
    double out = std::abs(a.elongation - b.elongation) + std::abs(a.extra - b.extra);
    if (fault_ == MeasureFault::kIsNotZeroForItself) out += 1e-3;
    if (fault_ == MeasureFault::kIsNegative) out = -out;
    if (fault_ == MeasureFault::kIsNotSymmetric && a.elongation > b.elongation) out *= 1.01;
    if (fault_ == MeasureFault::kCountsCalls) out += 1e-12 * static_cast<double>(++calls());
    return out;
  }

  [[nodiscard]] similarity::ShapeComparison compare(const Prepared& a, const Prepared& b) const {
    similarity::ShapeComparison out{distance(a, b), {}, {}};
    if (fault_ == MeasureFault::kComparesOtherwise)
      out.distance = std::nextafter(out.distance, std::numeric_limits<double>::infinity());
    Point mean;
    constexpr std::size_t kPairs = 10;
    for (std::size_t i = 0; i < kPairs; ++i) {
      const double share = static_cast<double>(i) / kPairs;
      const Point of_b = at(b.polygon.outer, share);
      out.correspondence.push_back({at(a.polygon.outer, share), of_b});
      mean = mean + (of_b - out.correspondence.back().first) / static_cast<double>(kPairs);
    }
    out.transformation = Affine::translation(mean);
    spoil(out);
    return out;
  }

  [[nodiscard]] similarity::SimilarityClaims claims() const {
    return {.is_symmetric = true,
            .translation = true,
            .rotation = true,
            .reflection = true,
            .common_scale = true,
            .scale = fault_ != MeasureFault::kDependsOnCommonScale,
            .collinear_vertices = true};
  }

 private:
  /// The point at this share of the ring's length.
  static Point at(const Ring& ring, double share) {
    double left = share * perimeter_m(std::span<const Point>(ring));
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Segment edge{ring[i], ring[(i + 1) % ring.size()]};
      if (left <= length(edge)) return lerp(edge.a, edge.b, left / length(edge));
      left -= length(edge);
    }
    return ring.front();
  }

  static int& calls() {
    static thread_local int count = 0;
    return count;
  }

  [[nodiscard]] double extra(const similarity::LabelledShape& shape, double length,
                             double elongation) const {
    constexpr double kElongated = 60.0;
    constexpr std::size_t kMany = 100;
    const Ring& ring = shape.polygon.outer;
    const Box box = box_of(shape.polygon);
    switch (fault_) {
      case MeasureFault::kIsNanForSlivers:
        return elongation > kElongated ? std::numeric_limits<double>::quiet_NaN() : 0.0;
      case MeasureFault::kIsInfiniteForManyVertices:
        return ring.size() > kMany ? std::numeric_limits<double>::infinity() : 0.0;
      case MeasureFault::kDependsOnFirstVertex:
        return turn_rad(ring, 0);
      case MeasureFault::kDependsOnFirstLabel:
        return shape.edges.empty() ? 0.0 : static_cast<double>(shape.edges.front());
      case MeasureFault::kDependsOnPlace:
        return box.min.x;
      case MeasureFault::kDependsOnDirection:
        return box.width() / box.height();
      case MeasureFault::kDependsOnHand:
        return hand(ring, length);
      case MeasureFault::kDependsOnCommonScale:
        return length;
      case MeasureFault::kDependsOnScale:
        return std::log(length);
      case MeasureFault::kCountsVertices:
        return static_cast<double>(ring.size());
      case MeasureFault::kIsWrongInTheLastDigits:  // differences of large coordinates
        return 1e-5 * std::fmod(box.max.x, 1.0);
      default:
        return 0.0;
    }
  }

  /// Positive where long edges come before short ones.
  static double hand(const Ring& ring, double length) {
    double sum = 0.0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const double one = plat::distance(ring[i], ring[(i + 1) % ring.size()]) / length;
      const double next =
          plat::distance(ring[(i + 1) % ring.size()], ring[(i + 2) % ring.size()]) / length;
      sum += one * one * next - one * next * next;
    }
    return sum;
  }

  void spoil(similarity::ShapeComparison& out) const {
    auto& pairs = out.correspondence;
    if (fault_ == MeasureFault::kCorrespondsOffTheOutline)
      pairs[3].second = pairs[3].second + Point{1e-3, 0.0};
    if (fault_ == MeasureFault::kCorrespondsOutOfOrder) std::swap(pairs[2], pairs[6]);
    if (fault_ == MeasureFault::kTransformsToNowhere)
      out.transformation->xx = std::numeric_limits<double>::quiet_NaN();
    if (fault_ == MeasureFault::kTransformsWorseThanATranslation)
      out.transformation->shift = out.transformation->shift + Point{0.1, 0.0};
  }

  MeasureFault fault_;
};
static_assert(similarity::ShapeSimilarity<TwinMeasure>);

}  // namespace plat::testing
