#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "harness/observed_exemplar.h"
#include "statistics/distances.h"
#include "street_growth/growth_config.h"
#include "streets/network_measures.h"
#include "streets/network_recovery.h"

namespace plat::growth {

/// A city whose points are copied, and the truth about it.
struct KnownCity {
  std::string label;
  harness::ObservedExemplar observed;
  std::vector<int> levels;  ///< of its streets
  std::vector<Point> places;
  streets::NetworkMeasures measures;
};

/// Reads it and takes its exemplar. @throws InputError where its data are not there
KnownCity know_city(const CityChoice& choice, const GrowthConfig& config, Jobs jobs);

/// A square of the plane, and a level.
struct TileLevel {
  std::int64_t column = 0;
  std::int64_t row = 0;
  int level = 0;

  friend auto operator<=>(const TileLevel&, const TileLevel&) = default;
};
/// What was recovered, by the square in which the middle of each part lies.
using TiledShares = std::map<TileLevel, streets::RecoveryShares>;

/// Distances of a measure's values from those of the known city.
struct MeasureDistances {
  double ks = 0.0;
  double wasserstein = 0.0;
};

/// A city regrown once.
struct GrowthCell {
  std::string status = "ok";  ///< else a failure's code
  std::string message;
  double growth_s = 0.0;
  std::size_t left_alone = 0;
  TiledShares edges;
  TiledShares length;
  std::vector<std::optional<MeasureDistances>> distances;  ///< as network_samples()
  std::vector<std::optional<double>> scalars;              ///< as network_scalars()

  [[nodiscard]] bool is_ok() const { return status == "ok"; }
};

/// Copies the city's points, regrows it by the variant with streams 0, 1, ..., `repetitions` - 1
/// and compares each growth with the city. A growth that is the one before again is not judged
/// again.
std::vector<GrowthCell> run_cells(const KnownCity& city, const Variant& variant, int repetitions,
                                  const GrowthConfig& config);

/// The same growth again, edge by edge: for maps.
Expected<streets::Recovery> judged_edges(const KnownCity& city, const Variant& variant,
                                         int repetition, const GrowthConfig& config);

}  // namespace plat::growth
