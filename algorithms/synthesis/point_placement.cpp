#include "synthesis/point_placement.h"

#include <cmath>

#include "core/failure.h"
#include "core/working_grid.h"

namespace plat::synthesis {
namespace {

void scale_lengths(streets::PassingStreet& street, double scale) {
  street.distance_mean_m *= scale;
  street.distance_variance_m2 *= scale * scale;
}

}  // namespace

Point placed(Point place, const Placement& placement) {
  Point arm = place - placement.pivot;
  if (placement.mirroring == Mirroring::kAcrossEast) arm.y = -arm.y;
  arm = placement.scale * arm;
  const double cosine = std::cos(placement.rotation_rad);
  const double sine = std::sin(placement.rotation_rad);
  const Point turned{cosine * arm.x - sine * arm.y, sine * arm.x + cosine * arm.y};
  return snap(placement.pivot + turned + placement.translation);
}

PointSet place(std::span<const streets::IntersectionPoint> points, const Placement& placement) {
  expects(placement.scale > 0.0, "scale > 0");
  PointSet out(points.begin(), points.end());
  for (streets::IntersectionPoint& point : out) {
    point.place = placed(point.place, placement);
    if (placement.scale == 1.0) continue;
    scale_lengths(point.a, placement.scale);
    if (point.b) scale_lengths(*point.b, placement.scale);
    if (point.parcel_area_m2) *point.parcel_area_m2 *= placement.scale * placement.scale;
  }
  return out;
}

}  // namespace plat::synthesis
