#pragma once

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "buildings/cell_solid.h"
#include "buildings/part.h"
#include "buildings/solids.h"

/// What the kits of rows (townhouse, palazzo) are built with. Lengths are metres; cell space is the
/// frame of a straight part, x along the axis and y to the back, before its roof is raised and its
/// axis is bent.
namespace plat::buildings::detail {

/// What a surface is made of; a style gives each a name and a colour.
enum Surface : std::uint32_t {
  kPlinth,
  kGroundWall,
  kWall,
  kTrim,
  kRoof,
  kGlass,
  kFrame,
  kDoor,
  kMetal,
  kPanel,
  kSurfaceCount
};

/// A section family: its parts have the same cross section at every port.
struct RowFamily {
  std::string name;
  double depth_m = 10.0;
  double plinth_m = 0.4;
  std::vector<double> storeys_m;  ///< heights, ground floor first
  double band_m = 0.2;            ///< height of the string courses between storeys
  double eave_m = 0.3;            ///< height of the eave or cornice
  double overhang_m = 0.4;        ///< of eave and roof over the wall
  double roof_slope = 0.0;        ///< rise over run; 0: a terrace with a parapet
  bool is_hipped = false;         ///< whether the roof slopes at free ends too
  double parapet_m = 0.0;
  double arcade_m = 0.0;  ///< depth of an open arcade along the front; 0: none

  [[nodiscard]] double half_depth_m() const { return 0.5 * depth_m; }
  [[nodiscard]] double half_width_m() const { return half_depth_m() + overhang_m; }
  [[nodiscard]] double floor_m(std::size_t storey) const;  ///< height of its floor
  [[nodiscard]] double eave_top_m() const { return floor_m(storeys_m.size()); }
  [[nodiscard]] double top_m() const;
};

/// A wall on which openings are laid out: `s` along it, `n` outwards from it.
struct Wall {
  bool is_across = false;               ///< its plane is x = const, not y = const
  double plane = 0.0;                   ///< the constant
  double sign = -1.0;                   ///< its outward direction along that axis
  double length_m = 0.0;                ///< s runs from 0 to this
  std::function<double(double)> along;  ///< s to the coordinate along the wall, in cell space
  bool is_front = false;
  double ground_recess_m = 0.0;  ///< how far the ground floor stands back, behind an arcade

  [[nodiscard]] Box3 box(double s0, double s1, double n0, double n1, double z0, double z1) const;
  [[nodiscard]] Point3 at(double s, double n, double z) const;
  [[nodiscard]] Point3 outward() const;
  /// To the right of who stands before the wall.
  [[nodiscard]] Point3 across() const;
};

enum class BayKind { kWindow, kDoor, kBalcony, kShop };

/// One axis of one storey of a wall.
struct Bay {
  BayKind kind = BayKind::kWindow;
  std::size_t storey = 0;
  double centre_m = 0.0;  ///< s
  double pitch_m = 0.0;   ///< to the next axis
  double base_n = 0.0;    ///< where the wall stands in this storey
  double floor_m = 0.0;
  double height_m = 0.0;
};

/// What a part is asked to have, besides its windows.
struct Features {
  int balconies = 0;
  bool has_door = false;
  bool has_shop = false;
  bool has_solar = false;
  int dormers = 0;
  int chimneys = 0;
  int air_conditions = 0;
  bool has_windows = true;
};

class RowPart;

struct RowStyle {
  std::array<Material, kSurfaceCount> materials;
  std::vector<RowFamily> families;
  double bay_pitch_m = 1.8;
  double bay_margin_m = 0.4;  ///< from the ends of a wall to the first bay
  std::function<void(RowPart&, const Wall&, const Bay&)> dress_bay;
  /// The roof over a straight stretch of the axis.
  std::function<void(RowPart&, double x0, double x1, const Features&)> dress_roof;
  /// Pilasters, columns and what else stands on a wall as a whole; `centres` of its bays.
  std::function<void(RowPart&, const Wall&, const std::vector<double>& centres)> dress_wall;
};

/// The roof over a body: its height over the eave.
struct RoofForm {
  double half_width_m = 0.0;
  double slope = 0.0;
  std::optional<double> left_hip = {};  ///< x where a hip begins
  std::optional<double> right_hip = {};
  double stem_sign = 0.0;  ///< a wing towards +y or -y; 0: none

  [[nodiscard]] double height_m(double x, double y) const;
};

/// A part under construction.
class RowPart {
 public:
  RowPart(const RowStyle& style, const RowFamily& family) : style_(style), family_(family) {}

  /// A body of `family` from x0 to x1; free ends get overhangs, and hips where the family has them.
  void add_body(const RowFamily& family, double x0, double x1, bool is_free_left,
                bool is_free_right);
  /// The body of a tee: the bar from -arm to arm, the wing to `sign` * arm.
  void add_tee_body(double arm_m, double sign);
  /// Lays out the bays of a wall and dresses them. Features are for front walls.
  void dress(const Wall& wall, const Features& features);
  void dress_roof(double x0, double x1, const Features& features);

  /// The turn of the axis at x = 0, and how far from it the mitre reaches.
  void bend(double angle_rad, double zone_m) {
    angle_rad_ = angle_rad;
    zone_m_ = zone_m;
  }

  [[nodiscard]] const RowFamily& family() const { return family_; }
  /// Height of the last body's roof, over the ground.
  [[nodiscard]] double roof_m(double x, double y) const;

  /// The solid of the last body, to be carved.
  CellSolid& solid() { return bodies_.back().solid; }
  /// Solids that are added as they are, in cell space.
  Mesh& details() { return details_; }
  void count(const std::string& what, double by = 1.0) { attributes_[what] += by; }

  /// The part in its frame.
  [[nodiscard]] Part finish(std::string name, const PartShape& shape) const;

 private:
  struct Body {
    CellSolid solid;
    double eave_top_m = 0.0;
    RoofForm roof;
  };
  void fill(CellSolid& solid, const RowFamily& family, bool is_wing, double from, double to,
            bool is_free_from, bool is_free_to) const;
  [[nodiscard]] Point3 bent(Point3 p) const;

  const RowStyle& style_;
  const RowFamily& family_;
  std::vector<Body> bodies_;
  Mesh details_;
  std::map<std::string, double> attributes_;
  double angle_rad_ = 0.0;
  double zone_m_ = 1.0;
};

/// The wall of a straight stretch from x0 to x1.
Wall straight_wall(const RowFamily& family, double x0, double x1, bool is_front);
/// The end wall at x; `sign` is its outward direction.
Wall end_wall(const RowFamily& family, double x, double sign);

}  // namespace plat::buildings::detail
