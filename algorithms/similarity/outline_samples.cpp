#include "similarity/outline_samples.h"

#include <algorithm>
#include <limits>

#include "core/failure.h"

namespace plat::similarity {
namespace {

/// Distances from the centroid that differ by less than this share of the outline's length are
/// equal: rounding differs by a millionth of it, the smallest step of the working grid in a city
/// block by a hundred times it.
constexpr double kTie_01 = 1e-8;

/// An outline by length along it.
class Walk {
 public:
  explicit Walk(std::span<const Point> ring) {
    double walked = 0.0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      places_.push_back(ring[i] - ring.front());
      starts_.push_back(walked);
      walked += plat::distance(ring[i], ring[(i + 1) % ring.size()]);
    }
    length_m_ = walked;
  }

  [[nodiscard]] const Ring& places() const { return places_; }
  [[nodiscard]] double length_m() const { return length_m_; }
  [[nodiscard]] double start_m(std::size_t vertex) const { return starts_[vertex]; }

  /// The point `along_m` behind the first vertex; any number of times round.
  [[nodiscard]] Point at(double along_m) const {
    while (along_m >= length_m_) along_m -= length_m_;
    const auto next = std::ranges::upper_bound(starts_, along_m);
    const auto edge = static_cast<std::size_t>(next - starts_.begin()) - 1;
    const Segment s{places_[edge], places_[(edge + 1) % places_.size()]};
    const double size = length(s);
    return size > 0.0 ? lerp(s.a, s.b, std::min(1.0, (along_m - starts_[edge]) / size)) : s.a;
  }

 private:
  Ring places_;
  std::vector<double> starts_;
  double length_m_ = 0.0;
};

/// Keeps those of `starts` whose value is the largest, or ties with it.
template <class Value>
void keep_largest(std::vector<std::size_t>& starts, double tie, Value value) {
  double largest = -std::numeric_limits<double>::infinity();
  for (const std::size_t vertex : starts) largest = std::max(largest, value(vertex));
  std::erase_if(starts, [&](std::size_t vertex) { return value(vertex) < largest - tie; });
}

std::size_t first_vertex(const Walk& walk, Point centroid, std::size_t count) {
  std::vector<std::size_t> starts(walk.places().size());
  for (std::size_t i = 0; i < starts.size(); ++i) starts[i] = i;
  const double tie = kTie_01 * walk.length_m();
  keep_largest(starts, tie,
               [&](std::size_t vertex) { return distance(walk.places()[vertex], centroid); });
  const double step_m = walk.length_m() / static_cast<double>(count);
  for (std::size_t i = 1; i < count && starts.size() > 1; ++i)
    keep_largest(starts, tie, [&](std::size_t vertex) {
      return distance(walk.at(walk.start_m(vertex) + static_cast<double>(i) * step_m), centroid);
    });
  return starts.front();
}

}  // namespace

OutlineSamples outline_samples(std::span<const Point> ring, std::size_t count) {
  expects(ring.size() >= 3 && count > 0, "a ring, and a number of samples");
  const Walk walk(ring);
  OutlineSamples out{ring.front(), {}, centroid({walk.places(), {}})};
  const double first_m = walk.start_m(first_vertex(walk, out.centroid, count));
  const double step_m = walk.length_m() / static_cast<double>(count);
  out.places.reserve(count);
  for (std::size_t i = 0; i < count; ++i)
    out.places.push_back(walk.at(first_m + static_cast<double>(i) * step_m));
  return out;
}

}  // namespace plat::similarity
