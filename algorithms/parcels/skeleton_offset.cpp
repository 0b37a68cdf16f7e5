#include "parcels/skeleton_offset.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace plat::parcels {
namespace {

/// The nodes at or above the cut in groups connected by arcs: one group per patio.
class UpperParts {
 public:
  UpperParts(const StraightSkeleton& skeleton, double offset_m)
      : parent_(skeleton.nodes.size()), height_m_(skeleton.nodes.size()) {
    std::iota(parent_.begin(), parent_.end(), 0U);
    for (std::uint32_t n = 0; n < parent_.size(); ++n) height_m_[n] = skeleton.nodes[n].time_m;
    for (const auto& arc : skeleton.arcs) {
      if (skeleton.nodes[arc.lower].time_m >= offset_m) unite(arc.lower, arc.upper);
    }
  }

  /// The height of the roof over the patio that the node belongs to.
  double top_m(std::uint32_t node) { return height_m_[find(node)]; }

 private:
  std::uint32_t find(std::uint32_t n) {
    while (parent_[n] != n) n = parent_[n] = parent_[parent_[n]];
    return n;
  }
  void unite(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    parent_[b] = a;
    height_m_[a] = std::max(height_m_[a], height_m_[b]);
  }

  std::vector<std::uint32_t> parent_;
  std::vector<double> height_m_;
};

/// Joins the cut arcs of each face in pairs: a face is monotone along its edge, so that from one
/// end of the edge to the other the level set enters and leaves it in turn.
std::vector<OffsetEdge> close_rim(
    const StraightSkeleton& whole, const StraightSkeleton& lower,
    const std::vector<std::pair<std::uint32_t, std::uint32_t>>& cuts) {
  struct Crossing {
    std::uint32_t face = 0;
    double along_m = 0.0;
    std::uint32_t node = 0;
    auto operator<=>(const Crossing&) const = default;
  };
  std::vector<Crossing> crossings;
  for (const auto& [node, arc] : cuts) {
    for (const std::uint32_t face : lower.arcs[arc].faces) {
      const Ring& ring = whole.faces[face];
      const double along = dot(lower.nodes[node].position - ring[0], normalized(ring[1] - ring[0]));
      crossings.push_back({face, along, node});
    }
  }
  std::sort(crossings.begin(), crossings.end());
  std::vector<OffsetEdge> rim;
  for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
    rim.push_back({crossings[i].node, crossings[i + 1].node, crossings[i].face});
  }
  return rim;
}

}  // namespace

LowerPart cut_roof(const StraightSkeleton& skeleton, double offset_m, double min_width_m) {
  UpperParts parts(skeleton, offset_m);
  const auto is_above = [&](std::uint32_t node) {
    return skeleton.nodes[node].time_m >= offset_m &&
           2.0 * (parts.top_m(node) - offset_m) >= min_width_m;
  };
  LowerPart out;
  out.skeleton.nodes = skeleton.nodes;  // those above stay as numbers without arcs
  std::vector<std::pair<std::uint32_t, std::uint32_t>> cuts;  // (new node, arc)
  for (const auto& arc : skeleton.arcs) {
    if (is_above(arc.lower)) continue;
    auto kept = arc;
    if (is_above(arc.upper)) {
      const auto& low = skeleton.nodes[arc.lower];
      const auto& high = skeleton.nodes[arc.upper];
      const double t = (offset_m - low.time_m) / (high.time_m - low.time_m);
      kept.upper = static_cast<std::uint32_t>(out.skeleton.nodes.size());
      out.skeleton.nodes.push_back({lerp(low.position, high.position, t), offset_m});
      cuts.emplace_back(kept.upper, static_cast<std::uint32_t>(out.skeleton.arcs.size()));
    }
    out.skeleton.arcs.push_back(kept);
  }
  out.rim = close_rim(skeleton, out.skeleton, cuts);
  return out;
}

}  // namespace plat::parcels
