#include <bit>
#include <cmath>
#include <vector>

#include "similarity/corner_choices_internal.h"
#include "similarity/outline_corners.h"

namespace plat::similarity::detail {
namespace {

constexpr std::size_t kTriangle = 3;

/// The corners of a set, in cyclic order.
class CornerCycle {
 public:
  CornerCycle(const CornerOutline& outline, std::uint32_t set) : outline_(outline) {
    for (; set != 0; set &= set - 1)
      corner_[count_++] = static_cast<std::uint32_t>(std::countr_zero(set));
  }
  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] std::uint32_t set_of(std::size_t k) const { return 1U << corner_[k]; }
  /// Twice the area of the triangle of the k-th corner and its neighbours.
  [[nodiscard]] double twice_triangle_m2(std::size_t k) const {
    const std::size_t before = k == 0 ? count_ - 1 : k - 1;
    const std::size_t behind = k + 1 == count_ ? 0 : k + 1;
    return std::abs(orientation(at(before), at(k), at(behind)));
  }

 private:
  [[nodiscard]] Point at(std::size_t k) const { return outline_.corners[corner_[k]]; }

  const CornerOutline& outline_;
  std::size_t count_ = 0;
  std::array<std::uint32_t, kMaxMappedCorners> corner_;
};

/// The sets of corners that removals within the bound on area lead to.
class ChoiceSearch {
 public:
  ChoiceSearch(const CornerOutline& outline, double area_loss_01)
      : outline_(outline),
        most_twice_m2_(2.0 * area_loss_01 * outline.corner_area_m2),
        is_seen_(std::size_t{1} << outline.count),
        by_count_(outline.count + 1) {
    visit(all_of(outline.count));
  }

  /// By number of corners; those of one number in the order in which they were found.
  [[nodiscard]] const std::vector<std::vector<std::uint16_t>>& by_count() const {
    return by_count_;
  }

 private:
  void visit(std::uint32_t corners) {
    is_seen_[corners] = true;
    const CornerCycle cycle(outline_, corners);
    const std::size_t count = cycle.count();
    by_count_[count].push_back(static_cast<std::uint16_t>(corners));
    if (count == kTriangle) return;
    // The corner of the smallest triangle first: the first choices then are good ones, and most
    // mappings of the others need not be looked at closely.
    std::size_t least = 0;
    for (std::size_t k = 1; k < count; ++k) {
      if (cycle.twice_triangle_m2(k) < cycle.twice_triangle_m2(least)) least = k;
    }
    for (std::size_t step = 0; step < count; ++step) {
      const std::size_t k = (least + step) % count;
      const std::uint32_t rest = corners & ~cycle.set_of(k);
      if (cycle.twice_triangle_m2(k) <= most_twice_m2_ && !is_seen_[rest]) visit(rest);
    }
  }

  const CornerOutline& outline_;
  double most_twice_m2_;
  std::vector<bool> is_seen_;
  std::vector<std::vector<std::uint16_t>> by_count_;
};

}  // namespace

void find_choices(CornerOutline& outline, double area_loss_01) {
  const ChoiceSearch search(outline, area_loss_01);
  outline.choices.clear();
  outline.choice_ends.fill(0);
  for (std::size_t count = 0; count <= outline.count; ++count) {
    const auto& found = search.by_count()[count];
    outline.choices.insert(outline.choices.end(), found.begin(), found.end());
    outline.choice_ends[count] = static_cast<std::uint32_t>(outline.choices.size());
  }
}

std::span<const std::uint16_t> choices_of(const CornerOutline& outline, std::size_t count) {
  const std::span<const std::uint16_t> all(outline.choices);
  return all.subspan(outline.choice_ends[count - 1],
                     outline.choice_ends[count] - outline.choice_ends[count - 1]);
}

std::uint32_t largest_corners(const CornerOutline& outline, std::size_t count) {
  std::uint32_t corners = all_of(outline.count);
  for (std::size_t left = outline.count; left > count; --left) {
    const CornerCycle cycle(outline, corners);
    const auto triangle = [&](std::size_t k) {
      return rough_share(0.5 * cycle.twice_triangle_m2(k) / outline.corner_area_m2);
    };
    std::size_t least = 0;
    for (std::size_t k = 1; k < left; ++k) {
      if (triangle(k) < triangle(least)) least = k;
    }
    corners &= ~cycle.set_of(least);
  }
  return corners;
}

}  // namespace plat::similarity::detail
