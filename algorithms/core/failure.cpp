#include "core/failure.h"

namespace plat {

std::string_view failure_name(FailureCode code) {
  switch (code) {
    case FailureCode::kEmptyGeometry:
      return "empty_geometry";
    case FailureCode::kNotSimple:
      return "not_simple";
    case FailureCode::kBadHole:
      return "bad_hole";
    case FailureCode::kTooManyVertices:
      return "too_many_vertices";
    case FailureCode::kNotFinite:
      return "not_finite";
    case FailureCode::kTooSmall:
      return "too_small";
    case FailureCode::kNoSkeleton:
      return "no_skeleton";
    case FailureCode::kTimeLimit:
      return "time_limit";
    case FailureCode::kNotCovered:
      return "not_covered";
    case FailureCode::kNoConvergence:
      return "no_convergence";
    case FailureCode::kNoObservation:
      return "no_observation";
    case FailureCode::kNoStreet:
      return "no_street";
    case FailureCode::kUnknownEntity:
      return "unknown_entity";
    case FailureCode::kOutOfRange:
      return "out_of_range";
    case FailureCode::kStreetCollapsed:
      return "street_collapsed";
    case FailureCode::kStreetsCross:
      return "streets_cross";
    case FailureCode::kFaceInverted:
      return "face_inverted";
    case FailureCode::kTooManyStates:
      return "too_many_states";
    case FailureCode::kTilesOverlap:
      return "tiles_overlap";
    case FailureCode::kNoPlace:
      return "no_place";
  }
  return "unknown";
}

}  // namespace plat
