#pragma once

#include <concepts>
#include <cstddef>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "core/affine.h"
#include "core/failure.h"
#include "core/options.h"
#include "core/registry.h"
#include "similarity/labelled_shape.h"

namespace plat::similarity {

/// How two shapes compare.
struct ShapeComparison {
  double distance = 0.0;  ///< what distance() says
  /// Carries the first shape to the second, where the measure knows how.
  std::optional<Affine> transformation;
  /// Points of the first shape's outline and those of the second that they correspond to, in the
  /// order of the first outline; vertices or samples, as the measure says. Empty where it has none.
  std::vector<std::pair<Point, Point>> correspondence;
};

/// What does not change a measure's distance; each claim is tested.
struct SimilarityClaims {
  bool is_symmetric = false;        ///< d(a, b) = d(b, a)
  bool translation = true;          ///< of one of the two shapes
  bool rotation = false;            ///< of one of the two shapes
  bool reflection = false;          ///< of one of the two shapes
  bool common_scale = false;        ///< of both shapes
  bool scale = false;               ///< of one of the two shapes
  bool collinear_vertices = false;  ///< more vertices on an edge
};

/// A distance between shapes, in two steps: what can be computed on each shape alone, and the pair.
///
/// Contract, tested over the whole registry: 1. the distance of a shape to itself is 0;  2. it is
/// finite and not negative for any two valid polygons;  3. it does not depend on the vertex that a
/// ring begins with;  4. everything that claims() claims holds, up to rounding;  5. compare() has
/// the distance of distance(), to the last bit;  6. safe to call from several threads.
/// A shape that cannot be prepared is a Failure: kNotSimple, kTooSmall, kNotFinite,
/// kTooManyVertices.
/// `distance(a, b)`: `a` is laid on `b`; `a` is the candidate, `b` the place that it is to fill.
template <class S>
concept ShapeSimilarity = requires(const S& measure, const LabelledShape& shape,
                                   const typename S::Prepared& a, const typename S::Prepared& b) {
  { measure.prepare(shape) } -> std::same_as<Expected<typename S::Prepared>>;
  { measure.distance(a, b) } -> std::same_as<double>;
  { measure.compare(a, b) } -> std::same_as<ShapeComparison>;
  { measure.claims() } -> std::same_as<SimilarityClaims>;
};

/// A shape prepared by a strategy that is only known at run time. Cheap to copy.
class AnyPreparedShape {
 public:
  template <class Prepared>
  explicit AnyPreparedShape(Prepared prepared)
      : self_(std::make_shared<const Prepared>(std::move(prepared))) {}
  [[nodiscard]] const void* get() const { return self_.get(); }

 private:
  std::shared_ptr<const void> self_;
};

/// Any strategy of the family, chosen at run time. Shapes are compared by the strategy (the same
/// name and options) that prepared them.
class AnyShapeSimilarity {
 public:
  using Prepared = AnyPreparedShape;

  template <class S>
    requires(ShapeSimilarity<S> && Registrable<S> && !std::same_as<S, AnyShapeSimilarity>)
  explicit AnyShapeSimilarity(S measure)
      : self_(std::make_shared<const Model<S>>(std::move(measure))) {}

  [[nodiscard]] Expected<Prepared> prepare(const LabelledShape& shape) const {
    return self_->prepare(shape);
  }
  [[nodiscard]] double distance(const Prepared& a, const Prepared& b) const {
    return self_->distance(a.get(), b.get());
  }
  [[nodiscard]] ShapeComparison compare(const Prepared& a, const Prepared& b) const {
    return self_->compare(a.get(), b.get());
  }
  [[nodiscard]] SimilarityClaims claims() const { return self_->claims(); }
  [[nodiscard]] std::string_view name() const { return self_->name(); }
  [[nodiscard]] OptionMap options() const { return self_->options(); }

 private:
  struct Interface {
    virtual ~Interface() = default;
    [[nodiscard]] virtual Expected<Prepared> prepare(const LabelledShape&) const = 0;
    [[nodiscard]] virtual double distance(const void*, const void*) const = 0;
    [[nodiscard]] virtual ShapeComparison compare(const void*, const void*) const = 0;
    [[nodiscard]] virtual SimilarityClaims claims() const = 0;
    [[nodiscard]] virtual std::string_view name() const = 0;
    [[nodiscard]] virtual OptionMap options() const = 0;
  };
  template <class S>
  struct Model final : Interface {
    explicit Model(S s) : measure(std::move(s)) {}
    static const typename S::Prepared& of(const void* prepared) {
      return *static_cast<const typename S::Prepared*>(prepared);
    }
    [[nodiscard]] Expected<Prepared> prepare(const LabelledShape& shape) const override {
      return measure.prepare(shape).map(
          [](typename S::Prepared prepared) { return Prepared(std::move(prepared)); });
    }
    [[nodiscard]] double distance(const void* a, const void* b) const override {
      return measure.distance(of(a), of(b));
    }
    [[nodiscard]] ShapeComparison compare(const void* a, const void* b) const override {
      return measure.compare(of(a), of(b));
    }
    [[nodiscard]] SimilarityClaims claims() const override { return measure.claims(); }
    [[nodiscard]] std::string_view name() const override { return S::kName; }
    [[nodiscard]] OptionMap options() const override { return to_option_map(measure.options()); }
    S measure;
  };
  std::shared_ptr<const Interface> self_;
};
static_assert(ShapeSimilarity<AnyShapeSimilarity>);

/// The menu of shape similarities.
const Registry<AnyShapeSimilarity>& shape_similarities();

}  // namespace plat::similarity
