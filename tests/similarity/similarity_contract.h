#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "core/parallel.h"
#include "similarity/made_shapes.h"
#include "similarity/shape_similarity.h"

namespace plat::testing {

/// How far two distances may differ that are one but for the rounding of coordinates.
inline double distance_rounding(double distance, double diameter_m) {
  constexpr double kShareOfDistance = 1e-6;  // single precision in sums of a thousand terms
  constexpr double kPerMetre = 1e-9;         // a ten-thousandth of the grid step for a large block
  return kShareOfDistance * distance + kPerMetre * (1.0 + diameter_m);
}

/// How far from an outline a point may lie that was computed to lie on it, metres.
inline double outline_rounding_m(const similarity::LabelledShape& shape) {
  const Box box = box_of(shape.polygon);
  const double reach = std::max(
      {std::abs(box.min.x), std::abs(box.min.y), std::abs(box.max.x), std::abs(box.max.y)});
  constexpr double kShareOfCoordinate = 1e-12;  // thousands of units in the last place
  return kShareOfCoordinate * (1.0 + reach + box.width() + box.height());
}

inline double diameter_m(const similarity::LabelledShape& a, const similarity::LabelledShape& b) {
  const Box box_a = box_of(a.polygon);
  const Box box_b = box_of(b.polygon);
  return std::max({box_a.width(), box_a.height(), box_b.width(), box_b.height()});
}

/// Where along the ring its point nearest to `p` lies, metres from the first vertex, and how far
/// from `p` it is.
inline std::pair<double, double> place_on(const Ring& ring, Point p) {
  double best = std::numeric_limits<double>::infinity();
  double place = 0.0;
  double walked = 0.0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Segment edge{ring[i], ring[(i + 1) % ring.size()]};
    const double away = distance(edge, p);
    if (away < best) {
      best = away;
      place = walked + nearest_parameter(edge, p) * length(edge);
    }
    walked += length(edge);
  }
  return {place, best};
}

/// What a correspondence breaks of what ShapeComparison says, in words, or an empty string.
inline std::string why_no_correspondence(const similarity::ShapeComparison& comparison,
                                         const similarity::LabelledShape& a,
                                         const similarity::LabelledShape& b) {
  const auto& pairs = comparison.correspondence;
  const double rounding_m = outline_rounding_m(a) + outline_rounding_m(b);
  const double length = perimeter_m(std::span<const Point>(a.polygon.outer));
  std::vector<double> places;
  for (const auto& [of_a, of_b] : pairs) {
    const auto [place, away] = place_on(a.polygon.outer, of_a);
    if (!(away <= rounding_m)) return fmt::format("a point {} m from the first outline", away);
    if (!(place_on(b.polygon.outer, of_b).second <= rounding_m))
      return "a point not on the second outline";
    // The end of the ring is its beginning.
    places.push_back(place >= length - rounding_m ? 0.0 : place);
  }
  int descents = 0;
  for (std::size_t i = 0; i < places.size(); ++i)
    descents += places[(i + 1) % places.size()] < places[i] - rounding_m ? 1 : 0;
  if (descents > 1) return "points not in the order of the first outline";
  return "";
}

/// The same for a transformation: it must carry the points to those that they correspond to at
/// least as well as the best translation does.
inline std::string why_no_transformation(const similarity::ShapeComparison& comparison,
                                         double rounding_m) {
  if (!comparison.transformation) return "";
  const Affine& map = *comparison.transformation;
  if (!map.is_finite()) return "a transformation that is not finite";
  const auto& pairs = comparison.correspondence;
  if (pairs.empty()) return "";
  Point mean;
  for (const auto& [of_a, of_b] : pairs)
    mean = mean + (of_b - of_a) / static_cast<double>(pairs.size());
  double carried = 0.0;
  double translated = 0.0;
  for (const auto& [of_a, of_b] : pairs) {
    carried += squared_length(map(of_a) - of_b);
    translated += squared_length(of_a + mean - of_b);
  }
  const auto count = static_cast<double>(pairs.size());
  const double rms = std::sqrt(carried / count);
  if (!(rms <= (1.0 + 1e-9) * std::sqrt(translated / count) + rounding_m))
    return fmt::format("the transformation leaves {} m where a translation leaves {} m", rms,
                       std::sqrt(translated / count));
  return "";
}

