#pragma once

#include <array>
#include <string>

#include "similarity/labelled_shape.h"

namespace plat::similarity {

/// What is known of a shape without laying it on another one: S = [z, a, n, mu, sigma].
/// Paper: [ABVA08, Sec. 5]
struct ShapeDescriptor {
  std::string zone;                  ///< z; empty where unknown
  double area_m2 = 0.0;              ///< a, without holes
  int corner_count = 0;              ///< n, vertices of the outline that turn
  double mean_angle_rad = 0.0;       ///< mu, of the interior angles at the corners
  double angle_deviation_rad = 0.0;  ///< sigma, of the same, over all n

  friend bool operator==(const ShapeDescriptor&, const ShapeDescriptor&) = default;
};

/// How much each entry of the descriptor counts in a distance; 0: not at all.
struct DescriptorWeights {
  double zone = 1.0;             ///< of two known zones that differ
  double area = 1.0;             ///< of the difference in log area
  double corner_count = 0.25;    ///< per corner
  double mean_angle = 1.0;       ///< per radian
  double angle_deviation = 1.0;  ///< per radian
};

/// A vertex that turns by less is none: one on a straight edge that was rounded to the working
/// grid, a metre or more from its neighbours, turns by at most this. Each vertex is judged alone,
/// so that the count is the same for a shape turned or mirrored.
inline constexpr double kStraightTurn_rad = 2e-3;

/// The descriptor of a valid polygon. An outline that nowhere turns by more counts all its
/// vertices.
///
/// Guarantees: 1. the same for every position, direction and mirror image, up to rounding;  2. the
/// mean angle is (n - 2) pi / n, which the angles of any n-gon sum up to: it tells nothing that n
/// does not, but weighs a corner more among few.
ShapeDescriptor descriptor_of(const LabelledShape& shape);

/// All of a descriptor but the zone: (w log a, w n, w mu, w sigma). Euclidean distance between two
/// of these, and the zone's weight, are the distance of descriptors.
std::array<double, 4> weighted_coordinates(const ShapeDescriptor& descriptor,
                                           const DescriptorWeights& weights);

/// Whether both zones are known and differ.
bool are_zones_different(const ShapeDescriptor& a, const ShapeDescriptor& b);

/// sqrt(w_z^2 [zones differ] + |coordinates of a - coordinates of b|^2).
double descriptor_distance(const ShapeDescriptor& a, const ShapeDescriptor& b,
                           const DescriptorWeights& weights);

}  // namespace plat::similarity
