#include "streets/transition_survey.h"

#include <cmath>

namespace plat::streets {
namespace {

PassingStreet style(int level) {
  PassingStreet street;
  street.hierarchy = level;
  street.distance_mean_m = 100.0;
  street.distance_variance_m2 = 400.0;
  street.angle_variance_rad2 = 0.25;
  return street;
}

GrowthSite site_of(const std::vector<Point>& places) {
  GrowthSite site;
  for (const Point p : places) site.points.push_back({p, style(1), {}, {}});
  return site;
}

void add_street(GrowthSite& site, Point a, Point b) {
  Street street;
  street.line = {a, b};
  street.from = static_cast<std::uint32_t>(site.existing.nodes.size());
  street.to = street.from + 1;
  site.existing.nodes.insert(site.existing.nodes.end(), {a, b});
  site.existing.streets.push_back(street);
}

TEST(TransitionSurvey, TellsTheProbabilityOfEveryPoint) {
  const auto targets =
      *survey_targets(site_of({{0, 0}, {120, 0}, {0, 100}}),
                      {.base = 0, .street = style(1), .heading = Point{1, 0}}, 0.01);
  ASSERT_EQ(targets.size(), 3U);
  EXPECT_NEAR(targets[1].probability, std::exp(-0.5), 1e-12);
  EXPECT_EQ(targets[1].bar, StepBar::kNone);
  EXPECT_EQ(targets[2].bar, StepBar::kImprobable) << "a right angle is three deviations off";
  EXPECT_NE(targets[0].bar, StepBar::kNone) << "itself";
}

TEST(TransitionSurvey, TellsWhatBarsAStep) {
  GrowthSite site = site_of({{0, 0}, {100, 0}, {-100, 0}, {0, 100}, {0, -100}});
  site.points[1].a.hierarchy = 2;
  add_street(site, {-50, 50}, {-50, -50});
  add_street(site, {0, 100}, {50, 300});
  add_street(site, {0, 100}, {-50, 300});
  site.existing.nodes = {{-50, 50}, {-50, -50}, {0, 100}, {50, 300}, {-50, 300}};
  site.existing.streets[1].to = 3;
  site.existing.streets[2].from = 2;
  site.existing.streets[2].to = 4;
  const auto targets =
      *survey_targets(site, {.base = 0, .street = style(1), .heading = std::nullopt}, 0.01);
  EXPECT_EQ(targets[1].bar, StepBar::kLevel);
  EXPECT_EQ(targets[2].bar, StepBar::kCrossing);
  EXPECT_EQ(targets[3].bar, StepBar::kConnections);
  EXPECT_EQ(targets[4].bar, StepBar::kNone);
  site.points[3].b = style(4);
  EXPECT_EQ(survey_targets(site, {.base = 0, .street = style(1), .heading = std::nullopt}, 0.01)
                ->at(3)
                .bar,
            StepBar::kNone)
      << "its second street may still pass";
}

TEST(TransitionSurvey, RefusesSitesThatCannotBeUsed) {
  GrowthSite site = site_of({{0, 0}, {std::nan(""), 0}});
  EXPECT_FALSE(
      survey_targets(site, {.base = 0, .street = style(1), .heading = std::nullopt}, 0.01));
}

}  // namespace
}  // namespace plat::streets
