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

/// A crossing is made a node only where it is this far from other nodes and streets, metres: no
/// street shorter than this comes of it, and noding (core/planar_graph.h) moves nothing else.
inline constexpr double kCrossingClearance_m = 1.0;

/// The plane in which streets grow: it holds every segment that is there and says which others may
/// still be added. All growers ask it, so that all grow planar networks.
///
/// Vertices are numbered: the existing network's nodes first, then one per distinct place of the
/// site's points, in the order of their first point. Points at one place share a vertex, with a
/// node of the existing network too.
///
/// Guarantees: 1. decisions are exact on the working grid;  2. a segment is admitted where its ends
/// are not connected already, it crosses or touches no other segment but in a common end, passes
/// through no vertex, and stays inside the boundary and out of the obstacles; it may touch or run
/// along these;  3. noding (core/planar_graph.h) leaves what was added as it is: what comes within
/// three quarters of a grid step counts as touching.
/// Complexity: a decision costs what lies in the cells that the segment meets.
class GrowthPlane {
 public:
  /// Obstacles may be any rings, even-odd; those that vanish on the working grid bar nothing.
  /// @returns Failure for a site that cannot be used (street_grower.h)
  static Expected<GrowthPlane> over(const GrowthSite& site);

  GrowthPlane(GrowthPlane&&) noexcept;
  GrowthPlane& operator=(GrowthPlane&&) noexcept;
  ~GrowthPlane();

  [[nodiscard]] std::span<const Point> vertices() const;
  [[nodiscard]] std::uint32_t vertex_of_point(std::uint32_t point) const;
  /// The vertices of the existing network are its nodes, with the same numbers.
  [[nodiscard]] std::uint32_t existing_nodes() const;
  /// Whether the vertex lies inside the boundary and outside the obstacles, or on their edges.
  [[nodiscard]] bool is_usable(std::uint32_t vertex) const;

  [[nodiscard]] bool admits(std::uint32_t from, std::uint32_t to) const;
  /// The same for a curve between two vertices: no part of it crosses or touches what is there, nor
  /// itself, nor leaves the boundary; the straight segment from end to end is not looked at.
  [[nodiscard]] bool admits_line(std::span<const Point> line) const;
  /// Whether the straight way from a vertex to another comes nearer than `clearance_m` to one that
  /// it passes: a street of twice that width would run over it.
  [[nodiscard]] bool passes_over(std::uint32_t from, std::uint32_t to, double clearance_m) const;
  /// Pre: admitted.
  void add(std::uint32_t from, std::uint32_t to);

  /// Puts a curve in place of the straight segment that was added between its ends, if it is
  /// admitted there. @returns whether it was
  bool bend(std::uint32_t from, std::uint32_t to, std::span<const Point> line);

  /// For growers that allow crossings. Where the way straight from a vertex to another crosses
  /// grown segments, in order, on the grid: empty where it is admitted; nullopt where anything else
  /// bars it, or a crossing has not kCrossingClearance_m.
  [[nodiscard]] std::optional<std::vector<Point>> crossings(std::uint32_t from,
                                                            std::uint32_t to) const;
  /// Adds a segment that crosses others, which assemble_growth() then nodes. Pre: what crossings()
  /// said of it.
  void add_across(std::uint32_t from, std::uint32_t to, std::span<const Point> crossings);
  /// Adds a segment up to its first crossing. @returns the vertex there. Pre: as add_across(), at
  /// least one crossing.
  std::uint32_t add_up_to(std::uint32_t from, std::uint32_t to, std::span<const Point> crossings);
  /// Whether any segment was added across others.
  [[nodiscard]] bool has_crossings() const;

 private:
  struct State;
  explicit GrowthPlane(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

/// A segment that a grower decided on.
struct GrownEdge {
  std::uint32_t from = 0;  ///< vertex of the plane
  std::uint32_t to = 0;
  GrownSegment segment{};
  double width_m = 0.0;
  Polyline line{};  ///< from vertex to vertex, as bent in the plane; empty: straight
};

/// The network of the existing streets and `edges`, all of them added to the plane. An edge of no
/// known width (not above 0) gets the default of street_width.h, as WidthSource::kAssumed. Edges
/// that cross (has_crossings()) are noded; parts that then coincide are kept once.
Growth assemble_growth(const GrowthSite& site, const GrowthPlane& plane,
                       std::span<const GrownEdge> edges);

}  // namespace plat::streets
