#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/parallel.h"
#include "layout_blending/blending_config.h"
#include "streets/street_network.h"
#include "synthesis/point_set.h"

namespace plat::blending {

/// What is measured: on the points of a blend, and on the network grown from them.
struct Measure {
  std::string name;
  std::string unit;
  bool is_of_points = false;  ///< else of the network
};

/// The measures of every row, in the order of their columns.
const std::vector<Measure>& measures();

/// A blend of one weight and seed with the network grown from it.
struct BlendRow {
  std::size_t pair = 0;
  std::size_t way = 0;
  double weight_01 = 0.0;
  int seed = 0;
  std::string status = "ok";                  ///< or the name of the grower's failure
  std::vector<std::optional<double>> values;  ///< one per measure; none where it has no value
};

/// An example as it was observed: what the blend's ends are compared with.
struct ExampleRow {
  std::size_t pair = 0;
  std::string_view side;  ///< "grid" or "irregular"
  std::vector<std::optional<double>> values;
};

/// A network kept for the figure.
struct KeptNetwork {
  std::size_t pair = 0;
  std::size_t way = 0;
  double weight_01 = 0.0;
  streets::StreetNetwork network;
};

struct BlendingResult {
  std::vector<ExampleRow> examples;
  std::vector<BlendRow> rows;         ///< by pair, way, weight, seed
  std::vector<KeptNetwork> networks;  ///< of the first seed
};

/// Every pair, way to place points, weight and seed. Independent of the number of threads.
/// @throws InputError for a data set that cannot be read, or a window without points
BlendingResult run_blending(const BlendingConfig& config, Jobs jobs);

}  // namespace plat::blending
