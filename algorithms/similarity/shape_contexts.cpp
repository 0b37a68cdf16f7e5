#include "similarity/shape_contexts.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/failure.h"

namespace plat::similarity {
namespace {

constexpr double kFullTurn_rad = 2.0 * std::numbers::pi;
/// Rows are padded to whole vectors of this many floats, so that no loop has a remainder.
constexpr std::size_t kVector = 16;

double direction_rad(Point v) { return std::atan2(v.y, v.x); }

/// Two neighbouring bins and the share of the second.
struct Between {
  std::size_t first = 0;
  std::size_t second = 0;
  double share_01 = 0.0;
};

class Histograms {
 public:
  Histograms(std::size_t samples, const ContextBins& bins)
      : bins_(bins),
        shares_(samples * bins.angular * bins.distance),
        rings_per_log_(static_cast<double>(bins.distance) /
                       std::log(bins.outer_radius_m / bins.inner_radius_m)),
        weight_(1.0 / static_cast<double>(samples - 1)) {}

  [[nodiscard]] Between ring(double squared_distance_m2) const {
    const double radius =
        0.5 * std::log(squared_distance_m2 / (bins_.inner_radius_m * bins_.inner_radius_m));
    const auto last = static_cast<double>(bins_.distance - 1);
    // Ring t reaches from t to t + 1, its middle lies between; a distance of 0 is in the first.
    const double at = std::clamp(rings_per_log_ * radius - 0.5, 0.0, last);
    const auto first = static_cast<std::size_t>(at);
    return {first, std::min(first + 1, bins_.distance - 1), at - static_cast<double>(first)};
  }

  [[nodiscard]] Between sector(double angle_rad) const {
    const double turns = angle_rad / kFullTurn_rad;
    const double at = (turns - std::floor(turns)) * static_cast<double>(bins_.angular);
    const auto first = static_cast<std::size_t>(at);
    return {first % bins_.angular, (first + 1) % bins_.angular, at - static_cast<double>(first)};
  }

  void add(std::size_t sample, const Between& ring, const Between& sector) {
    double* of_sample = shares_.data() + sample * bins_.angular * bins_.distance;
    double* near = of_sample + ring.first * bins_.angular;
    double* far = of_sample + ring.second * bins_.angular;
    const double to_far = weight_ * ring.share_01;
    const double to_near = weight_ - to_far;
    near[sector.first] += to_near * (1.0 - sector.share_01);
    near[sector.second] += to_near * sector.share_01;
    far[sector.first] += to_far * (1.0 - sector.share_01);
    far[sector.second] += to_far * sector.share_01;
  }

  [[nodiscard]] const std::vector<double>& shares() const { return shares_; }

 private:
  ContextBins bins_;
  std::vector<double> shares_;  ///< sample after sample
  double rings_per_log_;
  double weight_;
};

std::vector<double> zero_angles(const OutlineSamples& outline, ContextAlignment alignment) {
  const std::vector<Point>& places = outline.places;
  const std::size_t n = places.size();
  std::vector<double> out(n, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    if (alignment == ContextAlignment::kTangent)
      out[i] = direction_rad(places[(i + 1) % n] - places[(i + n - 1) % n]);
    if (alignment == ContextAlignment::kCentroid)
      out[i] = direction_rad(outline.centroid - places[i]);
  }
  return out;
}

}  // namespace

ShapeContexts shape_contexts(const OutlineSamples& outline, const ContextBins& bins,
                             ContextAlignment alignment) {
  const std::size_t n = outline.places.size();
  expects(n >= 3 && bins.angular > 0 && bins.distance > 0, "samples and bins");
  expects(0.0 < bins.inner_radius_m && bins.inner_radius_m < bins.outer_radius_m, "radii grow");
  const std::vector<double> zero_rad = zero_angles(outline, alignment);
  Histograms histograms(n, bins);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      const Point to = outline.places[j] - outline.places[i];
      const Between ring = histograms.ring(squared_length(to));
      const double angle_rad = direction_rad(to);
      histograms.add(i, ring, histograms.sector(angle_rad - zero_rad[i]));
      histograms.add(j, ring, histograms.sector(angle_rad + 0.5 * kFullTurn_rad - zero_rad[j]));
    }
  }
  ShapeContexts out{n, bins.angular * bins.distance, (n + kVector - 1) / kVector * kVector, {}};
  out.shares_01.resize(out.bins * out.stride);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t t = 0; t < out.bins; ++t)
      out.shares_01[t * out.stride + i] = static_cast<float>(histograms.shares()[i * out.bins + t]);
  return out;
}

namespace {

/// Adds (share - h)^2 / (share + h) for every h of the row. Pre: share > 0.
void add_terms(float share, const float* __restrict row, std::size_t vectors,
               float* __restrict sums) {
  for (std::size_t j = 0; j < kVector * vectors; ++j) {
    const float difference = share - row[j];
    sums[j] += difference * difference / (share + row[j]);
  }
}

/// The same for a share of 0.
void add_shares(const float* __restrict row, std::size_t vectors, float* __restrict sums) {
  for (std::size_t j = 0; j < kVector * vectors; ++j) sums[j] += row[j];
}

}  // namespace

std::vector<float> context_costs(const ShapeContexts& a, const ShapeContexts& b) {
  expects(a.samples == b.samples && a.bins == b.bins, "the same samples and bins");
  const std::size_t n = a.samples;
  const std::size_t vectors = b.stride / kVector;
  std::vector<float> out(n * n);
  std::vector<float> sums(b.stride);
  for (std::size_t i = 0; i < n; ++i) {
    std::ranges::fill(sums, 0.0F);
    for (std::size_t t = 0; t < a.bins; ++t) {
      const float share = a.shares_01[t * a.stride + i];
      const float* row = b.shares_01.data() + t * b.stride;
      if (share > 0.0F) {
        add_terms(share, row, vectors, sums.data());
      } else {
        add_shares(row, vectors, sums.data());
      }
    }
    for (std::size_t j = 0; j < n; ++j) out[i * n + j] = 0.5F * sums[j];
  }
  return out;
}

}  // namespace plat::similarity
