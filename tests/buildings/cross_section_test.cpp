#include "buildings/cross_section.h"

#include <gtest/gtest.h>

#include "buildings/made_meshes.h"
#include "buildings/part.h"
#include "support/property.h"

namespace plat::buildings {
namespace {

using testing::crooked_row;
using testing::without_end;

CutPlane left_plane(double x) {
  return cut_plane(
      {.role = PortRole::kLeft, .position_m = {x, 0, 0}, .outward = {-1, 0, 0}, .section = {}});
}
CutPlane right_plane(double x) {
  return cut_plane(
      {.role = PortRole::kRight, .position_m = {x, 0, 0}, .outward = {1, 0, 0}, .section = {}});
}

const CrossSection kCrooked{{{{{-4, 0}, {4, 0}, {4, 6}, {1, 6}, {1, 3}, {-4, 3}}, {}}}};

CrossSection rectangle(double x0, double y0, double x1, double y1) {
  return {{{{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, {}}}};
}

TEST(CrossSection, IsTheOutlineOfTheCapAtBothEnds) {
  const Mesh row = crooked_row(2.0, 5.0);
  EXPECT_EQ(cap_section(row, right_plane(5.0)), kCrooked);
  EXPECT_EQ(cap_section(row, left_plane(2.0)), kCrooked);
  EXPECT_EQ(cap_faces(row, left_plane(2.0)).size(), cap_faces(row, right_plane(5.0)).size());
  EXPECT_TRUE(cap_section(row, right_plane(4.0)).regions.empty());
}

TEST(CrossSection, DoesNotDependOnHowTheCapIsCutIntoFaces) {
  CellSolid solid;
  solid.fill({{0, -4, 0}, {3, 4, 3}}, 0);
  solid.fill({{0, 1, 3}, {3, 4, 6}}, 0);
  solid.add_y(-2.3);
  solid.add_y(0.1);
  solid.carve({{1, -4, 1}, {2, -3.7, 2}});
  const Mesh fine = solid.surface([](Point3 p) { return p; });
  EXPECT_GT(cap_faces(fine, right_plane(3.0)).size(),
            cap_faces(crooked_row(0, 3), right_plane(3.0)).size());
  EXPECT_EQ(cap_section(fine, right_plane(3.0)), kCrooked);
}

TEST(CrossSection, HasHolesAndSeveralRegions) {
  CellSolid solid;
  solid.fill({{0, -4, 0}, {3, 4, 6}}, 0);
  solid.carve({{0, -2, 1}, {3, 2, 3}});
  solid.fill({{0, 6, 0}, {3, 7, 1}}, 0);
  const CrossSection section =
      cap_section(solid.surface([](Point3 p) { return p; }), right_plane(3.0));
  ASSERT_EQ(section.regions.size(), 2U);
  EXPECT_EQ(section.regions[0].holes.size(), 1U);
  EXPECT_DOUBLE_EQ(area_m2(section), 48.0 - 8.0 + 1.0);
}

TEST(CrossSection, AnOpenMeshIsSlicedToTheSameOutline) {
  const Mesh row = crooked_row(2.0, 5.0);
  const Mesh open_right = without_end(row, 5.0);
  EXPECT_TRUE(cap_section(open_right, right_plane(5.0)).regions.empty());
  EXPECT_EQ(slice_section(open_right, right_plane(5.0)), kCrooked);
  EXPECT_EQ(slice_section(without_end(row, 2.0), left_plane(2.0)), kCrooked);
}

TEST(CrossSection, MirroredTwiceIsTheSameAndTheTwinHasTheMirroredSection) {
  EXPECT_NE(mirrored(kCrooked), kCrooked);
  EXPECT_EQ(mirrored(mirrored(kCrooked)), kCrooked);
  Mesh twin = crooked_row(0.0, 3.0);
  for (Point3& p : twin.vertices) p = {3.0 - p.x, -p.y, p.z};  // turned around
  EXPECT_FALSE(find_defect(twin));
  EXPECT_EQ(cap_section(twin, right_plane(3.0)), mirrored(kCrooked));
  EXPECT_EQ(area_m2(mirrored(kCrooked)), area_m2(kCrooked));
}

TEST(CrossSection, DisagreementIsTheAreaInOneAndNotInTheOther) {
  EXPECT_EQ(disagreement_m2(kCrooked, kCrooked), 0.0);
  EXPECT_DOUBLE_EQ(disagreement_m2(rectangle(0, 0, 2, 2), rectangle(1, 0, 3, 2)), 4.0);
  EXPECT_DOUBLE_EQ(disagreement_m2(rectangle(0, 0, 2, 2), rectangle(5, 0, 7, 2)), 8.0);
  EXPECT_DOUBLE_EQ(disagreement_m2(kCrooked, mirrored(kCrooked)), 2.0 * 9.0);
}

TEST(CrossSection, DisagreementOfRandomRectanglesMatchesTheFormula) {
  Rng rng = testing::property_rng("CrossSection.DisagreementOfRandomRectangles");
  int overlapping = 0;
  const int count = testing::iterations(500);
  for (int i = 0; i < count; ++i) {
    const auto draw = [&] { return std::round(rng.uniform(0.0, 40.0)) / 4.0; };
    const double ax = draw();
    const double bx = draw();
    const double aw = 0.25 + draw();
    const double bw = 0.25 + draw();
    const double ah = 0.25 + draw();
    const double bh = 0.25 + draw();
    const CrossSection a = rectangle(ax, 0, ax + aw, ah);
    const CrossSection b = rectangle(bx, 0, bx + bw, bh);
    const double common =
        std::max(0.0, std::min(ax + aw, bx + bw) - std::max(ax, bx)) * std::min(ah, bh);
    overlapping += common > 0.0 ? 1 : 0;
    EXPECT_NEAR(disagreement_m2(a, b), aw * ah + bw * bh - 2.0 * common, 1e-9);
    EXPECT_EQ(disagreement_m2(a, b), disagreement_m2(b, a));
    EXPECT_NEAR(disagreement_m2(mirrored(a), mirrored(b)), disagreement_m2(a, b), 1e-9);
  }
  EXPECT_GT(overlapping, count / 4);
}

TEST(CrossSection, VerticesAlongASlopeDoNotBendIt) {
  // 1/3 is on no grid: put there alone, the vertex would lie beside the slope.
  const auto roof = [](bool has_vertex) {
    Mesh mesh = testing::empty_mesh();
    std::vector<Point> ring{{-4, 3}, {4, 3}, {4, 4}};
    if (has_vertex) ring.push_back({4.0 / 3.0, 4.0 + 8.0 / 9.0});
    ring.push_back({0, 4.0 + 4.0 / 3.0});
    ring.push_back({-4, 4});
    add_lying_prism(mesh, ring, {0, 0, 0}, {3, 0, 0}, {0, -1, 0}, 0);
    return mesh;
  };
  EXPECT_EQ(cap_section(roof(true), right_plane(3.0)), cap_section(roof(false), right_plane(3.0)));
}

}  // namespace
}  // namespace plat::buildings
