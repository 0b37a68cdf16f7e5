#include "buildings/part_kits.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bitset>
#include <cmath>
#include <memory>
#include <numbers>
#include <set>

#include "core/failure.h"
#include "geodata/scratch_folder.h"
#include "support/property.h"

namespace plat::buildings {
namespace {

const PartDatabase& kit(const std::string& name) {
  static std::map<std::string, std::unique_ptr<PartDatabase>> made;
  std::unique_ptr<PartDatabase>& at = made[name];
  if (!at) at = std::make_unique<PartDatabase>(make_part_kit(name));
  return *at;
}

/// "two" of "two_middle_030": the section family.
std::string family_of(const Part& part) { return part.name.substr(0, part.name.find('_')); }
bool is_transition_part(const Part& part) { return part.name.find("_to_") != std::string::npos; }

class AnyKit : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Kits, AnyKit, ::testing::Values("townhouse", "palazzo", "tower"),
                         [](const auto& at) { return at.param; });

TEST_P(AnyKit, MeshesAreClosedOrientedManifoldsWithVolume) {
  for (const Part& part : kit(GetParam()).parts()) {
    const auto defect = find_defect(part.mesh);
    EXPECT_FALSE(defect) << part.name << ": " << defect->message;
    EXPECT_GT(volume_m3(part.mesh), 1.0) << part.name;
  }
}

TEST_P(AnyKit, CapsCoverTheSections) {
  for (const Part& part : kit(GetParam()).parts()) {
    std::vector<double> area(part.ports.size(), 0.0);
    for (const Face& face : part.mesh.faces) {
      if (face.port) area[*face.port] += area_m2(part.mesh, face);
    }
    for (std::size_t i = 0; i < area.size(); ++i)
      EXPECT_NEAR(area[i], area_m2(part.ports[i].section), 0.1) << part.name;
  }
}

TEST_P(AnyKit, ArmsAreMultiplesOfTheQuantum) {
  for (const Part& part : kit(GetParam()).parts()) EXPECT_TRUE(is_quantised(part)) << part.name;
  EXPECT_TRUE(kit(GetParam()).scalings().empty());
}

TEST_P(AnyKit, IsTheSameEveryTime) {
  const PartDatabase again = make_part_kit(GetParam());
  EXPECT_EQ(again.parts(), kit(GetParam()).parts());
  EXPECT_EQ(again.transitions(), kit(GetParam()).transitions());
}

TEST_P(AnyKit, ReadsBackAsWritten) {
  const testing::ScratchFolder scratch;
  write_part_database(kit(GetParam()), scratch.file("kit"));
  const PartDatabase back = read_part_database(scratch.file("kit"));
  ASSERT_EQ(back.parts().size(), kit(GetParam()).parts().size());
  for (std::size_t i = 0; i < back.parts().size(); ++i) {
    const Part& part = kit(GetParam()).parts()[i];
    EXPECT_EQ(back.parts()[i].mesh, part.mesh) << part.name;
    EXPECT_EQ(back.parts()[i].attributes, part.attributes) << part.name;
    EXPECT_NEAR(back.parts()[i].shape.angle_rad, part.shape.angle_rad, 1e-12) << part.name;
    for (std::size_t port = 0; port < part.ports.size(); ++port)
      EXPECT_EQ(back.parts()[i].ports[port].section, part.ports[port].section) << part.name;
  }
  EXPECT_EQ(back.transitions(), kit(GetParam()).transitions());
}

TEST_P(AnyKit, SaysThatItIsSynthetic) {
  EXPECT_EQ(kit(GetParam()).info().origin.find("synthetic"), 0U);
  EXPECT_EQ(kit(GetParam()).info().kit, GetParam());
}

class RowKit : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Kits, RowKit, ::testing::Values("townhouse", "palazzo"),
                         [](const auto& at) { return at.param; });

TEST_P(RowKit, HasSixtyPartsOfEveryClass) {
  const PartDatabase& database = kit(GetParam());
  EXPECT_GE(database.parts().size(), 60U);
  std::map<PartClass, int> count;
  std::set<StemSide> stems;
  std::set<int> angles_deg;
  std::set<double> lengths;
  for (const Part& part : database.parts()) {
    ++count[part.shape.part_class];
    if (part.shape.part_class == PartClass::kTee) stems.insert(part.shape.stem_side);
    if (part.shape.part_class == PartClass::kCorner)
      angles_deg.insert(
          static_cast<int>(std::lround(part.shape.angle_rad * 180.0 / std::numbers::pi)));
    if (part.shape.part_class == PartClass::kMiddle) lengths.insert(part.shape.right_m);
  }
  EXPECT_EQ(count.size(), 5U);
  EXPECT_EQ(stems.size(), 2U);
  EXPECT_EQ(angles_deg, (std::set<int>{-135, -120, -90, -60, -45, 45, 60, 90, 120, 135}));
  EXPECT_EQ(*lengths.begin(), 0.4);
  EXPECT_EQ(*lengths.rbegin(), 12.0);
}

