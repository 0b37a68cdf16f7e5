#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "similarity/outline_samples.h"

namespace plat::similarity {

/// Where a sample's histogram has its zero angle.
enum class ContextAlignment : std::uint8_t {
  kTangent,   ///< along the outline: from the sample before to the one behind
  kCentroid,  ///< towards the centroid of the outline's area
  kNone,      ///< east: turned outlines differ
};

/// The bins of a log-polar histogram. A ring's middle is the same factor farther out than that of
/// the ring within.
struct ContextBins {
  std::size_t angular = 8;
  std::size_t distance = 5;
  double inner_radius_m = 8.0;    ///< nearer points are in the innermost ring
  double outer_radius_m = 256.0;  ///< farther points are in the outermost ring
};

/// The shape contexts of an outline's samples: how the other samples lie around each.
struct ShapeContexts {
  std::size_t samples = 0;
  std::size_t bins = 0;
  std::size_t stride = 0;  ///< samples, rounded up to whole vectors
  /// Bin after bin, `stride` values each: which share of the others a sample has in this bin. Of
  /// what is behind the last sample, 0.
  std::vector<float> shares_01;
};

/// A point between the middles of bins counts in part in each of the four, linearly in angle and in
/// the logarithm of distance: contexts are continuous, so that rounding cannot move a point from
/// one bin to the next.
///
/// Guarantees: 1. a sample's shares sum to 1, up to rounding;  2. aligned with the tangent or the
/// centroid, they do not change when the outline is moved or turned.
/// Complexity:  O(samples^2)
/// Paper:       [BMP02], with distances in metres as [Har, Sec. 4.1.3]
/// Deviation:   linear weights instead of counts; points beyond the outer radius are kept (ADR
///              0035)
ShapeContexts shape_contexts(const OutlineSamples& outline, const ContextBins& bins,
                             ContextAlignment alignment);

/// The chi-squared cost of every sample of `a` with every sample of `b`, a row per sample of `a`:
/// half the sum over the bins of (g - h)^2 / (g + h), from 0 to 1.
/// Pre: the same numbers of samples and bins.
/// Complexity:  O(samples^2 * bins)
std::vector<float> context_costs(const ShapeContexts& a, const ShapeContexts& b);

}  // namespace plat::similarity
