#include "similarity/outline_corners.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <set>
#include <utility>

#include "core/polygon.h"

namespace plat::similarity {
namespace {

/// The vertices of a ring that are left, by the size of their triangles.
class Thinning {
 public:
  explicit Thinning(std::span<const Point> ring)
      : ring_(ring),
        area_m2_(std::abs(signed_area_m2(ring))),
        first_(static_cast<std::size_t>(std::ranges::min_element(ring) - ring.begin())),
        before_(ring.size()),
        after_(ring.size()) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      before_[i] = (i + ring.size() - 1) % ring.size();
      after_[i] = (i + 1) % ring.size();
    }
    for (std::size_t i = 0; i < ring.size(); ++i) order_.insert(key(i));
  }

  [[nodiscard]] std::size_t size() const { return order_.size(); }
  /// Of the smallest triangle in the ring.
  [[nodiscard]] float least_rough_share() const { return order_.begin()->first; }

  void drop_least() {
    const std::size_t i = vertex(*order_.begin());
    order_.erase(order_.begin());
    const std::size_t before = before_[i];
    const std::size_t after = after_[i];
    order_.erase(key(before));
    order_.erase(key(after));
    after_[before] = after;
    before_[after] = before;
    order_.insert(key(before));
    order_.insert(key(after));
  }

  /// From the first vertex on.
  [[nodiscard]] std::vector<std::size_t> rest() const {
    std::vector<std::size_t> places;
    for (const Key& k : order_) places.push_back(k.second);
    std::ranges::sort(places);
    for (std::size_t& place : places) place = (place + first_) % ring_.size();
    return places;
  }

 private:
  /// The triangle's share of the ring, then the place behind the first vertex, so that the ring's
  /// beginning does not matter.
  using Key = std::pair<float, std::size_t>;
  [[nodiscard]] Key key(std::size_t i) const {
    const double twice_m2 = std::abs(orientation(ring_[before_[i]], ring_[i], ring_[after_[i]]));
    return {rough_share(0.5 * twice_m2 / area_m2_), (i + ring_.size() - first_) % ring_.size()};
  }
  [[nodiscard]] std::size_t vertex(const Key& k) const {
    return (k.second + first_) % ring_.size();
  }

  std::span<const Point> ring_;
  double area_m2_;
  std::size_t first_;
  std::vector<std::size_t> before_;
  std::vector<std::size_t> after_;
  std::set<Key> order_;
};

}  // namespace

float rough_share(double share_01) {
  // Sixteen binary digits, of the share over pi: a simple share, as one eighth, lies on no cut.
  constexpr std::uint32_t kLeadingDigits = 0xffffff00U;
  const auto digits =
      std::bit_cast<std::uint32_t>(static_cast<float>(share_01 * std::numbers::inv_pi));
  return std::bit_cast<float>(digits & kLeadingDigits);
}

std::vector<std::size_t> outline_corners(std::span<const Point> ring, std::size_t max_count) {
  constexpr std::size_t kTriangle = 3;
  Thinning thinning(ring);
  while (
      thinning.size() > kTriangle &&
      (thinning.size() > max_count || thinning.least_rough_share() <= rough_share(kFlatShare_01))) {
    thinning.drop_least();
  }
  return thinning.rest();
}

}  // namespace plat::similarity
