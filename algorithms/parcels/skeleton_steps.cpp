#include "parcels/skeleton_steps.h"

#include "parcels/partition.h"

namespace plat::parcels {
namespace {

/// Cells below this are leftovers of rounding, not strips.
constexpr double kSliver_m2 = 0.5;

void show_skeleton(const StripLayout& layout, SubdivisionTrace& trace) {
  const StraightSkeleton& skeleton = layout.skeleton;
  for (std::size_t edge = 0; edge < skeleton.faces.size(); ++edge)
    trace.area(TraceStep::kSkeletonFace, layout.strip_of_edge[edge], skeleton.faces[edge]);
  for (const StraightSkeleton::Arc& arc : skeleton.arcs) {
    const bool is_between =
        layout.strip_of_edge[arc.faces[0]] != layout.strip_of_edge[arc.faces[1]];
    trace.line(TraceStep::kSkeletonArc, is_between ? 1 : 0,
               {skeleton.nodes[arc.lower].position, skeleton.nodes[arc.upper].position});
  }
}

/// The strips as areas: what the walls part.
void show_strips(const blocks::Block& block, const StripLayout& layout, SubdivisionTrace& trace) {
  auto partition = BlockPartition::cut(block, layout.walls);
  if (!partition) return;
  partition->join_slivers(kSliver_m2);
  std::uint32_t number = 0;
  for (const std::uint32_t region : partition->regions())
    trace.area(TraceStep::kStrip, number++, partition->polygon(region).outer);
}

}  // namespace

void show_steps(const blocks::Block& block, const StripLayout& layout,
                std::span<const Segment> slices, SubdivisionTrace& trace) {
  show_skeleton(layout, trace);
  for (const Segment& edge : layout.rim) trace.line(TraceStep::kOffset, 0, edge);
  for (const Segment& wall : layout.walls) trace.line(TraceStep::kWall, 0, wall);
  show_strips(block, layout, trace);
  for (const Segment& slice : slices) trace.line(TraceStep::kSlice, 0, slice);
}

}  // namespace plat::parcels