/// What a measure breaks of the contract of ShapeSimilarity on the pair, in words, or an empty
/// string: every numbered guarantee and every claim, each in both directions. Shapes that it says
/// it cannot prepare are passed over.
template <similarity::ShapeSimilarity Measure>
class ContractCheck {
 public:
  ContractCheck(const Measure& measure, const similarity::LabelledShape& a,
                const similarity::LabelledShape& b, Rng& rng)
      : measure_(measure), a_(a), b_(b), rng_(rng) {}

  [[nodiscard]] std::string defect() {
    for (const auto* shape : {&a_, &b_}) {
      const auto prepared = measure_.prepare(*shape);
      if (prepared) continue;
      const FailureCode code = prepared.error().code;
      const bool is_named = code == FailureCode::kNotSimple || code == FailureCode::kTooSmall ||
                            code == FailureCode::kNotFinite ||
                            code == FailureCode::kTooManyVertices;
      return is_named && !prepared.error().message.empty() ? "" : "a failure of another kind";
    }
    for (const auto check :
         {&ContractCheck::distances, &ContractCheck::begins_anywhere, &ContractCheck::invariances,
          &ContractCheck::comparisons, &ContractCheck::threads}) {
      const std::string wrong = (this->*check)();
      if (!wrong.empty()) return wrong;
    }
    return "";
  }

 private:
  using Shape = similarity::LabelledShape;

  double distance_of(const Shape& a, const Shape& b) const {
    const auto of_a = measure_.prepare(a);
    const auto of_b = measure_.prepare(b);
    return of_a && of_b ? measure_.distance(*of_a, *of_b)
                        : std::numeric_limits<double>::quiet_NaN();
  }

  /// The two are one distance, but for rounding.
  std::string differ(const char* what, double one, double other) const {
    const double bound = distance_rounding(std::max(one, other), diameter_m(a_, b_));
    if (std::abs(one - other) <= bound) return "";
    return fmt::format("{}: {} and {}", what, one, other);
  }

  /// 1, 2 and symmetry.
  std::string distances() {
    for (const auto* shape : {&a_, &b_}) {
      const double own = distance_of(*shape, *shape);
      if (!(own >= 0.0 && own <= distance_rounding(0.0, diameter_m(*shape, *shape))))
        return fmt::format("distance to itself is {}", own);
    }
    ab_ = distance_of(a_, b_);
    ba_ = distance_of(b_, a_);
    for (const double each : {ab_, ba_})
      if (!(std::isfinite(each) && each >= 0.0)) return fmt::format("distance is {}", each);
    return measure_.claims().is_symmetric ? differ("not symmetric", ab_, ba_) : "";
  }

  /// 3.
  std::string begins_anywhere() {
    const Shape a = begun_elsewhere(rng_, a_);
    return differ_with("begun elsewhere", a, b_);
  }

  std::string differ_with(const char* what, const Shape& a, const Shape& b) const {
    const std::string wrong = differ(what, ab_, distance_of(a, b));
    return wrong.empty() ? differ(what, ba_, distance_of(b, a)) : wrong;
  }

