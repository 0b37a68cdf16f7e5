#include "similarity/shape_descriptor.h"

#include <cmath>
#include <numbers>

namespace plat::similarity {
namespace {

Ring turning_vertices(const Ring& outline) {
  Ring out;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    if (std::abs(turn_rad(outline, i)) > kStraightTurn_rad) out.push_back(outline[i]);
  }
  constexpr std::size_t kTriangle = 3;
  return out.size() < kTriangle ? outline : out;
}

}  // namespace

ShapeDescriptor descriptor_of(const LabelledShape& shape) {
  const Ring corners = turning_vertices(shape.polygon.outer);
  const auto count = static_cast<double>(corners.size());
  const double mean = std::numbers::pi * (count - 2.0) / count;
  double squares = 0.0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const double angle = std::numbers::pi - turn_rad(corners, i);
    squares += (angle - mean) * (angle - mean);
  }
  return {shape.zone, area_m2(shape.polygon), static_cast<int>(corners.size()), mean,
          std::sqrt(squares / count)};
}

std::array<double, 4> weighted_coordinates(const ShapeDescriptor& descriptor,
                                           const DescriptorWeights& weights) {
  return {weights.area * std::log(descriptor.area_m2),
          weights.corner_count * static_cast<double>(descriptor.corner_count),
          weights.mean_angle * descriptor.mean_angle_rad,
          weights.angle_deviation * descriptor.angle_deviation_rad};
}

bool are_zones_different(const ShapeDescriptor& a, const ShapeDescriptor& b) {
  return !a.zone.empty() && !b.zone.empty() && a.zone != b.zone;
}

double descriptor_distance(const ShapeDescriptor& a, const ShapeDescriptor& b,
                           const DescriptorWeights& weights) {
  const auto x = weighted_coordinates(a, weights);
  const auto y = weighted_coordinates(b, weights);
  double squares = are_zones_different(a, b) ? weights.zone * weights.zone : 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) squares += (x[i] - y[i]) * (x[i] - y[i]);
  return std::sqrt(squares);
}

}  // namespace plat::similarity
