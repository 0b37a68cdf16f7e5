#include "parcels/subdivision_trace.h"

#include "core/failure.h"

namespace plat::parcels {

std::string_view trace_step_name(TraceStep step) {
  switch (step) {
    case TraceStep::kSkeletonFace:
      return "skeleton_faces";
    case TraceStep::kSkeletonArc:
      return "skeleton_arcs";
    case TraceStep::kOffset:
      return "offset_contour";
    case TraceStep::kWall:
      return "walls";
    case TraceStep::kStrip:
      return "beta_strips";
    case TraceStep::kSlice:
      return "slices";
    case TraceStep::kLotBox:
      return "lot_boxes";
    case TraceStep::kSplit:
      return "splits";
  }
  throw LogicError("unknown trace step");
}

bool is_area(TraceStep step) {
  return step == TraceStep::kSkeletonFace || step == TraceStep::kStrip ||
         step == TraceStep::kLotBox;
}

}  // namespace plat::parcels
