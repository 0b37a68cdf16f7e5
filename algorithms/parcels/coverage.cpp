#include "parcels/coverage.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "core/validity.h"

namespace plat::parcels {
namespace {

/// Whether the chain ring[first] .. ring[first + count] follows edge (a, b) within the tolerance
/// and never backwards.
bool follows(const std::vector<Point>& chain, const Segment& edge, double tolerance_m) {
  double last = 0.0;
  for (const Point p : chain) {
    if (distance(edge, p) > tolerance_m) return false;
    const double along = dot(p - edge.a, edge.b - edge.a);
    if (along < last) return false;
    last = along;
  }
  return true;
}

}  // namespace

std::optional<Failure> find_coverage_defect(const Polygon& contour, std::span<const Parcel> parcels,
                                            double tolerance_m) {
  using Directed = std::pair<Point, Point>;
  std::vector<Directed> edges;
  for (const Parcel& parcel : parcels) {
    if (auto defect = find_ogc_defect(parcel.shape)) {
      defect->message = fmt::format("parcel {}: {}", parcel.id.value, defect->message);
      return defect;
    }
    for_each_edge(parcel.shape, [&](const Segment& s) { edges.emplace_back(s.a, s.b); });
  }
  std::sort(edges.begin(), edges.end());
  if (const auto twice = std::adjacent_find(edges.begin(), edges.end()); twice != edges.end()) {
    return Failure{
        FailureCode::kNotCovered,
        fmt::format("two parcels run along the same side of an edge near ({:.3f}, {:.3f})",
                    twice->first.x, twice->first.y)};
  }
  std::vector<Directed> left_over;
  for (const Directed& e : edges) {
    if (!std::binary_search(edges.begin(), edges.end(), Directed{e.second, e.first}))
      left_over.push_back(e);
  }

  // The left-over edges, sorted by their start, must chain along every contour edge in turn.
  std::size_t used = 0;
  std::optional<Failure> defect;
  for_each_edge(contour, [&](const Segment& side) {
    if (defect) return;
    std::vector<Point> chain{side.a};
    while (chain.back() != side.b) {
      const auto from = std::lower_bound(left_over.begin(), left_over.end(),
                                         Directed{chain.back(), {-1e300, -1e300}});
      if (from == left_over.end() || from->first != chain.back() ||
          chain.size() > left_over.size()) {
        defect = Failure{FailureCode::kNotCovered,
                         fmt::format("the parcels leave the contour near ({:.3f}, {:.3f})",
                                     chain.back().x, chain.back().y)};
        return;
      }
      chain.push_back(from->second);
      ++used;
    }
    if (!follows(chain, side, tolerance_m)) {
      defect = Failure{
          FailureCode::kNotCovered,
          fmt::format("the parcels' outline departs from the contour edge at ({:.3f}, {:.3f})",
                      side.a.x, side.a.y)};
    }
  });
  if (defect) return defect;
  if (used != left_over.size()) {
    return Failure{FailureCode::kNotCovered,
                   fmt::format("{} parcel edges have no counterpart, {} belong to the contour",
                               left_over.size(), used)};
  }
  return std::nullopt;
}

}  // namespace plat::parcels
