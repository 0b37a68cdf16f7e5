#include "similarity/merged_similarity.h"

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

namespace plat::similarity {
namespace {

using ShapeSet = std::vector<std::uint32_t>;  // ascending

double area_of(const ShapeNeighbourhood& side, const ShapeSet& set) {
  double sum = 0.0;
  for (const std::uint32_t i : set) sum += area_m2(side.shape(i).polygon);
  return sum;
}

Expected<LabelledShape> union_of(const ShapeNeighbourhood& side, const ShapeSet& set) {
  std::vector<const LabelledShape*> shapes;
  for (const std::uint32_t i : set) shapes.push_back(&side.shape(i));
  return similarity::union_of(shapes);
}

/// The shapes that have an edge in common with a set, ascending.
ShapeSet around(const ShapeNeighbourhood& side, const ShapeSet& set) {
  std::set<std::uint32_t> out;
  for (const std::uint32_t i : set) {
    for (const std::uint32_t other : side.neighbours(i)) {
      if (!std::ranges::binary_search(set, other)) out.insert(other);
    }
  }
  return {out.begin(), out.end()};
}

ShapeSet with(ShapeSet set, std::uint32_t shape) {
  set.insert(std::ranges::upper_bound(set, shape), shape);
  return set;
}

/// The side that is merged.
struct Growing {
  const ShapeNeighbourhood& side;
  bool is_first;                          ///< whether it is `a`
  std::optional<std::uint32_t> excluded;  ///< the other shape, where it is of the same side
};

/// The side that stays.
struct Other {
  const AnyPreparedShape& prepared;
  double area_m2;
};

/// Grows unions from the smaller side, and keeps the best match.
class MergeSearch {
 public:
  MergeSearch(const AnyShapeSimilarity& measure, const MergeOptions& options, Growing growing,
              Other other, MergedComparison& best)
      : measure_(measure), options_(options), growing_(growing), other_(other), best_(best) {}

  void run(std::uint32_t seed) {
    std::set<ShapeSet> level{{seed}};
    for (int count = 2; count <= options_.max_shapes && !level.empty(); ++count) {
      level = grown(level);
      for (const ShapeSet& set : level) {
        if (!visit(set)) return;
      }
    }
  }

 private:
  /// Every set with one more shape.
  [[nodiscard]] std::set<ShapeSet> grown(const std::set<ShapeSet>& level) const {
    std::set<ShapeSet> out;
    for (const ShapeSet& set : level) {
      if (area_of(growing_.side, set) >= options_.stop_area_ratio * other_.area_m2) continue;
      for (const std::uint32_t shape : around(growing_.side, set)) {
        ShapeSet larger = with(set, shape);
        if (shape != growing_.excluded &&
            area_of(growing_.side, larger) <= options_.max_area_ratio * other_.area_m2)
          out.insert(std::move(larger));
      }
    }
    return out;
  }
  /// Whether the search may go on.
  bool visit(const ShapeSet& set) {
    if (best_.unions_compared + best_.unions_refused >=
        static_cast<std::size_t>(options_.max_unions)) {
      best_.is_complete = false;
      return false;
    }
    auto merged = union_of(growing_.side, set);
    const auto prepared =
        merged.and_then([&](const LabelledShape& shape) { return measure_.prepare(shape); });
    if (!prepared) {
      ++best_.unions_refused;
      return true;
    }
    ++best_.unions_compared;
    const AnyPreparedShape& a = growing_.is_first ? *prepared : other_.prepared;
    const AnyPreparedShape& b = growing_.is_first ? other_.prepared : *prepared;
    if (measure_.distance(a, b) < best_.comparison.distance) {
      best_.comparison = measure_.compare(a, b);
      (growing_.is_first ? best_.a : best_.b) = {set, *std::move(merged)};
    }
    return true;
  }

  const AnyShapeSimilarity& measure_;
  const MergeOptions& options_;
  Growing growing_;
  Other other_;
  MergedComparison& best_;
};

}  // namespace

Expected<MergedComparison> compare_merged(const AnyShapeSimilarity& measure,
                                          const ShapeNeighbourhood& a_side, std::uint32_t a,
                                          const ShapeNeighbourhood& b_side, std::uint32_t b,
                                          const MergeOptions& options) {
  const auto prepared_a = measure.prepare(a_side.shape(a));
  if (!prepared_a) return tl::unexpected(prepared_a.error());
  const auto prepared_b = measure.prepare(b_side.shape(b));
  if (!prepared_b) return tl::unexpected(prepared_b.error());
  MergedComparison best;
  best.a = {{a}, a_side.shape(a)};
  best.b = {{b}, b_side.shape(b)};
  best.comparison = measure.compare(*prepared_a, *prepared_b);
  const double a_area_m2 = area_m2(a_side.shape(a).polygon);
  const double b_area_m2 = area_m2(b_side.shape(b).polygon);
  if (std::max(a_area_m2, b_area_m2) > options.max_area_ratio * std::min(a_area_m2, b_area_m2))
    return best;
  const bool is_one_side = &a_side == &b_side;
  const auto excluded = [&](std::uint32_t other) {
    return is_one_side ? std::optional(other) : std::nullopt;
  };
  if (a_area_m2 <= b_area_m2) {
    MergeSearch(measure, options, {a_side, true, excluded(b)}, {*prepared_b, b_area_m2}, best)
        .run(a);
  } else {
    MergeSearch(measure, options, {b_side, false, excluded(a)}, {*prepared_a, a_area_m2}, best)
        .run(b);
  }
  return best;
}

}  // namespace plat::similarity
