#include "parcels/lot_packing.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/working_grid.h"

namespace plat::parcels {
namespace {

/// A lot that does not fit is tried again this share of its width further along the front.
constexpr double kStepShare = 1.0 / 16.0;
/// Widths are kept within this factor of their mean.
constexpr double kMinWidthShare = 0.25;
constexpr double kMaxWidthShare = 4.0;
/// How far a cut goes on beyond the line it ends on, so that rounding cannot make it stop short.
constexpr double kProlongation_m = 8.0 * kGridStep_m;

/// The frame of a lot: x along its front, y into the block.
struct Frame {
  explicit Frame(const Segment& front)
      : origin(front.a), along(normalized(front.b - front.a)), inward(perpendicular(along)) {}

  [[nodiscard]] Point to_local(Point p) const {
    return {dot(p - origin, along), dot(p - origin, inward)};
  }
  [[nodiscard]] Point to_world(Point p) const { return origin + p.x * along + p.y * inward; }

  Point origin;
  Point along;
  Point inward;
};

std::vector<Point> corners(const PackedLot& lot) {
  const Frame frame(lot.front);
  const Point depth = lot.depth_m * frame.inward;
  return {lot.front.a, lot.front.b, lot.front.b + depth, lot.front.a + depth};
}

std::vector<Segment> contour_edges(const blocks::Block& block) {
  std::vector<Segment> out;
  for_each_edge(block.contour, [&](const Segment& s) { out.push_back(s); });
  return out;
}

/// Whether a side of `a` separates the two, but for the slack.
bool is_separated_by(const PackedLot& a, const PackedLot& b) {
  const Frame frame(a.front);
  Box box;
  for (const Point p : corners(b)) box.add(frame.to_local(p));
  return box.max.x <= kPackingSlack_m || box.min.x >= length(a.front) - kPackingSlack_m ||
         box.max.y <= kPackingSlack_m || box.min.y >= a.depth_m - kPackingSlack_m;
}

bool overlap(const PackedLot& a, const PackedLot& b) {
  return !is_separated_by(a, b) && !is_separated_by(b, a);
}

class Packing {
 public:
  Packing(const blocks::Block& block, const PackingSize& size)
      : block_(block), size_(size), obstacles_(contour_edges(block)) {}

  [[nodiscard]] std::vector<PackedLot> take_lots() { return std::move(lots_); }

  void pack(const Front& front, Rng& rng) {
    const double end = length_m(front);
    for (double at = 0.0;;) {
      const double width = size_.width_m * std::clamp(rng.normal(1.0, size_.width_deviation),
                                                      kMinWidthShare, kMaxWidthShare);
      while (at + width <= end + kPackingSlack_m && !place(front, at, std::min(at + width, end)))
        at += kStepShare * width;
      at += width;
      if (at >= end) return;
    }
  }

 private:
  bool place(const Front& front, double from_m, double to_m) {
    PackedLot lot{{place_at(front, from_m).point, place_at(front, to_m).point}, 0.0};
    lot.depth_m = std::min(size_.depth_m, free_depth(lot.front));
    if (lot.depth_m < size_.depth_min_m) return false;
    if (locate(block_.contour, snap(centre(lot))) != Side::kInside) return false;
    if (std::any_of(lots_.begin(), lots_.end(),
                    [&](const PackedLot& other) { return overlap(lot, other); }))
      return false;
    const std::vector<Point> c = corners(lot);
    for (std::size_t i = 0; i < c.size(); ++i) obstacles_.push_back({c[i], c[(i + 1) % c.size()]});
    lots_.push_back(lot);
    return true;
  }

  /// How deep the land behind the front is over its whole width, at most the depth of a lot.
  [[nodiscard]] double free_depth(const Segment& front) const {
    const Frame frame(front);
    const double low = kPackingSlack_m;
    const double high = length(front) - kPackingSlack_m;
    if (high <= low) return 0.0;
    double free = size_.depth_m;
    for (const Segment& obstacle : obstacles_) {
      Point p = frame.to_local(obstacle.a);
      Point q = frame.to_local(obstacle.b);
      if (p.x > q.x) std::swap(p, q);
      if (q.x <= low || p.x >= high || std::max(p.y, q.y) <= kPackingSlack_m) continue;
      const double run = q.x - p.x;
      const auto height_at = [&](double x) {
        return run > 0.0 ? p.y + (q.y - p.y) * std::clamp((x - p.x) / run, 0.0, 1.0) : p.y;
      };
      const double left = run > 0.0 ? height_at(low) : p.y;
      const double right = run > 0.0 ? height_at(high) : q.y;
      if (std::max(left, right) <= kPackingSlack_m) continue;
      free = std::min(free, std::max(0.0, std::min(left, right)));
    }
    return free;
  }

