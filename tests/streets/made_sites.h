#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "core/rng.h"
#include "streets/street_grower.h"

namespace plat::testing {

/// How the points of a site lie.
enum class SiteFamily {
  kJitteredGrid,
  kExactGrid,
  kScattered,
  kClustered,
  kCollinear,
  kNearCollinear,
  kCoincident,  ///< several at each place
  kDense,       ///< a few steps of the working grid apart
  kFewPoints,   ///< none, one or two
};
inline constexpr std::array<std::string_view, 9> kSiteFamilyNames{
    "jittered_grid",  "exact_grid", "scattered", "clustered", "collinear",
    "near_collinear", "coincident", "dense",     "few_points"};

/// What else there is on a site.
enum class ExistingNetwork {
  kNone,
  kBeside,
  kAcross,
  kThroughPoints,
  kBridges,  ///< across, with streets that cross without a node and one that is a loop
};
enum class BoundaryKind { kNone, kAround, kThroughPoints, kStar, kHoles, kExcludesAll };
enum class ObstacleKind { kNone, kRiver, kScattered, kIsland, kAtPoints, kCoversAll };

struct MadeSite {
  streets::GrowthSite site;
  SiteFamily family = SiteFamily::kScattered;
  ExistingNetwork existing = ExistingNetwork::kNone;
  BoundaryKind boundary = BoundaryKind::kNone;
  ObstacleKind obstacles = ObstacleKind::kNone;
};

/// A site of at most `most_points` points with random attributes: levels, some of them deep ones
/// only, variances, some of them zero, one or two streets to a point. A function of seed and number
/// alone; families come in turn. All on the working grid, polygons strictly simple, all of it at
/// times far from the origin.
MadeSite made_site(std::uint64_t seed, std::uint32_t number, std::size_t most_points = 40);

/// Points of a town without anything else, for measurements: regular ones are a grid of 80 m with
/// a jitter of a tenth, others are scattered as densely.
enum class Town { kRegular, kRandom };
streets::GrowthSite made_town(std::uint64_t seed, Town town, std::size_t points);

}  // namespace plat::testing
