#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "core/box.h"
#include "core/ids.h"

namespace plat::editing {

/// Finds streets near a place while they come and go: cells of a fixed size, each listing the
/// streets whose box meets it.
class StreetGrid {
 public:
  void insert(StreetId street, const Box& box);
  /// Pre: inserted with the same box.
  void erase(StreetId street, const Box& box);
  /// The streets whose cells meet `box`, sorted, each once.
  [[nodiscard]] std::vector<StreetId> near(const Box& box) const;

 private:
  template <class Visit>
  static void for_each_cell(const Box& box, Visit visit);

  std::unordered_map<std::uint64_t, std::vector<StreetId>> cells_;
};

}  // namespace plat::editing