  const blocks::Block& block_;
  const PackingSize& size_;
  std::vector<Segment> obstacles_;
  std::vector<PackedLot> lots_;
};

/// How far a ray from the rear of a lot goes until it meets another lot or the contour.
class Prolongation {
 public:
  Prolongation(const std::vector<Segment>& contour, const std::vector<PackedLot>& lots)
      : contour_(contour), lots_(lots) {}

  [[nodiscard]] double reach(std::size_t own, Point from, Point direction) const {
    double nearest = to_contour(from, direction);
    for (std::size_t i = 0; i < lots_.size(); ++i) {
      if (i != own) nearest = std::min(nearest, to_lot(lots_[i], from, direction));
    }
    return nearest;
  }

 private:
  static constexpr double kNone = std::numeric_limits<double>::infinity();

  [[nodiscard]] double to_contour(Point from, Point direction) const {
    double nearest = kNone;
    for (const Segment& edge : contour_) {
      const double a = cross(direction, edge.a - from);
      const double b = cross(direction, edge.b - from);
      if ((a >= 0.0) == (b >= 0.0)) continue;
      const double t = dot(lerp(edge.a, edge.b, a / (a - b)) - from, direction);
      if (t > -kPackingSlack_m) nearest = std::min(nearest, std::max(t, 0.0));
    }
    return nearest == kNone ? 0.0 : nearest;
  }

  /// Along the lot's side counts as meeting it: the side is a cut already.
  [[nodiscard]] static double to_lot(const PackedLot& lot, Point from, Point direction) {
    const Frame frame(lot.front);
    const Point start = frame.to_local(from);
    const Point step{dot(direction, frame.along), dot(direction, frame.inward)};
    double enter = 0.0;
    double leave = kNone;
    const auto clip = [&](double at, double rate, double low, double high) {
      if (std::abs(rate) * (high - low) < kGridStep_m) {
        if (at < low || at > high) leave = -kNone;
        return;
      }
      enter = std::max(enter, std::min((low - at) / rate, (high - at) / rate));
      leave = std::min(leave, std::max((low - at) / rate, (high - at) / rate));
    };
    clip(start.x, step.x, -kPackingSlack_m, length(lot.front) + kPackingSlack_m);
    clip(start.y, step.y, 0.0, lot.depth_m);
    return leave > enter && leave > kPackingSlack_m ? enter : kNone;
  }

  const std::vector<Segment>& contour_;
  const std::vector<PackedLot>& lots_;
};

}  // namespace

Point centre(const PackedLot& lot) {
  const Frame frame(lot.front);
  return frame.to_world({0.5 * length(lot.front), 0.5 * lot.depth_m});
}

std::vector<PackedLot> pack_lots(const blocks::Block& block, const PackingSize& size, Rng& rng) {
  std::vector<Front> fronts = fronts_of(block);
  std::stable_sort(fronts.begin(), fronts.end(),
                   [](const Front& a, const Front& b) { return length_m(a) > length_m(b); });
  Packing packing(block, size);
  for (const Front& front : fronts) packing.pack(front, rng);
  return packing.take_lots();
}

std::vector<Segment> packing_cuts(const blocks::Block& block, const std::vector<PackedLot>& lots) {
  const std::vector<Segment> contour = contour_edges(block);
  const Prolongation prolongation(contour, lots);
  std::vector<Segment> cuts;
  for (std::size_t i = 0; i < lots.size(); ++i) {
    const Frame frame(lots[i].front);
    const double width = length(lots[i].front);
    const double depth = lots[i].depth_m;
    cuts.push_back({frame.to_world({-kProlongation_m, depth}),
                    frame.to_world({width + kProlongation_m, depth})});
    for (const double x : {0.0, width}) {
      const double reach = prolongation.reach(i, frame.to_world({x, depth}), frame.inward);
      cuts.push_back({frame.to_world({x, -kProlongation_m}),
                      frame.to_world({x, depth + reach + kProlongation_m})});
    }
  }
  return cuts;
}

}  // namespace plat::parcels
