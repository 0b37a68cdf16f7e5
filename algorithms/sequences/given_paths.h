#pragma once

#include <cstddef>
#include <set>
#include <vector>

#include "sequences/sequence_path.h"

namespace plat::sequences {

/// What a stream has given when its search starts again with a larger limit: the later run finds
/// the earlier paths again, but of those that cost the same as the last one perhaps others. All
/// cheaper paths were given, and of the equal ones it is known which.
///
/// Guarantees: 1. runs that each give the best paths by cost, as many as their limit, together give
/// no path twice and miss none.
class GivenPaths {
 public:
  /// Whether the path has not been given; counts it if so. Within a run costs do not fall.
  bool add(const SequencePath& path) {
    if (path.cost < last_cost_) return false;
    if (path.cost > last_cost_) {
      equal_.clear();
      last_cost_ = path.cost;
    }
    if (!equal_.insert(path.steps).second) return false;
    ++count_;
    return true;
  }
  [[nodiscard]] std::size_t count() const { return count_; }

 private:
  Cost last_cost_ = -1;
  std::set<std::vector<Step>> equal_;  ///< the paths given at `last_cost_`
  std::size_t count_ = 0;
};

}  // namespace plat::sequences
