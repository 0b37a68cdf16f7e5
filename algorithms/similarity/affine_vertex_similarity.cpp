#include "similarity/affine_vertex_similarity.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "similarity/corner_choices_internal.h"
#include "similarity/outline_corners.h"
#include "similarity/shape_admission.h"
#include "similarity/vertex_mapping_internal.h"

namespace plat::similarity {
namespace {

using detail::VertexMapping;

/// A corner at a street is one with a street edge before or behind it; one between properties has
/// two property edges; of others nothing is known.
void label_corners(const LabelledShape& shape, const std::vector<std::size_t>& corners,
                   CornerOutline& out) {
  const std::size_t edges = shape.edges.size();
  for (std::size_t k = 0; k < corners.size() && edges > 0; ++k) {
    const EdgeLabel before = shape.edges[(corners[k] + edges - 1) % edges];
    const EdgeLabel behind = shape.edges[corners[k]];
    if (before == EdgeLabel::kStreet || behind == EdgeLabel::kStreet)
      out.street_corners |= 1U << k;
    else if (before == EdgeLabel::kProperty && behind == EdgeLabel::kProperty)
      out.property_corners |= 1U << k;
  }
}

/// The direction in which points about their mean spread most; east where they spread alike in all,
/// as the corners of a square do.
Point principal_axis(const Ring& about_mean) {
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
  for (const Point p : about_mean) {
    xx += p.x * p.x;
    xy += p.x * p.y;
    yy += p.y * p.y;
  }
  constexpr double kRoundingShare = 1e-9;  // of moments of coordinates far from the origin
  if (std::hypot(2.0 * xy, xx - yy) <= kRoundingShare * (xx + yy)) return {1.0, 0.0};
  const double angle_rad = 0.5 * std::atan2(2.0 * xy, xx - yy);
  return {std::cos(angle_rad), std::sin(angle_rad)};
}

/// From the frame to the city.
Affine frame_of(const CornerOutline& outline) {
  return {outline.axis.x, -outline.axis.y, outline.axis.y, outline.axis.x, outline.mean};
}

Point corner_of(const CornerOutline& outline, std::size_t corner) {
  return frame_of(outline)(outline.corners[corner]);
}

Affine map_of(const VertexMapping& mapping, const CornerOutline& from, const CornerOutline& to) {
  const Affine linear{mapping.linear.xx, mapping.linear.xy, mapping.linear.yx, mapping.linear.yy,
                      mapping.to_mean - mapping.linear.linear(mapping.from_mean)};
  const Affine axis = frame_of(from);
  const Affine turned_back{axis.xx, axis.yx, axis.xy, axis.yy, {}};
  return frame_of(to) * linear * turned_back * Affine::translation(-from.mean);
}

}  // namespace

Expected<AffineVertexSimilarity::Prepared> AffineVertexSimilarity::prepare(
    const LabelledShape& shape) const {
  if (auto defect = find_shape_defect(shape)) return tl::unexpected(std::move(*defect));
  const Ring& ring = shape.polygon.outer;
  const auto chosen = outline_corners(ring, static_cast<std::size_t>(options_.max_corners));
  CornerOutline out;
  out.count = chosen.size();
  out.area_m2 = signed_area_m2(ring);
  out.perimeter_m = plat::perimeter_m(ring);
  label_corners(shape, chosen, out);
  Ring corners;
  for (const std::size_t i : chosen) corners.push_back(ring[i] - ring[chosen.front()]);
  Point sum;
  for (const Point p : corners) sum = sum + p;
  const Point mean = sum / static_cast<double>(corners.size());
  out.mean = ring[chosen.front()] + mean;
  out.corner_area_m2 = std::abs(signed_area_m2(corners));
  for (Point& p : corners) p = p - mean;
  if (options_.frame == DistortionFrame::kTileAxes) out.axis = principal_axis(corners);
  for (std::size_t i = 0; i < corners.size(); ++i)
    out.corners[i] = {dot(corners[i], out.axis), dot(corners[i], perpendicular(out.axis))};
  detail::find_choices(out, options_.area_loss_01);
  return Prepared{std::move(out)};
}

double AffineVertexSimilarity::distance(const Prepared& a, const Prepared& b) const {
  const bool is_inverted = a.outline.count < b.outline.count;
  const CornerOutline& from = is_inverted ? b.outline : a.outline;
  const CornerOutline& to = is_inverted ? a.outline : b.outline;
  return detail::best_vertex_mapping(from, to, options_).error;
}

ShapeComparison AffineVertexSimilarity::compare(const Prepared& a, const Prepared& b) const {
  const bool is_inverted = a.outline.count < b.outline.count;
  const CornerOutline& from = is_inverted ? b.outline : a.outline;
  const CornerOutline& to = is_inverted ? a.outline : b.outline;
  const VertexMapping mapping = detail::best_vertex_mapping(from, to, options_);
  ShapeComparison out{mapping.error, std::nullopt, {}};
  std::size_t k = 0;
  for (std::uint32_t rest = mapping.chosen; rest != 0; rest &= rest - 1, ++k) {
    const Point corner = corner_of(from, static_cast<std::size_t>(std::countr_zero(rest)));
    const Point laid_on = corner_of(to, (k + mapping.offset) % to.count);
    out.correspondence.emplace_back(is_inverted ? laid_on : corner, is_inverted ? corner : laid_on);
  }
  if (is_inverted) {
    // In the order of the first outline, which is the one laid on.
    const auto first = static_cast<std::ptrdiff_t>((to.count - mapping.offset) % to.count);
    std::ranges::rotate(out.correspondence, out.correspondence.begin() + first);
  }
  if (mapping.is_least_squares) {
    // The inverse of the best map is not the best map of the inverse, and may be far from it.
    out.transformation =
        is_inverted ? detail::least_squares_map(out.correspondence) : map_of(mapping, from, to);
  }
  return out;
}

SimilarityClaims AffineVertexSimilarity::claims() const {
  return {.common_scale = options_.perimeter == PerimeterUnit::kRelative,
          .collinear_vertices = true};
}

}  // namespace plat::similarity
