#include "similarity/hausdorff_similarity.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/box.h"
#include "similarity/outline_hausdorff.h"
#include "similarity/shape_admission.h"

namespace plat::similarity {
namespace {

/// Boxes whose areas differ by less than this share are equally small: above rounding, below what
/// the working grid tells apart in a lot.
constexpr double kTie_01 = 1e-6;
/// Directions nearer than this are one: a micrometre in a kilometre.
constexpr double kSameDirection_rad = 1e-9;

/// The direction or one that is a quarter turn or more from it, in x > 0, y >= 0.
Point in_first_quadrant(Point v) {
  while (!(v.x > 0.0 && v.y >= 0.0)) v = perpendicular(v);
  return v;
}

void add_new(std::vector<Point>& directions, Point direction) {
  const bool is_known = std::ranges::any_of(
      directions, [&](Point known) { return distance(known, direction) < kSameDirection_rad; });
  if (!is_known) directions.push_back(direction);
}

/// Directions of the sides of all boxes of least area. Pre: the points do not lie on a line.
std::vector<Point> box_axes(const Ring& points) {
  const Ring hull = convex_hull(points);
  std::vector<Point> axes;
  std::vector<double> areas_m2;
  double least_m2 = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Point along = normalized(hull[(i + 1) % hull.size()] - hull[i]);
    Box extent;
    for (const Point p : hull) extent.add(Point{dot(p, along), cross(along, p)});
    axes.push_back(in_first_quadrant(along));
    areas_m2.push_back(extent.width() * extent.height());
    least_m2 = std::min(least_m2, areas_m2.back());
  }
  std::vector<Point> out;
  for (std::size_t i = 0; i < axes.size(); ++i)
    if (areas_m2[i] <= least_m2 * (1.0 + kTie_01)) add_new(out, axes[i]);
  return out;
}

using Prepared = HausdorffSimilarity::Prepared;

/// Unit vectors (cosine, sine) of the rotations of `a` that are tried.
std::vector<Point> rotations(const Prepared& a, const Prepared& b, OutlineTurn turn) {
  if (turn == OutlineTurn::kNone) return {{1.0, 0.0}};
  std::vector<Point> out;
  for (const Point to : b.axes)
    for (const Point from : a.axes) {
      Point rotation = normalized(Point{dot(from, to), cross(from, to)});
      for (int quarter = 0; quarter < 4; ++quarter) {
        add_new(out, rotation);
        rotation = perpendicular(rotation);
      }
    }
  return out;
}

struct Best {
  double distance_m = std::numeric_limits<double>::infinity();
  Point rotation{1.0, 0.0};
};

Affine rotated(Point rotation) { return {rotation.x, -rotation.y, rotation.y, rotation.x, {}}; }

Best best_rotation(const Prepared& a, const Prepared& b, OutlineTurn turn) {
  Best best;
  Ring image(a.outline.size());
  for (const Point rotation : rotations(a, b, turn)) {
    std::ranges::transform(a.outline, image.begin(), rotated(rotation));
    const double distance_m = outline_hausdorff_m(image, b.outline, best.distance_m);
    if (distance_m < best.distance_m) best = {distance_m, rotation};
  }
  return best;
}

}  // namespace

Expected<Prepared> HausdorffSimilarity::prepare(const LabelledShape& shape) const {
  if (auto defect = find_shape_defect(shape)) return tl::unexpected(std::move(*defect));
  const Point origin = shape.polygon.outer.front();
  Prepared out;
  for (const Point p : shape.polygon.outer) out.outline.push_back(p - origin);
  const Point middle = plat::centroid({out.outline, {}});
  for (Point& p : out.outline) p = p - middle;
  out.centroid = origin + middle;
  if (options_.turn == OutlineTurn::kBox) out.axes = box_axes(out.outline);
  return out;
}

double HausdorffSimilarity::distance(const Prepared& a, const Prepared& b) const {
  return best_rotation(a, b, options_.turn).distance_m;
}

ShapeComparison HausdorffSimilarity::compare(const Prepared& a, const Prepared& b) const {
  const Best best = best_rotation(a, b, options_.turn);
  Affine map = rotated(best.rotation);
  map.shift = b.centroid - map.linear(a.centroid);
  return {best.distance_m, map, {}};
}

SimilarityClaims HausdorffSimilarity::claims() const {
  return {.is_symmetric = true,
          .rotation = options_.turn != OutlineTurn::kNone,
          .collinear_vertices = true};
}

}  // namespace plat::similarity
