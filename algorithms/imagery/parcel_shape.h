#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "core/oriented_box.h"
#include "core/polygon.h"

namespace plat::imagery {

/// A set of sides of a parcel's oriented bounding box.
///
///              kAbove (long)            u = box.axis, to the right
///            +---------------+          v = perpendicular(u), up
///   kStart   |   ------> u   |  kEnd
///   (short)  +---------------+  (short)
///              kBelow (long)
using BoxSides = std::uint8_t;
inline constexpr BoxSides kNoSide = 0;
inline constexpr BoxSides kBelow = 1;
inline constexpr BoxSides kEnd = 2;
inline constexpr BoxSides kAbove = 4;
inline constexpr BoxSides kStart = 8;

/// A side of the box faces a street where at least this share of it does: a corner cut off, or the
/// end of a neighbour's front, is no second front.
inline constexpr double kFrontShare_01 = 0.25;

/// The four ways to lay a rectangle on a rectangle, long side on long side.
enum class Symmetry : std::uint8_t {
  kKept,            ///< as it is
  kTurned,          ///< by half a turn
  kMirroredAlong,   ///< start and end change places
  kMirroredAcross,  ///< below and above change places
};

[[nodiscard]] constexpr bool is_mirrored(Symmetry s) {
  return s == Symmetry::kMirroredAlong || s == Symmetry::kMirroredAcross;
}

/// Where the sides come to lie.
BoxSides moved_sides(BoxSides sides, Symmetry symmetry);

enum class Mirroring { kAllowed, kForbidden };

/// One number for all sets of sides that a permitted symmetry carries into each other: with mirrors
/// nine classes (no street; one long side; one short side; two long; two short; a corner; two long
/// and a short; two short and a long; all), without them a left and a right corner are two.
BoxSides front_class(BoxSides sides, Mirroring mirroring);

/// The symmetry that carries `source` to `target`, a turn before a mirror; nullopt where their
/// classes differ.
std::optional<Symmetry> symmetry_between(BoxSides source, BoxSides target, Mirroring mirroring);

/// A parcel as retrieval and warp see it.
struct ParcelShape {
  std::string id;    ///< in the layer it came from
  std::string zone;  ///< zone or land use; empty where the layer has none
  Polygon polygon;
  OrientedBox box;
  /// The sides of the box that face a street; nullopt where nothing is known of the streets.
  std::optional<BoxSides> street_sides;
};

/// The shape of a polygon with area. Street sides: every front goes to the side of the box whose
/// outward normal is nearest to its own; sides with at least kFrontShare_01 of their length count,
/// and the side with the longest front counts in any case.
/// @param fronts  parts of the boundary along streets, land on the left (parcels::street_fronts);
///                nullopt where nothing is known of them
ParcelShape shape_of(Polygon polygon, std::optional<std::span<const Segment>> fronts);

/// Coordinates along and across a box: (0, 0) at its lower start corner, then laid down by
/// `symmetry`, so that equal shares of length and width of two frames correspond.
class BoxFrame {
 public:
  explicit BoxFrame(const OrientedBox& box, Symmetry symmetry = Symmetry::kKept);

  [[nodiscard]] Point to_frame(Point world) const;
  [[nodiscard]] Point to_world(Point frame) const;
  [[nodiscard]] double length_m() const { return length_m_; }
  [[nodiscard]] double width_m() const { return width_m_; }

 private:
  Point origin_;
  Point along_;   // unit
  Point across_;  // unit
  double length_m_;
  double width_m_;
};

}  // namespace plat::imagery
