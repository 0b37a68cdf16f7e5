#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "similarity/affine_vertex_similarity.h"

namespace plat::testing {

/// The mapping of least error [ABVA08, Sec. 5] by plain recursion: every corner is removed in every
/// order, every shift is solved by normal equations of three unknowns a coordinate, nothing is
/// pruned, remembered or centred.
struct PlainVertexMapping {
  double error = std::numeric_limits<double>::infinity();
};

namespace plain {

using similarity::AffineVertexSimilarity;
using similarity::EdgeLabel;
using similarity::LabelledShape;

struct LabelledCorner {
  Point at;
  EdgeLabel type = EdgeLabel::kUnknown;
};
using Corners = std::vector<LabelledCorner>;

/// The corners of a polygon without vertices on straight edges.
inline Corners corners_of(const LabelledShape& shape) {
  const Ring& ring = shape.polygon.outer;
  Corners out;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    LabelledCorner corner{ring[i]};
    if (!shape.edges.empty()) {
      const EdgeLabel before = shape.edges[(i + ring.size() - 1) % ring.size()];
      const EdgeLabel behind = shape.edges[i];
      if (before == EdgeLabel::kStreet || behind == EdgeLabel::kStreet)
        corner.type = EdgeLabel::kStreet;
      else if (before == EdgeLabel::kProperty && behind == EdgeLabel::kProperty)
        corner.type = EdgeLabel::kProperty;
    }
    out.push_back(corner);
  }
  return out;
}

inline Ring ring_of(const Corners& corners) {
  Ring out;
  for (const LabelledCorner& c : corners) out.push_back(c.at);
  return out;
}

/// Solves the 3 x 3 system by Cramer's rule.
inline std::array<double, 3> solve(const std::array<std::array<double, 3>, 3>& m,
                                   const std::array<double, 3>& right) {
  const auto determinant = [](const std::array<std::array<double, 3>, 3>& d) {
    return d[0][0] * (d[1][1] * d[2][2] - d[1][2] * d[2][1]) -
           d[0][1] * (d[1][0] * d[2][2] - d[1][2] * d[2][0]) +
           d[0][2] * (d[1][0] * d[2][1] - d[1][1] * d[2][0]);
  };
  std::array<double, 3> out{};
  for (std::size_t column = 0; column < 3; ++column) {
    auto replaced = m;
    for (std::size_t row = 0; row < 3; ++row) replaced[row][column] = right[row];
    out[column] = determinant(replaced) / determinant(m);
  }
  return out;
}

inline Affine least_squares(const Corners& a, const std::vector<Point>& b) {
  std::array<std::array<double, 3>, 3> normal{};
  std::array<double, 3> right_x{};
  std::array<double, 3> right_y{};
  for (std::size_t k = 0; k < a.size(); ++k) {
    const std::array<double, 3> row{a[k].at.x, a[k].at.y, 1.0};
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) normal[i][j] += row[i] * row[j];
      right_x[i] += row[i] * b[k].x;
      right_y[i] += row[i] * b[k].y;
    }
  }
  const auto x = solve(normal, right_x);
  const auto y = solve(normal, right_y);
  return {x[0], x[1], y[0], y[1], {x[2], y[2]}};
}

inline double excess(double x, double y) { return std::abs(std::max(x, y) / std::min(x, y) - 1.0); }

inline double error_of(const AffineVertexSimilarity::Options& options, const Affine& map,
                       const Corners& a, const std::vector<Point>& b, double perimeter_m) {
  const Point u = map.linear({1, 0});
  const Point v = map.linear({0, 1});
  const double angle = std::acos(dot(u, v) / (length(u) * length(v)));
  const double distortion = options.scale_weight * excess(length(u + v), std::numbers::sqrt2) +
                            options.aspect_weight * excess(length(u), length(v)) +
                            options.shear_weight * excess(angle, std::numbers::pi / 2);
  double mismatch = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) mismatch += distance(map(a[k].at), b[k]);
  if (options.perimeter == similarity::PerimeterUnit::kRelative) mismatch /= perimeter_m;
  return (1.0 - options.alpha) * distortion + options.alpha * mismatch;
}

inline bool is_rejected(EdgeLabel p, EdgeLabel q) {
  return p != EdgeLabel::kUnknown && q != EdgeLabel::kUnknown && p != q;
}

inline double least_error(const AffineVertexSimilarity::Options& options, const Corners& a,
                          const Corners& b, double tile_m2, double perimeter_m) {
  double best = std::numeric_limits<double>::infinity();
  if (a.size() > b.size()) {
    for (std::size_t i = 0; i < a.size(); ++i) {
      Corners fewer = a;
      fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(i));
      const double change = std::abs(signed_area_m2(ring_of(a)) - signed_area_m2(ring_of(fewer)));
      if (change > options.area_loss_01 * tile_m2) continue;
      best = std::min(best, least_error(options, fewer, b, tile_m2, perimeter_m));
    }
    return best;
  }
  for (std::size_t offset = 0; offset < b.size(); ++offset) {
    std::vector<Point> laid_on;
    bool is_matched = true;
    for (std::size_t k = 0; k < b.size(); ++k) {
      const LabelledCorner& other = b[(k + offset) % b.size()];
      laid_on.push_back(other.at);
      is_matched = is_matched && !is_rejected(a[k].type, other.type);
    }
    if (options.labels == similarity::LabelRule::kMatched && !is_matched) continue;
    const Affine map = least_squares(a, laid_on);
    if (!map.is_finite() || !(map.determinant() > 1e-6)) continue;
    best = std::min(best, error_of(options, map, a, laid_on, perimeter_m));
  }
  return best;
}

}  // namespace plain

/// Of shapes without vertices on straight edges.
inline PlainVertexMapping plain_vertex_mapping(
    const similarity::AffineVertexSimilarity::Options& options, const similarity::LabelledShape& a,
    const similarity::LabelledShape& b) {
  plain::Corners from = plain::corners_of(a);
  plain::Corners to = plain::corners_of(b);
  if (from.size() < to.size()) std::swap(from, to);
  return {plain::least_error(options, from, to, signed_area_m2(plain::ring_of(from)),
                             perimeter_m(plain::ring_of(to)))};
}

}  // namespace plat::testing
