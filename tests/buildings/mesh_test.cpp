#include "buildings/mesh.h"

#include <gtest/gtest.h>

#include "buildings/face_merging.h"
#include "buildings/made_meshes.h"
#include "core/failure.h"
#include "geodata/scratch_folder.h"

namespace plat::buildings {
namespace {

using testing::box_mesh;
using testing::empty_mesh;
using testing::ScratchFolder;

MeshDefectKind kind_of(const Mesh& mesh) {
  const auto defect = find_defect(mesh);
  EXPECT_TRUE(defect.has_value());
  return defect ? defect->kind : MeshDefectKind::kBadIndex;
}

std::string refusal(const std::string& file) {
  try {
    (void)read_mesh(file);
  } catch (const InputError& error) {
    return error.what();
  }
  return "read";
}

TEST(Mesh, ABoxHasNoDefectAndItsVolume) {
  const Mesh box = box_mesh({1, 2, 3}, {3, 5, 7});
  EXPECT_FALSE(find_defect(box));
  EXPECT_DOUBLE_EQ(volume_m3(box), 24.0);
}

TEST(Mesh, EveryDefectIsFound) {
  const Mesh box = box_mesh({0, 0, 0}, {1, 1, 1});
  Mesh bad = box;
  bad.faces[3].vertices[1] = 99;
  EXPECT_EQ(kind_of(bad), MeshDefectKind::kBadIndex);
  bad = box;
  bad.faces[3].material = 7;
  EXPECT_EQ(kind_of(bad), MeshDefectKind::kBadIndex);
  bad = box;
  bad.faces[3].vertices[1] = bad.faces[3].vertices[0];
  EXPECT_EQ(kind_of(bad), MeshDefectKind::kDegenerate);
  bad = box;
  bad.faces.pop_back();
  EXPECT_EQ(kind_of(bad), MeshDefectKind::kOpen);
  bad = box;
  bad.faces.insert(bad.faces.end(), box.faces.begin(), box.faces.end());
  EXPECT_EQ(kind_of(bad), MeshDefectKind::kNotManifold);
  EXPECT_NE(find_defect(bad)->message.find("has 4 faces"), std::string::npos);
  bad = box;
  std::swap(bad.faces[0].vertices[1], bad.faces[0].vertices[2]);
  EXPECT_EQ(kind_of(bad), MeshDefectKind::kNotOriented);
  bad = box;
  for (Face& face : bad.faces) std::swap(face.vertices[1], face.vertices[2]);
  EXPECT_EQ(kind_of(bad), MeshDefectKind::kInsideOut);
}

TEST(Mesh, TwoBoxesThatShareACornerAreNotAManifold) {
  Mesh mesh = box_mesh({0, 0, 0}, {1, 1, 1});
  append(mesh, box_mesh({1, 1, 1}, {2, 2, 2}));
  EXPECT_FALSE(find_defect(mesh));
  const auto at = [&](std::size_t first) {
    for (std::size_t i = first; i < mesh.vertices.size(); ++i) {
      if (mesh.vertices[i] == Point3{1, 1, 1}) return static_cast<std::uint32_t>(i);
    }
    return 0U;
  };
  const std::uint32_t one = at(0);
  const std::uint32_t other = at(one + 1);
  for (Face& face : mesh.faces) std::ranges::replace(face.vertices, other, one);
  EXPECT_EQ(kind_of(mesh), MeshDefectKind::kNotManifold);
}

TEST(Mesh, AppendUnitesEqualMaterials) {
  Mesh mesh = box_mesh({0, 0, 0}, {1, 1, 1});
  append(mesh, box_mesh({2, 0, 0}, {3, 1, 1}));
  EXPECT_EQ(mesh.materials, empty_mesh().materials);
  EXPECT_EQ(mesh.faces.size(), 24U);
  EXPECT_DOUBLE_EQ(volume_m3(mesh), 2.0);
}

class MeshFiles : public ::testing::TestWithParam<std::string> {};

TEST_P(MeshFiles, HoldWhatWasWritten) {
  const ScratchFolder folder;
  Mesh mesh = box_mesh({-0.5, 100.25, 3}, {3, 105, 7.0 + 1.0 / 65536.0});
  mesh.faces[4].material = 1;
  drop_unused_materials(mesh);
  write_mesh(folder.file("box" + GetParam()), mesh);
  const Mesh back = read_mesh(folder.file("box" + GetParam()));
  EXPECT_EQ(back.vertices, mesh.vertices);
  EXPECT_EQ(back.faces, mesh.faces);
  ASSERT_EQ(back.materials.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(back.materials[i].rgb, mesh.materials[i].rgb);
}

TEST_P(MeshFiles, BadOnesAreRefusedWithFileAndReason) {
  const ScratchFolder folder;
  const std::string bad = folder.write("bad" + GetParam(), "this is no mesh\n");
  EXPECT_NE(refusal(bad).find("bad" + GetParam()), std::string::npos) << refusal(bad);
  EXPECT_NE(refusal(folder.file("none" + GetParam())).find("no such file"), std::string::npos);
  EXPECT_THROW(write_mesh(folder.file("no/such/folder/box" + GetParam()), empty_mesh()),
               InputError);
}

INSTANTIATE_TEST_SUITE_P(Endings, MeshFiles, ::testing::Values(".obj", ".ply", ".off"),
                         [](const auto& at) { return at.param.substr(1); });

TEST(Mesh, FilesOfAnotherEndingAreRefused) {
  const ScratchFolder folder;
  EXPECT_NE(refusal(folder.write("box.stl", "solid")).find(".obj, .ply or .off"),
            std::string::npos);
  EXPECT_THROW(write_mesh(folder.file("box.stl"), box_mesh({0, 0, 0}, {1, 1, 1})), InputError);
}

TEST(Mesh, PolygonsAreSplitAndBentOnesRefused) {
  const ScratchFolder folder;
  const Mesh quad =
      read_mesh(folder.write("quad.obj", "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nf 1 2 3 4\n"));
  EXPECT_EQ(quad.faces.size(), 2U);
  EXPECT_DOUBLE_EQ(area_m2(quad, quad.faces[0]) + area_m2(quad, quad.faces[1]), 4.0);
  const std::string arrow =
      folder.write("arrow.obj", "v 0 0 0\nv 2 1 0\nv 0 2 0\nv 1 1 0\nf 1 2 3 4\n");
  EXPECT_NE(refusal(arrow).find("not convex"), std::string::npos) << refusal(arrow);
}

TEST(Mesh, FilesWithoutFacesAreRefused) {
  const ScratchFolder folder;
  EXPECT_NE(refusal(folder.write("points.off", "OFF\n1 0 0\n0 0 0\n")).find("no faces"),
            std::string::npos);
}

TEST(FaceMerging, TakesOutWhatTheSurfaceDoesNotNeed) {
  CellSolid solid;
  solid.fill({{0, 0, 0}, {4, 3, 2}}, 0);
  solid.carve({{1, 0, 0.5}, {2, 0.25, 1.5}});
  solid.add_x(3.3);
  solid.add_y(1.7);
  Mesh mesh = solid.surface([](Point3 p) { return p; });
  mesh.materials = empty_mesh().materials;
  const Mesh merged = merge_faces(mesh);
  EXPECT_FALSE(find_defect(merged));
  EXPECT_DOUBLE_EQ(volume_m3(merged), volume_m3(mesh));
  EXPECT_EQ(merged.vertices.size(), 16U);
  EXPECT_EQ(merged.faces.size(), 5U * 2U + 8U + 5U * 2U);
}

TEST(FaceMerging, KeepsTheBordersOfMaterialsAndPorts) {
  CellSolid solid;
  solid.fill({{0, 0, 0}, {4, 3, 2}}, 0);
  solid.fill({{0, 0, 2}, {4, 3, 5}}, 1);
  Mesh mesh = solid.surface([](Point3 p) { return p; });
  mesh.materials = empty_mesh().materials;
  const Mesh merged = merge_faces(mesh);
  EXPECT_FALSE(find_defect(merged));
  EXPECT_EQ(merged.faces.size(), 20U);
  double red = 0.0;
  for (const Face& face : merged.faces) red += face.material == 1 ? area_m2(merged, face) : 0.0;
  EXPECT_DOUBLE_EQ(red, 12.0 + 2.0 * 3.0 * 7.0);
}

}  // namespace
}  // namespace plat::buildings
