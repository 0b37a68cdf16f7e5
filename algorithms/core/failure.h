#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <tl/expected.hpp>

namespace plat {

/// Why a block, a street or a parcel could not be processed. A failure is data: it becomes a row
/// with its code. Codes are appended, never renumbered.
enum class FailureCode : int {
  kEmptyGeometry = 1,    ///< nothing is left on the working grid
  kNotSimple = 2,        ///< a ring crosses or touches itself
  kBadHole = 3,          ///< a hole touches or leaves the outer ring, or meets another hole
  kTooManyVertices = 4,  ///< more vertices than the stage accepts
  kNotFinite = 5,        ///< a coordinate is not a number, or out of the grid's extent
  kTooSmall = 6,         ///< below the smallest area or width that can be divided
  kNoSkeleton = 7,       ///< the straight skeleton could not be built, or failed its checks
  kTimeLimit = 8,        ///< stopped by the wall-clock guard
  kNotCovered = 9,       ///< the parcels do not cover the block
  kNoConvergence = 10,   ///< an iteration reached its bound
  kNoObservation = 11,   ///< no observed parcels to fit the options to
  kNoStreet = 12,        ///< no edge of the block faces a street
  // Of edits (editing/editor.h):
  kUnknownEntity = 20,    ///< no node, street, block or parcel has this id
  kOutOfRange = 21,       ///< a width, factor, angle or place that no city has
  kStreetCollapsed = 22,  ///< a street would have no length left
  kStreetsCross = 23,     ///< streets would cross or touch where they have no node
  kFaceInverted = 24,     ///< a face would be turned inside out, or a street jump over another
  // Of sequences (sequences/sequence_search.h):
  kTooManyStates = 30,  ///< the search would hold or expand more states than its limit
  // Of tiles (tiles/reconfiguration.h):
  kTilesOverlap = 40,  ///< tiles would overlap or be turned inside out
  kNoPlace = 41,       ///< no tiles lie where others are to be pasted
};

/// The code's name in tables and layers, e.g. "not_simple".
std::string_view failure_name(FailureCode code);

struct Failure {
  FailureCode code;
  std::string message;  ///< one line, with the numbers that a reader needs
};

template <class T>
using Expected = tl::expected<T, Failure>;

inline tl::unexpected<Failure> fail(FailureCode code, std::string message) {
  return tl::unexpected<Failure>(Failure{code, std::move(message)});
}

/// The input's fault: a bad file, key or value. The message names the file, the feature and the
/// remedy, on one line.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Our own fault: a broken precondition. Always checked.
class LogicError : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

/// Throws LogicError unless `condition` holds.
inline void expects(bool condition, const char* what) {
  if (!condition) throw LogicError(std::string("precondition violated: ") + what);
}

}  // namespace plat
