#pragma once

#include <span>
#include <vector>

#include "core/point.h"
#include "streets/delaunay_edges.h"

namespace plat::streets {

/// Whether `r` lies in the lune of p and q: for beta > 1 strictly inside the two discs of radius
/// beta d / 2 that pass through p or q and are centred on the line pq; for beta = 1, where both are
/// the disc over pq, also on its rim. Exact on the working grid for beta = 1 and 2 and places
/// within 2^15 m; the last bit of beta times a product is rounded otherwise.
bool is_in_lune(Point p, Point q, Point r, double beta);

/// The lune-based beta-skeleton: the edges between places whose lune holds no other place, sorted.
/// beta = 1 gives the Gabriel graph, 2 the relative neighbourhood graph.
///
/// Guarantees: 1. it is what trying all pairs against all places finds;  2. edges cross nowhere;
/// 3. a larger beta gives a subset;  4. it connects all places for beta <= 2.
/// Pre: places on the working grid, all different; 1 <= beta.
/// Complexity: O(n log n) for places whose lunes are small; never more than O(n^2).
/// Paper:      [KR85, Sec. 2]; [GS69] for the closed disc of beta = 1, without which the diagonals
///             of a square are in the graph and cross
std::vector<DelaunayEdge> beta_skeleton(std::span<const Point> places, double beta);

}  // namespace plat::streets
