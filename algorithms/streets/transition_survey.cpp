#include "streets/transition_survey.h"

#include <utility>

#include "streets/growth_plane.h"

namespace plat::streets {
namespace {

constexpr std::uint32_t kConnectionsPerStreet = 2;

/// How many segments of the existing streets end at each vertex, and how many may.
struct Connections {
  std::vector<std::uint32_t> present;
  std::vector<std::uint32_t> allowed;

  Connections(const GrowthSite& site, const GrowthPlane& plane)
      : present(plane.vertices().size(), 0), allowed(plane.vertices().size(), 0) {
    for (const Street& street : site.existing.streets) {
      ++present[street.from];
      ++present[street.to];
    }
    for (std::uint32_t i = 0; i < site.points.size(); ++i) {
      const auto streets = static_cast<std::uint32_t>(streets_of(site.points[i]).size());
      allowed[plane.vertex_of_point(i)] += kConnectionsPerStreet * streets;
    }
  }
};

bool knows_level(const IntersectionPoint& point, int level) {
  return point.a.hierarchy == level || (point.b && point.b->hierarchy == level);
}

}  // namespace

std::string_view step_bar_name(StepBar bar) {
  switch (bar) {
    case StepBar::kNone:
      return "none";
    case StepBar::kLevel:
      return "level";
    case StepBar::kImprobable:
      return "improbable";
    case StepBar::kConnections:
      return "connections";
    case StepBar::kCrossing:
      return "crossing";
  }
  return "none";
}

Expected<std::vector<SurveyedTarget>> survey_targets(const GrowthSite& site,
                                                     const SurveyedStep& step, double threshold,
                                                     const TransitionModel& model) {
  expects(step.base < site.points.size(), "the base is a point of the site");
  const auto plane = GrowthPlane::over(site);
  if (!plane) return tl::unexpected(plane.error());
  const Connections connections(site, *plane);
  const std::uint32_t from = plane->vertex_of_point(step.base);
  std::vector<SurveyedTarget> targets;
  for (std::uint32_t i = 0; i < site.points.size(); ++i) {
    const std::uint32_t to = plane->vertex_of_point(i);
    const Point way = plane->vertices()[to] - plane->vertices()[from];
    TransitionStep taken{length(way), std::nullopt};
    if (step.heading) taken.turn_rad = turn_between(*step.heading, way);
    SurveyedTarget target{transition_probability(step.street, taken, model), StepBar::kNone};
    if (!knows_level(site.points[i], step.street.hierarchy)) {
      target.bar = StepBar::kLevel;
    } else if (target.probability < threshold) {
      target.bar = StepBar::kImprobable;
    } else if (connections.present[to] >= connections.allowed[to]) {
      target.bar = StepBar::kConnections;
    } else if (!plane->admits(from, to)) {
      target.bar = StepBar::kCrossing;
    }
    targets.push_back(target);
  }
  return targets;
}

}  // namespace plat::streets
