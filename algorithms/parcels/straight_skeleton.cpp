#include "parcels/straight_skeleton.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Straight_skeleton_2.h>
#include <CGAL/Straight_skeleton_builder_2.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <optional>
#include <stdexcept>

#include "core/validity.h"
#include "core/working_grid.h"

namespace plat::parcels {
namespace {

// EPICK: on the working grid it gave no null skeleton in 20,000 blocks; an exact kernel cost 7 to
// 19 times as much and still hung once on raw input (ADR 0002).
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Skeleton = CGAL::Straight_skeleton_2<Kernel>;
using Traits = CGAL::Straight_skeleton_builder_traits_2<Kernel>;

/// Ends a construction that costs too much, by an exception that CGAL's builder turns into a null
/// result.
class CostGuard {
 public:
  using Vertex = Skeleton::Vertex_const_handle;
  using Halfedge = Skeleton::Halfedge_const_handle;

  CostGuard(const SkeletonLimits& limits, bool& is_exceeded)
      : limits_(&limits), is_exceeded_(&is_exceeded) {}

  void on_contour_edge_entered(Halfedge const&) const {}
  void on_initialization_started(std::size_t) const {}
  void on_initial_events_collected(Vertex const&, bool, bool) const { count(); }
  void on_edge_event_created(Vertex const&, Vertex const&) const { count(); }
  void on_split_event_created(Vertex const&) const { count(); }
  void on_pseudo_split_event_created(Vertex const&, Vertex const&) const { count(); }
  void on_initialization_finished() const {}
  void on_propagation_started() const {}
  void on_anihiliation_event_processed(Vertex const&, Vertex const&) const { count(); }
  void on_edge_event_processed(Vertex const&, Vertex const&, Vertex const&) const { count(); }
  void on_split_event_processed(Vertex const&, Vertex const&, Vertex const&) const { count(); }
  void on_pseudo_split_event_processed(Vertex const&, Vertex const&, Vertex const&,
                                       Vertex const&) const {
    count();
  }
  void on_vertex_processed(Vertex const&) const { count(); }
  void on_propagation_finished() const {}
  void on_cleanup_started() const {}
  void on_cleanup_finished() const {}
  void on_algorithm_finished(bool) const {}
  void on_error(char const*) const {}

 private:
  void count() const {
    ++events_;
    const bool too_many = events_ > limits_->max_events;
    // Reading the clock costs as much as an event: every 64th is enough.
    const bool too_late =
        events_ % 64 == 0 && std::chrono::steady_clock::now() - started_ >
                                 std::chrono::duration<double>(limits_->max_seconds);
    if (too_many || too_late) {
      *is_exceeded_ = true;
      throw std::runtime_error("skeleton limit");
    }
  }

  const SkeletonLimits* limits_;
  bool* is_exceeded_;
  mutable std::size_t events_ = 0;
  std::chrono::steady_clock::time_point started_ = std::chrono::steady_clock::now();
};

using Builder = CGAL::Straight_skeleton_builder_2<Traits, Skeleton, CostGuard>;

/// CGAL's half-edge structure as plain arrays; nullopt if a face is missing or unusable.
class Converter {
 public:
  Converter(const Polygon& polygon, Point center) : center_(center) {
    for_each_edge(polygon, [&](const Segment& s) {
      contour_node_.emplace(s.a - center, static_cast<std::uint32_t>(out_.nodes.size()));
      out_.nodes.push_back({s.a, 0.0});
    });
    out_.faces.resize(out_.nodes.size());
  }

