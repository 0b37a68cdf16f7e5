#include "geodata/projection_internal.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/failure.h"

namespace plat::geodata::detail {
namespace {

constexpr double kOriginStep_m = 1000.0;

SpatialReference utm_reference(const OGRSpatialReference& source, Point center) {
  const Point degrees = Projection(source, *reference_from_epsg(4326))(center);
  if (!is_finite(degrees)) return nullptr;
  const int zone = std::clamp(static_cast<int>(std::floor((degrees.x + 180.0) / 6.0)) + 1, 1, 60);
  return reference_from_epsg((degrees.y < 0.0 ? 32700 : 32600) + zone);
}

}  // namespace

Projection::Projection(const OGRSpatialReference& from, const OGRSpatialReference& to) {
  if (from.IsSame(&to)) return;
  transformation_.reset(OGRCreateCoordinateTransformation(&from, &to));
  expects(transformation_ != nullptr, "two valid references have a transformation");
}

Point Projection::operator()(Point p) const {
  std::vector<Point> one{p};
  apply(one);
  return one.front();
}

void Projection::apply(std::vector<Point>& points) const {
  for (Point& p : points) {
    if (!is_finite(p)) p = {kNaN, kNaN};
  }
  if (transformation_ == nullptr) return;
  std::vector<double> x(points.size());
  std::vector<double> y(points.size());
  std::vector<int> ok(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    x[i] = points[i].x;
    y[i] = points[i].y;
  }
  transformation_->Transform(static_cast<int>(points.size()), x.data(), y.data(), nullptr,
                             ok.data());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point mapped{x[i], y[i]};
    points[i] =
        ok[i] != 0 && is_finite(points[i]) && is_finite(mapped) ? mapped : Point{kNaN, kNaN};
  }
}

bool is_metric(const OGRSpatialReference& reference) {
  if (reference.IsProjected() == 0 || reference.GetLinearUnits() != 1.0) return false;
  const char* method = reference.GetAttrValue("PROJECTION");
  return method == nullptr ||
         (!EQUAL(method, SRS_PT_MERCATOR_AUXILIARY_SPHERE) && !EQUAL(method, SRS_PT_MERCATOR_1SP) &&
          !EQUAL(method, SRS_PT_MERCATOR_2SP) &&
          !EQUAL(method, "Popular_Visualisation_Pseudo_Mercator"));
}

LocalFrame choose_frame(const OGRSpatialReference& source, Point center, const std::string& name,
                        std::string_view tool) {
  const SpatialReference target(is_metric(source) ? source.Clone()
                                                  : utm_reference(source, center).release());
  const Point local = target ? Projection(source, *target)(center) : Point{kNaN, kNaN};
  if (!is_finite(local)) {
    throw InputError(
        fmt::format("{}: its centre ({}, {}) is not a place in its coordinate reference system "
                    "\"{}\"; set the right one: {} -a_srs",
                    name, center.x, center.y, source.GetName(), tool));
  }
  return {wkt_of(*target),
          {std::round(local.x / kOriginStep_m) * kOriginStep_m,
           std::round(local.y / kOriginStep_m) * kOriginStep_m}};
}

}  // namespace plat::geodata::detail
