#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "core/point.h"
#include "core/polygon.h"

namespace plat::parcels {

/// An inner step of a subdivision, as figures and people who debug want to see it.
enum class TraceStep : std::uint8_t {
  kSkeletonFace,  ///< area: face of the straight skeleton; number = its alpha-strip
  kSkeletonArc,   ///< line: arc of the straight skeleton; number 1 between two alpha-strips, else 0
  kOffset,        ///< line: edge of the offset contour C'(B); number 0
  kWall,          ///< line: boundary between two beta-strips; number 0
  kStrip,         ///< area: beta-strip (or patio); number = its place along the contour
  kSlice,         ///< line: piece of a cut between two lots of a strip; number 0
  kLotBox,        ///< area: oriented box of a lot that is split; number = depth of the recursion
  kSplit          ///< line: split of a lot; number = depth of the recursion, from 0
};
inline constexpr std::size_t kTraceSteps = 8;

/// What a layer or a column calls the step.
std::string_view trace_step_name(TraceStep step);

/// Whether the step hands over areas rather than lines.
bool is_area(TraceStep step);

/// Listens to the inner steps of a subdivider. Steps come in the order in which they are made, the
/// same for the same block and stream.
template <class V>
concept SubdivisionVisitor = requires(V& visitor, TraceStep step, std::uint32_t number,
                                      const Segment& line, const Ring& area) {
  visitor.line(step, number, line);
  visitor.area(step, number, area);
};

/// The default: nobody listens.
struct NoTrace {
  static void line(TraceStep /*step*/, std::uint32_t /*number*/, const Segment& /*line*/) {}
  static void area(TraceStep /*step*/, std::uint32_t /*number*/, const Ring& /*area*/) {}
};
static_assert(SubdivisionVisitor<NoTrace>);

/// Keeps every step of one block.
class SubdivisionTrace {
 public:
  struct Line {
    TraceStep step = TraceStep::kSplit;
    std::uint32_t number = 0;
    Segment line;
  };
  struct Area {
    TraceStep step = TraceStep::kLotBox;
    std::uint32_t number = 0;
    Ring area;
  };

  void line(TraceStep step, std::uint32_t number, const Segment& line) {
    lines_.push_back({step, number, line});
  }
  void area(TraceStep step, std::uint32_t number, const Ring& area) {
    areas_.push_back({step, number, area});
  }
  [[nodiscard]] const std::vector<Line>& lines() const { return lines_; }
  [[nodiscard]] const std::vector<Area>& areas() const { return areas_; }

 private:
  std::vector<Line> lines_;
  std::vector<Area> areas_;
};
static_assert(SubdivisionVisitor<SubdivisionTrace>);

}  // namespace plat::parcels
