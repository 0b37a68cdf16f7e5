#include "parcels/parcel_matching.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "core/failure.h"
#include "core/working_grid.h"
#include "parcels/overlap.h"

namespace plat::parcels {
namespace {

using CornerPairs = std::vector<std::pair<Point, Point>>;
using Matches = std::vector<std::optional<ParcelMatch>>;

constexpr std::array<std::pair<ParcelMatching, std::string_view>, 3> kNames{{
    {ParcelMatching::kRelativeDistances, "relative_distances"},
    {ParcelMatching::kNearestCentroid, "nearest_centroid"},
    {ParcelMatching::kLargestOverlap, "largest_overlap"},
}};

/// A vertex nearer than this to the line through its neighbours is straight: a T-junction is noded
/// on the working grid, within a step and a half.
constexpr double kStraight_m = 2.0 * kGridStep_m;

/// The indices of the vertices where the contour really turns.
std::vector<std::size_t> corners_of(std::span<const Point> ring) {
  std::vector<std::size_t> out;
  const std::size_t n = ring.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Segment across{ring[(i + n - 1) % n], ring[(i + 1) % n]};
    if (distance(across, ring[i]) > kStraight_m) out.push_back(i);
  }
  return out;
}

CornerPairs by_labels(const MatchedBlock& before, const MatchedBlock& after) {
  using Key = std::pair<std::uint32_t, std::uint32_t>;
  const auto file = [](const MatchedBlock& block) {
    std::map<Key, std::vector<std::size_t>> out;
    const std::size_t n = block.contour.size();
    for (const std::size_t i : corners_of(block.contour))
      out[{block.labels[(i + n - 1) % n], block.labels[i]}].push_back(i);
    return out;
  };
  const auto old_corners = file(before);
  std::map<std::size_t, std::size_t> partner;  // by index before: ring order
  for (const auto& [key, now] : file(after)) {
    const auto it = old_corners.find(key);
    if (it == old_corners.end() || it->second.size() != now.size()) continue;
    for (std::size_t k = 0; k < now.size(); ++k) partner.emplace(it->second[k], now[k]);
  }
  CornerPairs out;
  for (const auto& [i, j] : partner) out.emplace_back(before.contour[i], after.contour[j]);
  return out;
}

std::vector<Point> points_at(std::span<const Point> ring, std::span<const std::size_t> indices) {
  std::vector<Point> out;
  for (const std::size_t i : indices) out.push_back(ring[i]);
  return out;
}

/// Equally many corners: the turn of the ring that a similarity maps best.
CornerPairs by_shape(const std::vector<Point>& before, const std::vector<Point>& after) {
  const std::size_t n = before.size();
  const auto centred = [&](std::vector<Point> points) {
    Point mean;
    for (const Point p : points) mean = mean + p / static_cast<double>(n);
    for (Point& p : points) p = p - mean;
    return points;
  };
  const std::vector<Point> a = centred(before);
  const std::vector<Point> b = centred(after);
  // Of turns that fit equally well, to rounding, the one that rotates the least.
  constexpr double kEquallyGood = 1e-9;
  std::size_t best_turn = 0;
  double best_fit = -1.0;
  double best_cosine = -2.0;
  for (std::size_t turn = 0; turn < n; ++turn) {
    double along = 0.0;
    double across = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      along += dot(a[i], b[(i + turn) % n]);
      across += cross(a[i], b[(i + turn) % n]);
    }
    const double fit = std::hypot(along, across);
    const double cosine = fit > 0.0 ? along / fit : 0.0;
    const bool is_better = fit > best_fit * (1.0 + kEquallyGood) ||
                           (fit > best_fit * (1.0 - kEquallyGood) && cosine > best_cosine);
    if (!is_better) continue;
    best_fit = fit;
    best_cosine = cosine;
    best_turn = turn;
  }
  CornerPairs out;
  for (std::size_t i = 0; i < n; ++i) out.emplace_back(before[i], after[(i + best_turn) % n]);
  return out;
}

std::size_t nearest_index(std::span<const Point> points, Point p) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (squared_length(points[i] - p) < squared_length(points[best] - p)) best = i;
  }
  return best;
}

CornerPairs by_place(const std::vector<Point>& before, const std::vector<Point>& after) {
  CornerPairs out;
  if (before.empty() || after.empty()) return out;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const std::size_t j = nearest_index(after, before[i]);
    if (nearest_index(before, after[j]) == i) out.emplace_back(before[i], after[j]);
  }
  return out;
}

std::vector<Point> centres_of(std::span<const Parcel> parcels) {
  std::vector<Point> out;
  for (const Parcel& parcel : parcels) out.push_back(centroid(parcel.shape));
  return out;
}

