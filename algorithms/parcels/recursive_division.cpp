#include "parcels/recursive_division.h"

#include <fmt/format.h>

#include <algorithm>
#include <concepts>

#include "core/rng.h"
#include "core/working_grid.h"
#include "parcels/parcel.h"

namespace plat::parcels {
namespace {

/// Far beyond what halving a block takes; ends the recursion if a split makes no progress.
constexpr int kMaxDepth = 48;
/// Cells below this are leftovers of rounding, not lots.
constexpr double kSliver_m2 = 0.5;
/// How far a cut goes on beyond its ends: these lie on edges of lots, whose own ends were rounded
/// again and again, so that they may stop short of the cut or contour edge they were meant for.
constexpr double kProlongation_m = 8.0 * kGridStep_m;

Ring corners_of(const OrientedBox& box) {
  const Point along = 0.5 * box.length_m * box.axis;
  const Point across = 0.5 * box.width_m * perpendicular(box.axis);
  return {box.center - along - across, box.center + along - across, box.center + along + across,
          box.center - along + across};
}

template <SubdivisionVisitor Visitor>
class Recursion {
 public:
  Recursion(const SplitRule& rule, Visitor& visitor) : rule_(rule), visitor_(visitor) {}

  [[nodiscard]] bool is_exceeded() const { return lots_ > kMaxLotsPerBlock; }
  [[nodiscard]] const std::vector<Segment>& cuts() const { return cuts_; }

  void divide(const Lot& lot, std::uint64_t seed, int depth) {
    if (is_exceeded() || depth >= kMaxDepth) return;
    const std::optional<SplitResult> split = rule_(lot, seed);
    if (!split) return;
    expects(split->lots.size() >= 2, "a split makes at least two lots");
    if constexpr (!std::same_as<Visitor, NoTrace>) {  // the box costs as much as the split
      visitor_.area(TraceStep::kLotBox, static_cast<std::uint32_t>(depth),
                    corners_of(minimum_area_box(lot)));
    }
    for (const Segment& cut : split->cuts) {
      visitor_.line(TraceStep::kSplit, static_cast<std::uint32_t>(depth), cut);
      add_cut(cut);
    }
    lots_ += split->lots.size() - 1;
    std::uint64_t child = 0;
    for (const Lot& part : split->lots) divide(part, derive_seed(seed, {child++}), depth + 1);
  }

 private:
  /// The prolongations are segments of their own: the cut must go through its ends. What is left
  /// over of them separates nothing.
  void add_cut(const Segment& cut) {
    const Point beyond = kProlongation_m * normalized(cut.b - cut.a);
    cuts_.push_back(cut);
    cuts_.push_back({cut.a, cut.a - beyond});
    cuts_.push_back({cut.b, cut.b + beyond});
  }

  const SplitRule& rule_;
  Visitor& visitor_;
  std::vector<Segment> cuts_;
  std::size_t lots_ = 1;
};

}  // namespace

Expected<BlockPartition> divide_recursively(const blocks::Block& block, std::uint64_t seed,
                                            const SplitRule& rule, std::string_view remedy) {
  NoTrace nobody;
  return divide_recursively(block, seed, rule, remedy, nobody);
}

template <SubdivisionVisitor Visitor>
Expected<BlockPartition> divide_recursively(const blocks::Block& block, std::uint64_t seed,
                                            const SplitRule& rule, std::string_view remedy,
                                            Visitor& visitor) {
  Recursion recursion(rule, visitor);
  recursion.divide(lot_of(block), seed, 0);
  if (recursion.is_exceeded()) {
    return fail(FailureCode::kNoConvergence,
                fmt::format("more than {} lots: raise {}", kMaxLotsPerBlock, remedy));
  }
  auto partition = BlockPartition::cut(block, recursion.cuts());
  if (partition) partition->join_slivers(kSliver_m2);
  return partition;
}

template Expected<BlockPartition> divide_recursively(const blocks::Block&, std::uint64_t,
                                                     const SplitRule&, std::string_view,
                                                     SubdivisionTrace&);

bool has_street_access(const Lot& lot) { return frontage_m(lot) >= kStreetAccess_m; }

bool keeps_street_access(const Lot& lot, const SplitResult& split) {
  return !has_street_access(lot) ||
         std::all_of(split.lots.begin(), split.lots.end(), has_street_access);
}

}  // namespace plat::parcels