  /// 4. Coordinates are small where vertices do not stay on the grid: what is rounded is the
  /// image, not the place.
  std::string invariances() {
    const similarity::SimilarityClaims claims = measure_.claims();
    const Affine turn = Affine::rotation(rng_.uniform(0.0, 2.0 * std::numbers::pi));
    const Affine mirror{-1.0, 0.0, 0.0, 1.0, {}};
    const double factor = std::exp(rng_.uniform(-2.0, 2.0));
    const Affine grow{factor, 0.0, 0.0, factor, {}};
    const Point far = snap(Point{rng_.uniform(-1e6, 1e6), rng_.uniform(-1e6, 1e6)});
    const Shape a = centred(a_);
    const Shape b = centred(b_);
    if (claims.translation) {
      const std::string wrong = differ_with("moved", image_of(Affine::translation(far), a), b_);
      if (!wrong.empty()) return wrong;
    } else {
      return "";  // nothing else can be told apart from it
    }
    std::vector<std::pair<const char*, std::pair<Shape, Shape>>> images;
    if (claims.rotation) images.push_back({"turned", {image_of(turn, a), b}});
    if (claims.reflection) images.push_back({"mirrored", {image_of(mirror, a), b}});
    if (claims.scale) images.push_back({"grown", {image_of(grow, a), b}});
    if (claims.common_scale)
      images.push_back({"both grown", {image_of(grow, a), image_of(grow, b)}});
    if (claims.collinear_vertices)
      images.push_back({"more vertices", {with_more_vertices(rng_, a), b}});
    for (const auto& [what, shapes] : images) {
      const std::string wrong = differ_with(what, shapes.first, shapes.second);
      if (!wrong.empty()) return wrong;
    }
    return "";
  }

  /// 5, and what comes with the distance.
  std::string comparisons() {
    const auto of_a = measure_.prepare(a_);
    const auto of_b = measure_.prepare(b_);
    for (const bool is_forward : {true, false}) {
      const auto& one = is_forward ? of_a : of_b;
      const auto& other = is_forward ? of_b : of_a;
      const similarity::ShapeComparison comparison = measure_.compare(*one, *other);
      if (comparison.distance != measure_.distance(*one, *other))
        return "compare() has another distance";
      const Shape& from = is_forward ? a_ : b_;
      const Shape& to = is_forward ? b_ : a_;
      std::string wrong = why_no_correspondence(comparison, from, to);
      if (wrong.empty())
        wrong =
            why_no_transformation(comparison, outline_rounding_m(from) + outline_rounding_m(to));
      if (!wrong.empty()) return wrong;
    }
    return "";
  }

  /// 6.
  std::string threads() {
    constexpr std::size_t kCalls = 8;
    const auto of_a = measure_.prepare(a_);
    const auto of_b = measure_.prepare(b_);
    const double here = measure_.distance(*of_a, *of_b);
    std::atomic<bool> is_same = true;
    parallel_for(kCalls, Jobs{2}, [&](std::size_t) {
      if (measure_.distance(*of_a, *of_b) != here) is_same = false;
    });
    return is_same ? "" : "another distance on another thread";
  }

  const Measure& measure_;
  const Shape& a_;
  const Shape& b_;
  Rng& rng_;
  double ab_ = 0.0;
  double ba_ = 0.0;
};

template <similarity::ShapeSimilarity Measure>
std::string why_not_in_contract(const Measure& measure, const similarity::LabelledShape& a,
                                const similarity::LabelledShape& b, Rng& rng) {
  return ContractCheck<Measure>(measure, a, b, rng).defect();
}

/// Shapes that break the invariants of LabelledShape in ways that any measure can see.
template <similarity::ShapeSimilarity Measure>
std::string why_wrong_shapes_pass(const Measure& measure) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const auto code_of = [&](Ring ring) -> std::optional<FailureCode> {
    const auto prepared = measure.prepare({{std::move(ring), {}}, {}, ""});
    return prepared ? std::nullopt : std::optional(prepared.error().code);
  };
  for (const double wrong : {kNan, kInfinity})
    if (code_of({{0, 0}, {wrong, 0}, {3, 4}}) != FailureCode::kNotFinite)
      return "a coordinate that is not finite is not kNotFinite";
  if (!code_of({})) return "an empty ring passes";
  if (!code_of({{0, 0}, {10, 0}})) return "a ring of two points passes";
  if (!code_of({{0, 0}, {10, 0}, {20, 0}})) return "a ring without an area passes";
  return "";
}

}  // namespace plat::testing
