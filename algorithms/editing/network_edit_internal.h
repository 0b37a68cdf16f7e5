#pragma once

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/failure.h"
#include "editing/change.h"
#include "editing/edit.h"

namespace plat::editing::detail {

/// What a change of the network means for blocks.
struct NetworkOutcome {
  std::vector<WalkId> faces;  ///< that are there and may have other blocks now, by lowest half-edge
  std::vector<BlockId> orphans;  ///< blocks of faces that are gone, sorted
  /// Streets that were split off others: new street to the one it was part of.
  std::map<StreetId, StreetId> split_from;
};

/// One change of the street graph: first any number of steps, then settle(), which checks the
/// result and brings walks and nesting up to date.
class NetworkEdit {
 public:
  explicit NetworkEdit(Change& change) : change_(change) {}

  using Transform = std::function<Point(Point)>;
  void move_nodes(std::span<const NodeId> nodes, const Transform& transform);
  void bend(StreetId street, const std::optional<Curve>& curve);
  void resize(StreetId street, double width_m,
              streets::WidthSource source = streets::WidthSource::kAttribute);
  void remove(StreetId street);
  Expected<void> add(const AddStreet& edit);
  /// Joins `node`, where it comes nearer than `snap_m` to another node or street, to that one;
  /// returns whether it did.
  bool join_near(NodeId node, Point to, double snap_m);
  /// Takes a node or street as it is (for a city that is being made).
  void insert(NodeId id, Point position);
  void insert(StreetId id, CityStreet street);

  enum class Check { kAll, kNone };
  /// @param check  kNone: the streets are known to be noded
  Expected<NetworkOutcome> settle(Check check = Check::kAll);

 private:
  [[nodiscard]] const City& city() const { return change_.city(); }
  [[nodiscard]] Point place(NodeId node) const { return city().nodes().at(node).position; }
  [[nodiscard]] CityStreet with_line(CityStreet street) const;

  /// The walks around a node are about to change.
  void touch(NodeId node);
  void touch(StreetId street);
  NodeId node_at(Point p, double snap_m);
  NodeId split(StreetId street, Point p);
  void attach(NodeId node, HalfEdge h);
  void detach(NodeId node, HalfEdge h);
  /// The nodes through which a street from `a` to `b` runs, both included.
  std::vector<NodeId> route(NodeId a, NodeId b, double snap_m);

  Expected<void> check_lines() const;
  Expected<void> sort_around();
  Expected<void> update_walks();
  void retrace();
  void measure(Walk& walk) const;
  [[nodiscard]] std::vector<HalfEdge> walk_from(HalfEdge start) const;
  Expected<void> update_nesting();
  [[nodiscard]] std::optional<WalkId> container_of(const Walk& component) const;

  Change& change_;
  std::set<NodeId> nodes_;      // whose streets leave in other directions, or are others
  std::set<StreetId> moved_;    // with another line
  std::set<StreetId> resized_;  // with another width
  std::set<WalkId> walks_;      // touched, as they were before and are after
  std::set<WalkId> nested_;     // faces that hold other islands than before
  std::set<WalkId> islands_;    // components whose place must be looked at again
  std::set<StreetId> new_;      // without walks yet
  std::set<BlockId> orphans_;
  bool is_rewired_ = false;
  std::map<StreetId, StreetId> split_from_;
};

/// Where two streets may not be as they are: they meet in common nodes only, and no point of one
/// comes so near to the other that noding would join them. nullopt where they may.
std::optional<Point> find_meeting(const City& city, StreetId a, StreetId b);
/// The same of one street with itself.
std::optional<Point> find_meeting(const CityStreet& street);

/// Points nearer than this to a street are on it: a grid step, twice the reach of noding.
inline constexpr double kClearance_m = 1.0 / 1024.0;
/// A shorter street has collapsed, metres: its ends are one place. Real networks have streets of a
/// few grid steps.
inline constexpr double kMinStreet_m = 1.0 / 1024.0;

/// The points of a walk, in order.
Ring ring_of(const City& city, const Walk& walk);
/// The lowest point of a component, x first.
Point leftmost_point(const City& city, const Walk& walk);

}  // namespace plat::editing::detail