/// l_{i,k}: distances to the corners over their sum, one row per parcel.
std::vector<double> relative_distances(std::span<const Point> centres,
                                       std::span<const Point> corners) {
  std::vector<double> out;
  out.reserve(centres.size() * corners.size());
  for (const Point centre : centres) {
    double sum = 0.0;
    const std::size_t row = out.size();
    for (const Point corner : corners) {
      out.push_back(distance(centre, corner));
      sum += out.back();
    }
    for (std::size_t k = row; k < out.size(); ++k) out[k] /= sum;
  }
  return out;
}

/// The nearest parcel before, by `distance_of(after, before, bound)`, which may stop above `bound`.
template <class DistanceOf>
Matches nearest(std::size_t before_count, std::size_t after_count, DistanceOf distance_of) {
  Matches out(after_count);
  for (std::size_t i = 0; i < after_count; ++i) {
    for (std::uint32_t j = 0; j < before_count; ++j) {
      constexpr double kNoBound = std::numeric_limits<double>::infinity();
      const double d = distance_of(i, j, out[i] ? out[i]->distance : kNoBound);
      if (!out[i] || d < out[i]->distance) out[i] = ParcelMatch{j, d};
    }
  }
  return out;
}

Matches by_centroid(std::span<const Point> before, std::span<const Point> after) {
  return nearest(before.size(), after.size(), [&](std::size_t i, std::size_t j, double) {
    return distance(after[i], before[j]);
  });
}

Matches by_relative_distances(const MatchedBlock& before, const MatchedBlock& after) {
  const std::vector<Point> old_centres = centres_of(before.parcels);
  const std::vector<Point> new_centres = centres_of(after.parcels);
  const CornerPairs pairs = corresponding_corners(before, after);
  if (pairs.size() < kMinMatchedCorners) return by_centroid(old_centres, new_centres);
  std::vector<Point> old_corners;
  std::vector<Point> new_corners;
  for (const auto& [old_corner, new_corner] : pairs) {
    old_corners.push_back(old_corner);
    new_corners.push_back(new_corner);
  }
  const std::vector<double> old_places = relative_distances(old_centres, old_corners);
  const std::vector<double> new_places = relative_distances(new_centres, new_corners);
  const std::size_t k = pairs.size();
  return nearest(old_centres.size(), new_centres.size(),
                 [&](std::size_t i, std::size_t j, double bound) {
                   double sum = 0.0;
                   for (std::size_t c = 0; c < k && sum <= bound; ++c)
                     sum += std::abs(new_places[i * k + c] - old_places[j * k + c]);
                   return sum;
                 });
}

Matches by_overlap(const MatchedBlock& before, const MatchedBlock& after) {
  Matches out(after.parcels.size());
  for (const Overlap& overlap : find_overlaps(after.parcels, before.parcels)) {
    std::optional<ParcelMatch>& best = out[overlap.first];
    if (!best || -overlap.area_m2 < best->distance)
      best = ParcelMatch{overlap.second, -overlap.area_m2};
  }
  return out;
}

}  // namespace

std::string_view matching_name(ParcelMatching matching) {
  return kNames[static_cast<std::size_t>(matching)].second;
}

std::optional<ParcelMatching> matching_named(std::string_view name) {
  for (const auto& [matching, known] : kNames) {
    if (known == name) return matching;
  }
  return std::nullopt;
}

std::vector<std::pair<Point, Point>> corresponding_corners(const MatchedBlock& before,
                                                           const MatchedBlock& after) {
  const bool has_labels =
      before.labels.size() == before.contour.size() && after.labels.size() == after.contour.size();
  if (has_labels && !before.labels.empty()) return by_labels(before, after);
  const auto old_corners = points_at(before.contour, corners_of(before.contour));
  const auto new_corners = points_at(after.contour, corners_of(after.contour));
  return old_corners.size() == new_corners.size() ? by_shape(old_corners, new_corners)
                                                  : by_place(old_corners, new_corners);
}

std::vector<std::optional<ParcelMatch>> match_parcels(ParcelMatching matching,
                                                      const MatchedBlock& before,
                                                      const MatchedBlock& after) {
  switch (matching) {
    case ParcelMatching::kRelativeDistances:
      return by_relative_distances(before, after);
    case ParcelMatching::kNearestCentroid:
      return by_centroid(centres_of(before.parcels), centres_of(after.parcels));
    case ParcelMatching::kLargestOverlap:
      return by_overlap(before, after);
  }
  throw LogicError("a parcel matching without a case");
}

}  // namespace plat::parcels