  std::optional<StraightSkeleton> run(const Skeleton& skeleton) {
    std::map<int, std::uint32_t> face_edge;
    for (auto face = skeleton.faces_begin(); face != skeleton.faces_end(); ++face) {
      auto h = face->halfedge();
      const auto start = h;
      while (h->is_bisector()) {
        h = h->next();
        if (h == start) return std::nullopt;
      }
      const std::optional<std::uint32_t> edge = node_of_contour_vertex(h->opposite()->vertex());
      if (!edge || !out_.faces[*edge].empty()) return std::nullopt;
      face_edge[face->id()] = *edge;
      Ring ring;
      for (auto g = h; ring.empty() || g != h; g = g->next()) {
        ring.push_back(position(g->opposite()->vertex()));
        if (ring.size() > 4 * out_.faces.size() + 8) return std::nullopt;
      }
      out_.faces[*edge] = std::move(ring);
    }
    if (std::any_of(out_.faces.begin(), out_.faces.end(),
                    [](const Ring& f) { return f.size() < 3; }))
      return std::nullopt;
    for (auto h = skeleton.halfedges_begin(); h != skeleton.halfedges_end(); ++h) {
      if (!h->is_bisector() || h->id() > h->opposite()->id()) continue;
      std::uint32_t a = node(h->opposite()->vertex());
      std::uint32_t b = node(h->vertex());
      if (out_.nodes[a].time_m > out_.nodes[b].time_m) std::swap(a, b);
      out_.arcs.push_back(
          {a, b, {face_edge.at(h->face()->id()), face_edge.at(h->opposite()->face()->id())}});
    }
    return std::move(out_);
  }

 private:
  using Vertex = Skeleton::Vertex_const_handle;

  [[nodiscard]] Point position(Vertex v) const {
    return center_ + Point{v->point().x(), v->point().y()};
  }

  [[nodiscard]] std::optional<std::uint32_t> node_of_contour_vertex(Vertex v) const {
    const auto it = contour_node_.find({v->point().x(), v->point().y()});
    return it == contour_node_.end() ? std::nullopt : std::optional(it->second);
  }

  std::uint32_t node(Vertex v) {
    if (v->is_contour()) {
      if (const auto known = node_of_contour_vertex(v)) return *known;
    }
    const auto [it, is_new] =
        inner_node_.emplace(v->id(), static_cast<std::uint32_t>(out_.nodes.size()));
    if (is_new) out_.nodes.push_back({position(v), v->time()});
    return it->second;
  }

  Point center_;
  StraightSkeleton out_;
  std::map<Point, std::uint32_t> contour_node_;
  std::map<int, std::uint32_t> inner_node_;
};

}  // namespace

Expected<StraightSkeleton> straight_skeleton(const Polygon& polygon, const SkeletonLimits& limits) {
  if (auto defect = find_defect(polygon)) return tl::unexpected<Failure>(*std::move(defect));
  std::size_t vertices = polygon.outer.size();
  for (const Ring& hole : polygon.holes) vertices += hole.size();
  if (vertices > limits.max_vertices) {
    return fail(FailureCode::kTooManyVertices,
                fmt::format("{} vertices, the skeleton takes at most {}: simplify first", vertices,
                            limits.max_vertices));
  }

  const Point center = snap(box_of(polygon).center());
  bool is_exceeded = false;
  const CostGuard guard(limits, is_exceeded);  // the builder keeps references to both
  const Traits traits;
  Builder builder(boost::optional<double>(), traits, guard);
  const auto enter = [&](const Ring& ring) {
    std::vector<Kernel::Point_2> points;
    for (const Point p : ring) points.emplace_back(p.x - center.x, p.y - center.y);
    builder.enter_contour(points.begin(), points.end());
  };
  enter(polygon.outer);
  for (const Ring& hole : polygon.holes) enter(hole);
  const auto skeleton = builder.construct_skeleton();
  if (is_exceeded)
    return fail(FailureCode::kTimeLimit,
                fmt::format("the skeleton of {} vertices took too many events", vertices));
  if (!skeleton)
    return fail(FailureCode::kNoSkeleton, fmt::format("no skeleton for {} vertices", vertices));

  std::optional<StraightSkeleton> out = Converter(polygon, center).run(*skeleton);
  if (!out) return fail(FailureCode::kNoSkeleton, "the skeleton lacks the face of a contour edge");
  double sum = 0.0;
  for (const Ring& face : out->faces) sum += signed_area_m2(face);
  const double area = area_m2(polygon);
  // Centred nodes are accurate to 1e-13 m; a wrong or missing face is off by square metres.
  if (!(std::abs(sum - area) <= 1e-6 * area)) {
    return fail(FailureCode::kNoSkeleton,
                fmt::format("skeleton faces sum to {:.3f} m2, the block has {:.3f} m2", sum, area));
  }
  return *std::move(out);
}

}  // namespace plat::parcels
