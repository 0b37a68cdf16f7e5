#include <fmt/format.h>

#include <array>
#include <cmath>

#include "buildings/row_kit_internal.h"

/// Floors of skyscrapers [Har, Fig. 6.5]: squares with cut corners, in sizes that step back with
/// height.
namespace plat::buildings::detail {
namespace {

enum TowerSurface : std::uint32_t { kSlab, kCurtainWall, kMullion, kStone, kRoofMetal };

std::vector<Material> materials() {
  return {{"concrete", {206, 206, 202}},
          {"curtain_wall", {92, 136, 168}},
          {"mullion", {66, 72, 80}},
          {"podium_stone", {150, 134, 112}},
          {"roof_metal", {122, 132, 138}}};
}

/// Widths of the sections, from podium to lantern.
constexpr std::array<double, 6> kWidths_m{40.0, 34.0, 28.0, 22.0, 16.0, 10.0};
/// Of the width, cut off at each corner along both sides.
constexpr double kChamfer = 0.15;
constexpr double kSlab_m = 0.5;
/// How far the glass stands behind the edge of the slabs.
constexpr double kGlassInset_m = 0.3;
constexpr double kMullionPitch_m = 2.0;
/// Edge of what is left at the top of a spire.
constexpr double kTip_m = 0.4;
/// Sections may differ by as much: the steps between the smaller sizes, not those between the
/// larger, which need a setback part.
constexpr double kTransitionLimit_m2 = 220.0;

std::vector<Point3> octagon(double width_m, double z) {
  const double h = 0.5 * width_m;
  const double c = h - kChamfer * width_m;
  return {{-c, -h, z}, {c, -h, z}, {h, -c, z}, {h, c, z},
          {c, h, z},   {-c, h, z}, {-h, c, z}, {-h, -c, z}};
}

double octagon_area_m2(double width_m) {
  return width_m * width_m * (1.0 - 2.0 * kChamfer * kChamfer);
}

/// A floor part: rings from the ground up, and what is between them.
class FloorPart {
 public:
  explicit FloorPart(double width_m) { ring(width_m, 0.0); }

  void ring(double width_m, double z) { rings_.push_back(octagon(width_m, z)); }
  void band(double width_m, double z, std::uint32_t material) {
    ring(width_m, z);
    bands_.push_back(material);
  }

  /// Slab, glass, slab: from `z` to `z + height_m`, as wide as `width_m` at both ends.
  void storey(double width_m, double z, double height_m, std::uint32_t slab) {
    const double inside_m = width_m - 2.0 * kGlassInset_m;
    const double glass_z = z + kSlab_m;
    const double lintel_z = z + height_m - 0.5 * kSlab_m;
    band(width_m, glass_z, slab);
    band(inside_m, glass_z, slab);
    band(inside_m, lintel_z, kCurtainWall);
    band(width_m, lintel_z, slab);
    band(width_m, z + height_m, slab);
    mullions(inside_m, glass_z - 0.05, lintel_z + 0.05);
    area_m2_ += octagon_area_m2(width_m);
  }

  [[nodiscard]] Part finish(const std::string& name, double height_m,
                            std::map<std::string, double> attributes) const {
    Mesh mesh;
    mesh.materials = materials();
    add_loft(mesh, rings_, bands_, kSlab);
    append(mesh, details_);
    for (Point3& p : mesh.vertices) p = as_stored(p);
    attributes["floor_area_m2"] =
        std::round(area_m2_ / kFloorAreaQuantum_m2) * kFloorAreaQuantum_m2;
    return make_part(name, {.part_class = PartClass::kFloor, .right_m = height_m}, std::move(mesh),
                     std::move(attributes));
  }

 private:
  void mullions(double width_m, double z0, double z1) {
    details_.materials = materials();
    const double half = 0.5 * width_m;
    const double reach = half - kChamfer * width_m;
    const int count = static_cast<int>(2.0 * reach / kMullionPitch_m);
    for (int i = 0; i <= count; ++i) {
      const double s = -reach + 2.0 * reach * i / count;
      for (const double sign : {-1.0, 1.0}) {
        const double n = sign * half;
        add_box(details_, {{s - 0.06, n - 0.1, z0}, {s + 0.06, n + 0.1, z1}}, kMullion);
        add_box(details_, {{n - 0.1, s - 0.06, z0}, {n + 0.1, s + 0.06, z1}}, kMullion);
      }
    }
  }

  std::vector<std::vector<Point3>> rings_;
  std::vector<std::uint32_t> bands_;
  Mesh details_;
  double area_m2_ = 0.0;
};

Part make_shaft(std::size_t size, double storey_m, int storeys) {
  const double width_m = kWidths_m[size];
  FloorPart part(width_m);
  for (int i = 0; i < storeys; ++i) part.storey(width_m, i * storey_m, storey_m, kSlab);
  return part.finish(fmt::format("shaft_{:02.0f}_{}", width_m, storeys == 1 ? "floor" : "floors"),
                     storey_m * storeys, {{"storeys", storeys}});
}

/// A storey whose roof is a terrace around the next smaller size.
Part make_setback(std::size_t size) {
  const double height_m = 5.0;
  const double terrace_m = 4.0;
  FloorPart part(kWidths_m[size]);
  part.storey(kWidths_m[size], 0.0, terrace_m, kSlab);
  part.band(kWidths_m[size + 1], terrace_m, kRoofMetal);
  part.band(kWidths_m[size + 1], height_m, kSlab);
  return part.finish(fmt::format("setback_{:02.0f}_{:02.0f}", kWidths_m[size], kWidths_m[size + 1]),
                     height_m, {{"storeys", 1.0}});
}

Part make_podium() {
  const double height_m = 6.0;
  FloorPart part(kWidths_m[0]);
  part.storey(kWidths_m[0], 0.0, height_m, kStone);
  return part.finish("podium", height_m, {{"storeys", 1.0}, {"podiums", 1.0}});
}

/// From a section to the tip of a spire or pyramid.
Part make_spire(const std::string& name, std::size_t size, double height_m) {
  FloorPart part(kWidths_m[size]);
  part.band(kWidths_m[size], 1.0, kSlab);
  part.band(kWidths_m[size] - 1.6, 1.0, kRoofMetal);
  part.band(kTip_m, height_m, kRoofMetal);
  return part.finish(name, height_m, {{"crowns", 1.0}});
}

Part make_lantern() {
  const double height_m = 5.0;
  FloorPart part(kWidths_m[4]);
  part.storey(kWidths_m[4], 0.0, 4.0, kSlab);
  part.band(kWidths_m[5], 4.0, kRoofMetal);
  part.band(kWidths_m[5], height_m, kSlab);
  return part.finish("lantern", height_m, {{"storeys", 1.0}});
}

}  // namespace

PartDatabase make_tower_kit() {
  std::vector<Part> parts{make_podium()};
  for (std::size_t size = 0; size < 5; ++size) {
    parts.push_back(make_shaft(size, 4.0, 1));
    parts.push_back(make_shaft(size, 3.6, 2));
  }
  for (std::size_t size = 0; size < 4; ++size) parts.push_back(make_setback(size));
  parts.push_back(make_lantern());
  parts.push_back(make_spire("spire", 5, 12.0));
  parts.push_back(make_spire("pyramid", 3, 9.0));
  return PartDatabase(
      {.name = "tower",
       .summary = "floors of skyscrapers: podium, shafts of five sizes, setbacks, crowns",
       .origin = "synthetic: generated by Plat",
       .kit = "tower",
       .transition_limit_m2 = kTransitionLimit_m2},
      std::move(parts));
}

}  // namespace plat::buildings::detail
