#include "buildings/building_design.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "core/failure.h"

namespace plat::buildings {
namespace {

/// A design file, gone at the end.
class DesignFile {
 public:
  explicit DesignFile(const std::string& text)
      : path_(std::filesystem::temp_directory_path() /
              (std::string("plat_") +
               ::testing::UnitTest::GetInstance()->current_test_info()->name() + ".json")) {
    std::ofstream(path_) << text;
  }
  ~DesignFile() { std::filesystem::remove(path_); }
  DesignFile(const DesignFile&) = delete;
  DesignFile& operator=(const DesignFile&) = delete;
  [[nodiscard]] BuildingDesign read() const { return read_building_design(path_); }
  [[nodiscard]] std::string refusal() const {
    try {
      static_cast<void>(read());
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

 private:
  std::filesystem::path path_;
};

TEST(BuildingDesign, ReadsASkeletonWithItsBounds) {
  const DesignFile file(R"({"name": "n", "skeleton": {"nodes": [[0, 0], [9, 0], [9, 5]],
    "edges": [{"from": 0, "to": 1, "front": [0, -1], "bounds": {"balconies": 3, "doors": [1, null]}},
              {"from": 1, "to": 2, "front": "left"}],
    "bounds": {"windows": [null, 20]}}, "steps": {"solar_area_m2": 0.5},
    "preferences": {"variety_m2": 2, "seed": 4}})");
  const BuildingDesign design = file.read();
  const auto& skeleton = std::get<BuildingSkeleton>(design.shape);
  ASSERT_EQ(skeleton.edges.size(), 2U);
  EXPECT_EQ(skeleton.edges[0].front, FrontSide::kRight);
  EXPECT_EQ(skeleton.edges[1].front, FrontSide::kLeft);
  EXPECT_EQ(skeleton.edges[0].bounds,
            (std::vector<AttributeBound>{{"balconies", 3, 3}, {"doors", 1, std::nullopt}}));
  EXPECT_EQ(skeleton.bounds, (std::vector<AttributeBound>{{"windows", 0, 20}}));
  EXPECT_EQ(design.steps.at("solar_area_m2"), 0.5);
  EXPECT_EQ(design.preferences.variety_m2, 2.0);
  EXPECT_EQ(design.preferences.seed, 4U);
}

TEST(BuildingDesign, RefusesWithFileKeyAndWhatIsAllowed) {
  EXPECT_NE(DesignFile("{").refusal().find("not JSON"), std::string::npos);
  EXPECT_NE(DesignFile("{}").refusal().find("one of \"skeleton\", \"tower\" and \"contour\""),
            std::string::npos);
  EXPECT_NE(DesignFile(R"({"tower": {"height_m": -4}})").refusal().find("height_m = -4, allowed"),
            std::string::npos);
  EXPECT_NE(DesignFile(R"({"skeleton": {"nodes": [[0, 0], [9, 0]],
      "edges": [{"from": 0, "to": 2, "front": "left"}]}})")
                .refusal()
                .find("edge 0: \"to\" must be a node: 0 to 1"),
            std::string::npos);
  EXPECT_NE(DesignFile(R"({"skeleton": {"nodes": [[0, 0], [9, 0]],
      "edges": [{"from": 0, "to": 1, "fornt": "left"}]}})")
                .refusal()
                .find("\"front\" is missing"),
            std::string::npos);
  EXPECT_NE(DesignFile(R"({"skeleton": {"nodes": [[0, 0], [9, 0]],
      "edges": [{"from": 0, "to": 1, "front": [1, 0]}]}})")
                .refusal()
                .find("looks along the edge"),
            std::string::npos);
  EXPECT_NE(DesignFile(R"({"skeleton": {"nodes": [[0, 0], [9, 0]], "edges": [], "x": 1}})")
                .refusal()
                .find("\"edges\" must be a list of at least 1"),
            std::string::npos);
}

TEST(BuildingDesign, MovesAContourInwardsAndDropsWhatIsTooShort) {
  const ContourDesign design{{{0, 0}, {80, 0}, {80, 60}, {78, 62}, {0, 62}}, 10.0, 15.0, {}};
  const BuildingSkeleton skeleton = skeleton_of(design);
  ASSERT_EQ(skeleton.nodes.size(), 4U);
  ASSERT_EQ(skeleton.edges.size(), 4U);
  EXPECT_GT(signed_area_m2(skeleton.nodes), 0.0);
  for (const SkeletonEdge& edge : skeleton.edges) EXPECT_EQ(edge.front, FrontSide::kRight);
  for (const Point node : skeleton.nodes)
    EXPECT_NEAR(std::abs(node.x - 40.0), 30.0, 1.5) << node.x << " " << node.y;
  EXPECT_THROW(static_cast<void>(skeleton_of({design.contour, 35.0, 15.0, {}})), InputError);
}

}  // namespace
}  // namespace plat::buildings
