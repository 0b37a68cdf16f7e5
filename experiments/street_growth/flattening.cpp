#include "street_growth/flattening.h"

#include <array>
#include <cmath>

#include "core/failure.h"

namespace plat::growth {
namespace {

using streets::IntersectionPoint;
using streets::PassingStreet;

template <class Visit>
void for_each_street(std::vector<IntersectionPoint>& points, Visit visit) {
  for (IntersectionPoint& point : points) {
    visit(point.a);
    if (point.b) visit(*point.b);
  }
}

void flatten(std::vector<IntersectionPoint>& points, double PassingStreet::* member) {
  double sum = 0.0;
  double count = 0.0;
  for_each_street(points, [&](const PassingStreet& street) {
    sum += street.*member;
    count += 1.0;
  });
  for_each_street(points, [&](PassingStreet& street) { street.*member = sum / count; });
}

void flatten_connections(std::vector<IntersectionPoint>& points) {
  double sum = 0.0;
  double count = 0.0;
  for_each_street(points, [&](const PassingStreet& street) {
    sum += street.connections;
    count += 1.0;
  });
  const int mean = static_cast<int>(std::lround(sum / count));
  for_each_street(points, [&](PassingStreet& street) { street.connections = mean; });
}

}  // namespace

std::span<const Attribute> all_attributes() {
  static constexpr std::array kAll{
      Attribute::kHierarchy, Attribute::kTortuosity, Attribute::kDistance,   Attribute::kAngle,
      Attribute::kVariances, Attribute::kWidth,      Attribute::kConnections};
  return kAll;
}

std::string_view attribute_name(Attribute attribute) {
  switch (attribute) {
    case Attribute::kHierarchy:
      return "hierarchy";
    case Attribute::kTortuosity:
      return "tortuosity";
    case Attribute::kDistance:
      return "distance";
    case Attribute::kAngle:
      return "angle";
    case Attribute::kVariances:
      return "variances";
    case Attribute::kWidth:
      return "width";
    case Attribute::kConnections:
      return "connections";
  }
  throw LogicError("an attribute without a name");
}

std::vector<IntersectionPoint> flattened(std::vector<IntersectionPoint> points,
                                         Attribute attribute) {
  if (points.empty()) return points;
  switch (attribute) {
    case Attribute::kHierarchy:
      for_each_street(points, [](PassingStreet& street) { street.hierarchy = 0; });
      break;
    case Attribute::kTortuosity:
      flatten(points, &PassingStreet::tortuosity);
      break;
    case Attribute::kDistance:
      flatten(points, &PassingStreet::distance_mean_m);
      break;
    case Attribute::kAngle:
      flatten(points, &PassingStreet::angle_mean_rad);
      break;
    case Attribute::kVariances:
      flatten(points, &PassingStreet::distance_variance_m2);
      flatten(points, &PassingStreet::angle_variance_rad2);
      break;
    case Attribute::kWidth:
      flatten(points, &PassingStreet::width_m);
      break;
    case Attribute::kConnections:
      flatten_connections(points);
      break;
  }
  return points;
}

}  // namespace plat::growth