TEST_P(RowKit, SectionsMatchInsideAFamilyAndOnlyThere) {
  const PartDatabase& database = kit(GetParam());
  std::map<std::string, std::size_t> section_of;
  for (std::size_t i = 0; i < database.parts().size(); ++i) {
    const Part& part = database.parts()[i];
    if (is_transition_part(part)) continue;
    for (std::size_t port = 0; port < part.ports.size(); ++port) {
      const auto [at, is_new] =
          section_of.try_emplace(family_of(part), database.section_of({i, port}));
      EXPECT_EQ(at->second, database.section_of({i, port})) << part.name;
      EXPECT_EQ(database.cost({i, port}, {i, port}), 0);
    }
  }
  EXPECT_EQ(section_of.size(), 3U);
  EXPECT_EQ(database.sections().size(), 3U);
  for (std::size_t a = 0; a < 3; ++a) {
    for (std::size_t b = 0; b < 3; ++b) {
      const auto cost = database.transitions().cost(a, b, Facing::kSame);
      EXPECT_EQ(cost == 0, a == b);
      EXPECT_EQ(cost, database.transitions().cost(b, a, Facing::kSame));
    }
  }
}

TEST_P(RowKit, TransitionPartsLeadFromEveryFamilyToEveryOther) {
  const PartDatabase& database = kit(GetParam());
  std::set<std::pair<std::size_t, std::size_t>> found;
  for (std::size_t i = 0; i < database.parts().size(); ++i) {
    if (is_transition_part(database.parts()[i]))
      found.emplace(database.section_of({i, 0}), database.section_of({i, 1}));
  }
  EXPECT_EQ(found.size(), 6U);
}

/// The vertices on the rim of a cap, in the coordinates of its plane.
std::set<std::pair<long, long>> rim_of(const Part& part, std::size_t port) {
  const CutPlane plane = cut_plane(part.ports[port]);
  std::set<std::pair<long, long>> out;
  for (const Face& face : part.mesh.faces) {
    if (face.port != port) continue;
    for (const std::uint32_t v : face.vertices) {
      const Point3 p = part.mesh.vertices[v] - plane.origin;
      out.emplace(std::lround(dot(p, plane.across) * 1e3), std::lround(dot(p, plane.up) * 1e3));
    }
  }
  return out;
}

TEST_P(RowKit, RimsOfAFamilyHaveTheSameVertices) {
  std::map<std::string, std::set<std::pair<long, long>>> rims;
  for (const Part& part : kit(GetParam()).parts()) {
    if (is_transition_part(part)) continue;
    for (std::size_t port = 0; port < part.ports.size(); ++port) {
      const auto [at, is_new] = rims.try_emplace(family_of(part), rim_of(part, port));
      EXPECT_EQ(at->second, rim_of(part, port)) << part.name << " port " << port;
    }
  }
}

TEST_P(RowKit, PartsOfferWhatTheirNamesSay) {
  const std::vector<std::pair<std::string, std::string>> promises{
      {"balcon", "balconies"},      {"door", "doors"},       {"portal", "doors"},
      {"dormers", "dormers"},       {"chimney", "chimneys"}, {"solar", "solar_area_m2"},
      {"cooled", "air_conditions"}, {"", "floor_area_m2"}};
  for (const Part& part : kit(GetParam()).parts()) {
    for (const auto& [word, what] : promises) {
      // The palazzo has panels on terraces only.
      if (word == "solar" && family_of(part) != "loggia" && GetParam() == "palazzo") continue;
      if (part.name.find(word) == std::string::npos) continue;
      EXPECT_GT(attribute(part, what), 0.0) << part.name << " " << what;
    }
  }
}

TEST_P(RowKit, CornersMeetInTheMitre) {
  for (const Part& part : kit(GetParam()).parts()) {
    if (part.shape.part_class != PartClass::kCorner) continue;
    double wide_m = 0.0;
    for (const Point p : part.ports[0].section.regions[0].outer) wide_m = std::max(wide_m, p.x);
    const double tangent = std::tan(0.5 * part.shape.angle_rad);
    for (const double y : {-wide_m, wide_m}) {
      const bool has_corner = std::ranges::any_of(part.mesh.vertices, [&](Point3 p) {
        return std::abs(p.x + y * tangent) < 0.01 && std::abs(p.y - y) < 0.01;
      });
      EXPECT_TRUE(has_corner) << part.name << " at lateral " << y;
    }
  }
}

