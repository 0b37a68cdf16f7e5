#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "core/failure.h"
#include "streets/street_grower.h"
#include "streets/transition.h"

namespace plat::streets {

/// Why a street does not step to a point: (i) to (iv) of [AVB08, Fig. 5a].
enum class StepBar {
  kNone,         ///< it may
  kLevel,        ///< no street of its level passes there
  kImprobable,   ///< the transition probability is below the threshold
  kConnections,  ///< two streets have passed there already
  kCrossing,     ///< it would cross or touch a street on the way, or pass through a point
};
std::string_view step_bar_name(StepBar bar);

struct SurveyedTarget {
  double probability = 0.0;  ///< of the step, whether or not it is barred
  StepBar bar = StepBar::kNone;
};

/// The step that a street is about to take.
struct SurveyedStep {
  std::uint32_t base = 0;        ///< point of the site where the street has come to
  PassingStreet street;          ///< the style stored there
  std::optional<Point> heading;  ///< direction of its last segment; none before the first
};

/// How one step of a walk sees every point of a site, in their order: for drawings and for those
/// who ask why a street went where it did. The first bar that holds is told; the base point itself
/// bars by crossing.
/// @returns Failure for a site that cannot be used (street_grower.h)
/// Pre: `base` is a point of the site.
/// Paper: [AVB08, Sec. 3.1.1, Fig. 5a]
Expected<std::vector<SurveyedTarget>> survey_targets(const GrowthSite& site,
                                                     const SurveyedStep& step, double threshold,
                                                     const TransitionModel& model = {});

}  // namespace plat::streets
