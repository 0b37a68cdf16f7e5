#include "buildings/part.h"

#include <gtest/gtest.h>

#include <numbers>

#include "buildings/made_meshes.h"
#include "core/failure.h"

namespace plat::buildings {
namespace {

using testing::crooked_row;
using testing::without_end;

constexpr double kRightAngle = 0.5 * std::numbers::pi;

PartShape middle(double length_m) {
  return {.part_class = PartClass::kMiddle, .right_m = length_m};
}

/// A bent bar: arms a and b of a corner that turns left by a right angle.
Mesh bent_bar(double a, double b) {
  CellSolid solid;
  solid.fill({{-a, -1, 0}, {1, 1, 3}}, 0);
  solid.fill({{-1, -1, 0}, {1, b, 3}}, 0);
  Mesh mesh = solid.surface([](Point3 p) { return p; });
  mesh.materials = testing::empty_mesh().materials;
  return mesh;
}

std::string refusal(const std::string& name, const PartShape& shape, const Mesh& mesh) {
  try {
    (void)make_part(name, shape, mesh, {});
  } catch (const InputError& error) {
    return error.what();
  }
  return "made";
}

TEST(Part, PortsLieWhereTheFrameSays) {
  const auto at = [](const PartShape& shape, std::size_t i) {
    return ports_of(shape)[i].position_m;
  };
  EXPECT_EQ(at(middle(3.0), 0), (Point3{0, 0, 0}));
  EXPECT_EQ(at(middle(3.0), 1), (Point3{3, 0, 0}));
  EXPECT_EQ(at({.part_class = PartClass::kLeftEnd, .right_m = 3.0}, 0), (Point3{3, 0, 0}));
  EXPECT_EQ(at({.part_class = PartClass::kRightEnd, .left_m = 3.0}, 0), (Point3{-3, 0, 0}));
  const PartShape tee{.part_class = PartClass::kTee,
                      .stem_side = StemSide::kFront,
                      .left_m = 1,
                      .right_m = 2,
                      .stem_m = 4};
  EXPECT_EQ(at(tee, 0), (Point3{-1, 0, 0}));
  EXPECT_EQ(at(tee, 1), (Point3{2, 0, 0}));
  EXPECT_EQ(at(tee, 2), (Point3{0, -4, 0}));
  const Point3 turned = at(
      {.part_class = PartClass::kCorner, .angle_rad = kRightAngle, .left_m = 1, .right_m = 2}, 1);
  EXPECT_NEAR(turned.x, 0.0, 1e-15);
  EXPECT_EQ(turned.y, 2.0);
  EXPECT_EQ(at({.part_class = PartClass::kFloor, .right_m = 4.0}, 1), (Point3{0, 0, 4}));
}

TEST(Part, LateralIsToTheLeftOfTheWalkingDirection) {
  const auto across = [](PortRole role, Point3 outward) {
    return cut_plane({.role = role, .position_m = {}, .outward = outward, .section = {}}).across;
  };
  EXPECT_EQ(across(PortRole::kLeft, {-1, 0, 0}), (Point3{0, 1, 0}));
  EXPECT_EQ(across(PortRole::kRight, {1, 0, 0}), (Point3{0, 1, 0}));
  EXPECT_EQ(across(PortRole::kStem, {0, 1, 0}), (Point3{-1, 0, 0}));
  EXPECT_EQ(across(PortRole::kStem, {0, -1, 0}), (Point3{1, 0, 0}));
}

TEST(Part, BothPortsOfARowHaveTheSameSection) {
  const Part part = make_part("row", middle(3.0), crooked_row(0, 3), {{"doors", 1}});
  EXPECT_EQ(part.ports[0].section, part.ports[1].section);
  EXPECT_NE(part.ports[0].section, mirrored(part.ports[0].section));
  EXPECT_EQ(attribute(part, "length_m"), 3.0);
  EXPECT_EQ(attribute(part, "doors"), 1.0);
  EXPECT_EQ(attribute(part, "no such"), 0.0);
}

TEST(Part, CapsNameTheirPort) {
  const Part part = make_part("row", middle(3.0), crooked_row(0, 3), {});
  std::array<double, 2> area{};
  for (const Face& face : part.mesh.faces) {
    if (face.port) area.at(*face.port) += area_m2(part.mesh, face);
  }
  for (std::size_t i = 0; i < 2; ++i) EXPECT_DOUBLE_EQ(area[i], area_m2(part.ports[i].section));
}

TEST(Part, AnOpenPortIsSliced) {
  const Part closed = make_part("row", middle(3.0), crooked_row(0, 3), {});
  const Part open = make_part("row", middle(3.0), without_end(crooked_row(0, 3), 3.0), {});
  EXPECT_EQ(open.ports[1].section, closed.ports[1].section);
}

TEST(Part, WhatIsNotAPartIsRefusedByName) {
  const Mesh row = crooked_row(0, 3);
  EXPECT_NE(refusal("shorty", middle(2.0), row).find("shorty"), std::string::npos);
  EXPECT_NE(refusal("long", middle(4.0), row).find("does not reach its right port"),
            std::string::npos);
  EXPECT_NE(refusal("none", middle(0.0), row).find("must be positive"), std::string::npos);
  EXPECT_NE(refusal("arm", {.part_class = PartClass::kMiddle, .left_m = 1.0, .right_m = 3.0}, row)
                .find("must be 0"),
            std::string::npos);
  EXPECT_NE(refusal("flat", {.part_class = PartClass::kCorner, .left_m = 1, .right_m = 1}, row)
                .find("angle"),
            std::string::npos);
  EXPECT_NE(refusal("../up", middle(3.0), row).find("letters, digits"), std::string::npos);
  EXPECT_NE(refusal("", middle(3.0), row).find("letters, digits"), std::string::npos);
  Mesh open = row;
  std::erase_if(open.faces, [&](const Face& face) { return normal(open, face).z > 0.0; });
  EXPECT_NE(refusal("roofless", middle(3.0), open).find("not at a port"), std::string::npos);
  Mesh inside_out = row;
  for (Face& face : inside_out.faces) std::swap(face.vertices[1], face.vertices[2]);
  EXPECT_NE(refusal("inside_out", middle(3.0), inside_out).find("volume"), std::string::npos);
}

TEST(Part, MiddlePartsAreScaledToTheQuantum) {
  const Part part = make_part("row", middle(3.07), crooked_row(0, 3.07), {});
  EXPECT_FALSE(is_quantised(part));
  const Quantised result = quantised(part);
  EXPECT_EQ(result.part.shape.right_m, 3.0);
  EXPECT_DOUBLE_EQ(result.factor, 3.0 / 3.07);
  EXPECT_EQ(attribute(result.part, "length_m"), 3.0);
  const Part again = make_part("row", result.part.shape, result.part.mesh, {});
  EXPECT_EQ(again.ports, result.part.ports);
  EXPECT_EQ(quantised(make_part("thin", middle(0.05), crooked_row(0, 0.05), {})).part.shape.right_m,
            0.2);
  EXPECT_EQ(quantised(result.part).factor, 1.0);
}

TEST(Part, CornersAreExtendedAtTheirPorts) {
  const PartShape shape{
      .part_class = PartClass::kCorner, .angle_rad = kRightAngle, .left_m = 2.5, .right_m = 3.3};
  const Part part = make_part("corner", shape, bent_bar(2.5, 3.3), {});
  const Quantised result = quantised(part);
  EXPECT_EQ(result.part.shape.left_m, 2.6);
  EXPECT_EQ(result.part.shape.right_m, 3.4);
  EXPECT_DOUBLE_EQ(result.factor, 6.0 / 5.8);
  const Part again = make_part("corner", result.part.shape, result.part.mesh, {});
  for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(again.ports[i].section, part.ports[i].section);
}

TEST(Part, MultiplesOfTheQuantumAreToldDespiteRounding) {
  double length_m = 0.0;
  for (int i = 1; i <= 60; ++i) {
    length_m += kLengthQuantum_m;
    const Part part{
        .name = "any", .shape = middle(length_m), .mesh = {}, .ports = {}, .attributes = {}};
    EXPECT_TRUE(is_quantised(part)) << length_m;
  }
}

}  // namespace
}  // namespace plat::buildings
