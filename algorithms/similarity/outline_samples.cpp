#include "similarity/outline_samples.h"

#include <algorithm>
#include <limits>

#include "core/failure.h"
#include "similarity/outline_walk.h"

namespace plat::similarity {
namespace {

/// Distances from the centroid that differ by less than this share of the outline's length are
/// equal: rounding differs by a millionth of it, the smallest step of the working grid in a city
/// block by a hundred times it.
constexpr double kTie_01 = 1e-8;

/// Keeps those of `starts` whose value is the largest, or ties with it.
template <class Value>
void keep_largest(std::vector<std::size_t>& starts, double tie, Value value) {
  double largest = -std::numeric_limits<double>::infinity();
  for (const std::size_t vertex : starts) largest = std::max(largest, value(vertex));
  std::erase_if(starts, [&](std::size_t vertex) { return value(vertex) < largest - tie; });
}

std::size_t first_vertex(const OutlineWalk& walk, Point centroid, std::size_t count) {
  std::vector<std::size_t> starts(walk.places().size());
  for (std::size_t i = 0; i < starts.size(); ++i) starts[i] = i;
  const double tie = kTie_01 * walk.length_m();
  keep_largest(starts, tie,
               [&](std::size_t vertex) { return distance(walk.places()[vertex], centroid); });
  // Samples as seen from the centroid towards the start, ahead and to the left: a mirror image has
  // the same distances only.
  const double step_m = walk.length_m() / static_cast<double>(count);
  for (std::size_t i = 1; i < count && starts.size() > 1; ++i) {
    const auto seen = [&](std::size_t vertex) {
      const Point ahead = normalized(walk.places()[vertex] - centroid);
      const Point sample =
          walk.at(walk.start_m(vertex) + static_cast<double>(i) * step_m) - centroid;
      return Point{dot(ahead, sample), cross(ahead, sample)};
    };
    keep_largest(starts, tie, [&](std::size_t vertex) { return seen(vertex).x; });
    keep_largest(starts, tie, [&](std::size_t vertex) { return seen(vertex).y; });
  }
  // What is left are the images of one under a rotation; who looks at directions must see the same.
  keep_largest(starts, tie, [&](std::size_t vertex) { return -walk.places()[vertex].x; });
  keep_largest(starts, tie, [&](std::size_t vertex) { return -walk.places()[vertex].y; });
  return starts.front();
}

}  // namespace

OutlineSamples outline_samples(std::span<const Point> ring, std::size_t count) {
  expects(ring.size() >= 3 && count > 0, "a ring, and a number of samples");
  const OutlineWalk walk(ring);
  OutlineSamples out{walk.origin(), {}, centroid({walk.places(), {}})};
  const double first_m = walk.start_m(first_vertex(walk, out.centroid, count));
  const double step_m = walk.length_m() / static_cast<double>(count);
  out.places.reserve(count);
  for (std::size_t i = 0; i < count; ++i)
    out.places.push_back(walk.at(first_m + static_cast<double>(i) * step_m));
  return out;
}

}  // namespace plat::similarity