TEST_P(RowKit, CornersOfAnyAngleFitTheirFamilies) {
  Rng rng = testing::property_rng("RowKit.CornersOfAnyAngle");
  const PartDatabase& database = kit(GetParam());
  for (int i = 0; i < testing::iterations(4); ++i) {
    const double size = rng.uniform(kMinCornerTurn_rad, kMaxCornerTurn_rad);
    const double angle_rad = i % 2 == 0 ? size : -size;
    const std::vector<Part> corners = make_corner_parts(GetParam(), angle_rad);
    ASSERT_EQ(corners.size(), 3U);
    const PartDatabase with = with_parts(database, corners);
    EXPECT_EQ(with.sections(), database.sections()) << angle_rad;
    for (const Part& part : corners) {
      EXPECT_FALSE(find_defect(part.mesh)) << part.name;
      EXPECT_EQ(part.shape.angle_rad, angle_rad);
      EXPECT_TRUE(is_quantised(part)) << part.name;
    }
  }
}

TEST(PartKits, CornersOutOfRangeAreRefused) {
  EXPECT_THROW((void)make_corner_parts("townhouse", 3.0), InputError);
  EXPECT_THROW((void)make_corner_parts("townhouse", 0.001), InputError);
  EXPECT_THROW((void)make_corner_parts("tower", 1.0), InputError);
}

TEST(PartKits, UnknownKitsAreRefusedWithTheNearestName) {
  try {
    (void)make_part_kit("palazo");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("palazzo"), std::string::npos);
  }
}

TEST(PartKits, TheLoggiaHasAFrontAndABack) {
  const PartDatabase& database = kit("palazzo");
  const std::size_t section = database.section_of({*database.find("loggia_middle_004"), 0});
  EXPECT_GT(database.transitions().cost(section, section, Facing::kMirrored), 0);
  const std::size_t piano = database.section_of({*database.find("piano_middle_004"), 0});
  EXPECT_EQ(database.transitions().cost(piano, piano, Facing::kMirrored), 0);
}

TEST(PartKits, TheTowerHasTheThesisNumberOfFloors) {
  EXPECT_EQ(kit("tower").parts().size(), 18U);
  EXPECT_EQ(kit("tower").transition_count(), 81U);  // the thesis: 80
  for (const Part& part : kit("tower").parts()) {
    const double area = attribute(part, "floor_area_m2");
    EXPECT_EQ(area, std::round(area)) << part.name;
  }
}

/// By height in quanta and part: the floor areas that stacks from the podium up to that part reach.
constexpr std::size_t kMaxArea_m2 = 36000;
using Areas = std::bitset<kMaxArea_m2>;

TEST(PartKits, TowersOf120MetresReachTheFloorAreaRatiosOfTheThesis) {
  const PartDatabase& database = kit("tower");
  const std::size_t podium = *database.find("podium");
  const auto height = [&](std::size_t part) {
    return static_cast<std::size_t>(
        std::lround(attribute(database.parts()[part], "height_m") / kLengthQuantum_m));
  };
  const auto area = [&](std::size_t part) {
    return static_cast<std::size_t>(attribute(database.parts()[part], "floor_area_m2"));
  };
  const std::size_t top = 600;  // 120 m
  const std::size_t count = database.parts().size();
  std::vector<std::vector<Areas>> reached(top + 1, std::vector<Areas>(count));
  reached[height(podium)][podium].set(area(podium));
  for (std::size_t level = 0; level <= top; ++level) {
    for (std::size_t from = 0; from < count; ++from) {
      if (reached[level][from].none()) continue;
      for (std::size_t to = 0; to < count; ++to) {
        if (to == podium || level + height(to) > top || !database.may_meet({from, 1}, {to, 0}))
          continue;
        reached[level + height(to)][to] |= reached[level][from] << area(to);
      }
    }
  }
  Areas crowned;
  for (std::size_t part = 0; part < count; ++part) {
    if (attribute(database.parts()[part], "crowns") > 0.0) crowned |= reached[top][part];
  }
  for (const std::size_t ratio : {10U, 15U, 20U})
    EXPECT_TRUE(crowned.test(ratio * area(podium))) << ratio;
}

}  // namespace
}  // namespace plat::buildings
