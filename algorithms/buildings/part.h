#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "buildings/cross_section.h"
#include "buildings/mesh.h"

/// Building parts [Har, Sec. 6.2]: a mesh, the ports at which it meets its neighbours, and what it
/// offers.
///
/// Frame of a part: metres, z up, the ground at z = 0; the part stands on the skeleton line, its
/// axis. Walking from the left port to the right one, the front is on the right. Angles in radians,
/// counter-clockwise positive.
///
///   middle            left port (0, 0), right port (length, 0), front towards -y
///   left end          key point (0, 0), right port (length, 0): it starts a row
///   right end         left port (-length, 0), key point (0, 0): it ends a row
///   corner            left port (-a, 0), key point (0, 0), right port b (cos angle, sin angle)
///   tee               left port (-a, 0), key point (0, 0), right port (b, 0), stem port (0, c) at
///   the back or
///                     (0, -c) at the front
///   floor             bottom port at z = 0, top port at z = height; floors are stacked
///
///            back                 back
///     left [======] right   left [==+==] right     the arms a and b are what the part uses of
///          front                  a | b            the length on either side of its key point
///                                 c |
///                                 stem (at the front)
namespace plat::buildings {

enum class PartClass { kLeftEnd, kRightEnd, kMiddle, kCorner, kTee, kFloor };
enum class StemSide { kBack, kFront };
enum class PortRole { kLeft, kRight, kStem, kBottom, kTop };

/// As the manifest spells them: "left_end", "back", "stem" ...
std::string_view name_of(PartClass part_class);
std::string_view name_of(StemSide side);
std::string_view name_of(PortRole role);

/// Where a part meets its neighbour.
///
/// The cross section has the coordinates (lateral, z), lateral positive to the left of who walks in
/// the walking direction: from left to right; outwards at a stem. Two parts in a row, both walked
/// forwards or both backwards, meet with their sections as they are. A row that is entered with its
/// front on the left meets the mirrored section. Floors: the plan, (x, y).
struct Port {
  PortRole role = PortRole::kLeft;
  Point3 position_m;  ///< on the axis
  Point3 outward;     ///< unit vector
  double arm_m =
      0.0;  ///< from the key point along the axis; a middle part: left 0, right its length
  CrossSection section;

  friend bool operator==(const Port&, const Port&) = default;
};

/// The plane of the port, in the coordinates of its section.
CutPlane cut_plane(const Port& port);

/// What the arms of a part are, and so where its ports lie.
struct PartShape {
  PartClass part_class = PartClass::kMiddle;
  double angle_rad = 0.0;                ///< corners: the turn at the key point, left positive
  StemSide stem_side = StemSide::kBack;  ///< tees
  double left_m = 0.0;                   ///< arm a; a right end: its length
  double right_m = 0.0;  ///< arm b; a left end, a middle part: its length; a floor: its height
  double stem_m = 0.0;   ///< arm c of tees

  friend bool operator==(const PartShape&, const PartShape&) = default;
};

/// The ports of a shape, sections empty, in the order of PortRole.
std::vector<Port> ports_of(const PartShape& shape);

struct Part {
  std::string name;
  PartShape shape;
  Mesh mesh;                ///< its cap faces name their port
  std::vector<Port> ports;  ///< in the order of PortRole, those that the class has
  /// What the part offers, per part: "length_m" (all arms together, but for floors), "height_m",
  /// "balconies", "doors", "windows", "solar_area_m2", "air_conditions", "floor_area_m2" ...
  std::map<std::string, double> attributes;

  friend bool operator==(const Part&, const Part&) = default;
};

/// The port of that role; nullopt where the class has none.
std::optional<std::size_t> find_port(const Part& part, PortRole role);

/// The attribute, 0 where the part has none of that name.
double attribute(const Part& part, const std::string& name);

/// Every length in a database is a multiple of this [Har, Sec. 6.2].
inline constexpr double kLengthQuantum_m = 0.2;
/// Floor areas are multiples of this [Har, Sec. 6.3].
inline constexpr double kFloorAreaQuantum_m2 = 1.0;

/// A part of a user's mesh: ports from the shape, caps tagged, sections extracted (of caps; a mesh
/// that is open there is sliced).
/// @throws InputError, naming the part: where a port has no section, or the mesh a defect
Part make_part(std::string name, const PartShape& shape, Mesh mesh,
               std::map<std::string, double> attributes);

/// An arm is a multiple of the quantum where it is within this many quanta of one: what the
/// rounding of decimals to doubles leaves.
inline constexpr double kQuantumTolerance = 1e-6;

/// Whether every arm is a multiple of `quantum_m`.
bool is_quantised(const Part& part, double quantum_m = kLengthQuantum_m);

/// How far a part was from the quantum, and what was done about it.
struct Quantised {
  Part part;
  double factor = 1.0;  ///< new length over old, all arms together
};

/// The part with arms that are multiples of `quantum_m`: middle parts, ends and floors are scaled
/// along their axis to the nearest multiple, at least one; of corners and tees the port planes are
/// moved outwards to the next one. Deviation: the thesis scales all parts; an arm of a corner
/// cannot be scaled without shearing the section of the other (ADR 0021).
Quantised quantised(const Part& part, double quantum_m = kLengthQuantum_m);

}  // namespace plat::buildings
