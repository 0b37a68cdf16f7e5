#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/failure.h"
#include "core/point.h"
#include "streets/street_grower.h"

namespace plat::streets {

/// The plane in which streets grow: it holds every segment that is there and says which others may
/// still be added. All growers ask it, so that all grow planar networks.
///
/// Vertices are numbered: the existing network's nodes first, then one per distinct place of the
/// site's points, in the order of their first point. Points at one place share a vertex.
///
/// Guarantees: 1. decisions are exact on the working grid;  2. a segment is admitted where it has a
/// length, is not there already, crosses or touches no other segment but in a common end, passes
/// through no vertex, and stays inside the boundary and out of the obstacles.
/// Complexity: a decision costs what lies in the cells that the segment meets.
class GrowthPlane {
 public:
  /// @returns Failure for a site that cannot be used (street_grower.h)
  static Expected<GrowthPlane> over(const GrowthSite& site);

  GrowthPlane(GrowthPlane&&) noexcept;
  GrowthPlane& operator=(GrowthPlane&&) noexcept;
  ~GrowthPlane();

  [[nodiscard]] std::span<const Point> vertices() const;
  [[nodiscard]] std::uint32_t vertex_of_point(std::uint32_t point) const;
  /// An existing node is the vertex of the same number.

  [[nodiscard]] bool admits(std::uint32_t from, std::uint32_t to) const;
  /// The same for a curve between two vertices: no part of it crosses or touches what is there, nor
  /// itself, nor leaves the boundary; the straight segment from end to end is not looked at.
  [[nodiscard]] bool admits_line(std::span<const Point> line) const;
  /// Where the way straight from a vertex to another is first barred by a street, for growers that
  /// end there: nullopt where nothing bars it.
  [[nodiscard]] std::optional<Point> first_crossing(std::uint32_t from, std::uint32_t to) const;

  /// Pre: admitted, or the caller nodes the result (assemble_growth).
  void add(std::uint32_t from, std::uint32_t to);

 private:
  struct State;
  explicit GrowthPlane(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

/// A segment that a grower decided on.
struct GrownEdge {
  std::uint32_t from = 0;  ///< vertex of the plane
  std::uint32_t to = 0;
  GrownSegment segment;
  double tortuosity = 1.0;
  double width_m = 0.0;
  Polyline line;  ///< from vertex to vertex; empty: straight
};

/// The network of the existing streets and `edges`. Crossing edges (a grower that allows them) are
/// noded, parts that coincide are kept once.
Growth assemble_growth(const GrowthSite& site, const GrowthPlane& plane,
                       std::span<const GrownEdge> edges);

}  // namespace plat::streets
