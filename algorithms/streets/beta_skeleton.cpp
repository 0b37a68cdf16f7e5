#include "streets/beta_skeleton.h"

#include <algorithm>

#include "core/box.h"
#include "core/failure.h"
#include "core/working_grid.h"
#include "streets/place_tree.h"

namespace plat::streets {
namespace {

/// A box that holds the lune, a grid step larger: far more than rounding takes from it.
Box box_of_lune(Point p, Point q, double beta) {
  const double radius = 0.5 * beta * distance(p, q);
  const auto box_around = [&](Point center) { return Box{center, center}.expanded(radius); };
  const Box first = box_around(lerp(p, q, 0.5 * beta));
  const Box second = box_around(lerp(q, p, 0.5 * beta));
  const Box both{{std::max(first.min.x, second.min.x), std::max(first.min.y, second.min.y)},
                 {std::min(first.max.x, second.max.x), std::min(first.max.y, second.max.y)}};
  return both.expanded(kGridStep_m);
}

}  // namespace

bool is_in_lune(Point p, Point q, Point r, double beta) {
  // |r - c| < beta d / 2 for c = p + beta / 2 (q - p), multiplied out: no root, no division.
  const double from_p = squared_length(r - p);
  const double from_q = squared_length(r - q);
  const double along_p = dot(r - p, q - p);
  const double along_q = dot(r - q, p - q);
  if (beta == 1.0) return from_p <= along_p;
  return from_p < beta * along_p && from_q < beta * along_q;
}

std::vector<DelaunayEdge> beta_skeleton(std::span<const Point> places, double beta) {
  expects(beta >= 1.0, "lunes are those of beta >= 1");
  // An edge whose lune is empty has an empty diametral disc, so that it is Delaunay's.
  std::vector<DelaunayEdge> edges = delaunay_edges(places);
  const PlaceTree tree(places);
  std::erase_if(edges, [&](const DelaunayEdge& edge) {
    const Point p = places[edge.a];
    const Point q = places[edge.b];
    const Box lune = box_of_lune(p, q, beta);
    return tree.any([&](const Box& box) { return box.intersects(lune); },
                    [&](std::uint32_t i) {
                      return i != edge.a && i != edge.b && is_in_lune(p, q, places[i], beta);
                    });
  });
  return edges;
}

}  // namespace plat::streets
