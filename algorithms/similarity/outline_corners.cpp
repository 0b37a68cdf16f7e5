#include "similarity/outline_corners.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "core/polygon.h"

namespace plat::similarity {
namespace {

/// The vertices of a ring that are left, by the size of their triangles.
class Thinning {
 public:
  explicit Thinning(std::span<const Point> ring)
      : ring_(ring), before_(ring.size()), after_(ring.size()), size_(ring.size()) {
    first_ = static_cast<std::size_t>(std::ranges::min_element(ring) - ring.begin());
    for (std::size_t i = 0; i < ring.size(); ++i) {
      before_[i] = (i + ring.size() - 1) % ring.size();
      after_[i] = (i + 1) % ring.size();
    }
    for (std::size_t i = 0; i < ring.size(); ++i) order_.insert(key(i));
  }

  [[nodiscard]] std::size_t size() const { return order_.size(); }
  [[nodiscard]] double least_m2() const { return order_.begin()->first; }

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

  [[nodiscard]] std::vector<std::size_t> rest() const {
    std::vector<std::size_t> out;
    for (const Key& k : order_) out.push_back(k.second);
    std::ranges::sort(out);
    for (std::size_t& i : out) i = (i + first_) % size_;
    return out;
  }

 private:
  /// The triangle in single precision, so that triangles that are equal but for rounding are equal;
  /// then the place behind the first vertex, so that the ring's beginning does not matter.
  using Key = std::pair<float, std::size_t>;
  [[nodiscard]] Key key(std::size_t i) const {
    const double triangle_m2 =
        0.5 * std::abs(orientation(ring_[before_[i]], ring_[i], ring_[after_[i]]));
    return {static_cast<float>(triangle_m2), (i + size_ - first_) % size_};
  }
  [[nodiscard]] std::size_t vertex(const Key& k) const { return (k.second + first_) % size_; }

  std::span<const Point> ring_;
  std::vector<std::size_t> before_;
  std::vector<std::size_t> after_;
  std::size_t size_;
  std::size_t first_;
  std::set<Key> order_;
};

}  // namespace

std::vector<std::size_t> outline_corners(std::span<const Point> ring, std::size_t max_count) {
  constexpr std::size_t kTriangle = 3;
  const double flat_m2 = kFlatShare_01 * std::abs(signed_area_m2(ring));
  Thinning thinning(ring);
  while (thinning.size() > kTriangle &&
         (thinning.size() > max_count || thinning.least_m2() <= flat_m2)) {
    thinning.drop_least();
  }
  return thinning.rest();
}

}  // namespace plat::similarity
