#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "sequences/layer_plan.h"
#include "sequences/min_plus.h"

namespace plat::sequences {

/// One value per (zone, row, node). In zones of runs the rows of a node are neighbours, in others
/// the nodes of a row.
template <class Value>
class CostTable {
 public:
  /// Strides of a zone, and where its values begin.
  struct Place {
    std::size_t first = 0;
    std::size_t row_stride = 0;
    std::size_t node_stride = 0;
  };

  CostTable(const SearchGraph& graph, const LayerPlan& plan) {
    for (std::size_t z = 0; z < graph.zones.size(); ++z) {
      const std::size_t rows = plan.zones[z].row_count;
      const std::size_t nodes = graph.zones[z].size;
      Place place;
      place.first = size_;
      if (plan.zones[z].run_dimension) {
        place.row_stride = 1;
        // An odd number of lines: the nodes' values must not fall into one set of the cache.
        place.node_stride = (rows / kLine | 1U) * kLine + (rows % kLine > 0 ? 2 * kLine : 0);
        size_ += place.node_stride * nodes;
      } else {
        place.row_stride = (nodes + kRowMultiple - 1) / kRowMultiple * kRowMultiple;
        place.node_stride = 1;
        if (!graph.zones[z].table) place.row_stride = nodes;
        size_ += place.row_stride * rows;
      }
      places_.push_back(place);
    }
    values_ = std::make_unique_for_overwrite<Value[]>(size_);
  }

  [[nodiscard]] const Place& place(std::size_t zone) const { return places_[zone]; }
  [[nodiscard]] Value* at(std::size_t zone, Row row, std::size_t local) {
    return values_.get() + index(zone, row, local);
  }
  [[nodiscard]] Value value(std::size_t zone, Row row, std::size_t local) const {
    return values_[index(zone, row, local)];
  }
  [[nodiscard]] std::size_t index(std::size_t zone, Row row, std::size_t local) const {
    const Place& place = places_[zone];
    return place.first + row * place.row_stride + local * place.node_stride;
  }
  /// The zone that holds the value with this index.
  [[nodiscard]] std::size_t zone_of(std::size_t index) const {
    const auto after = std::ranges::upper_bound(places_, index, {}, &Place::first);
    return static_cast<std::size_t>(after - places_.begin()) - 1;
  }
  [[nodiscard]] std::pair<Row, std::uint32_t> row_and_node(std::size_t index,
                                                           std::size_t zone) const {
    const Place& place = places_[zone];
    const std::size_t large = std::max(place.row_stride, place.node_stride);
    const auto quotient = static_cast<std::uint32_t>((index - place.first) / large);
    const auto rest = static_cast<std::uint32_t>((index - place.first) % large);
    return place.node_stride > place.row_stride ? std::pair{rest, quotient}
                                                : std::pair{quotient, rest};
  }
  [[nodiscard]] std::size_t size() const { return size_; }

 private:
  static constexpr std::size_t kLine = 64 / sizeof(Value);
  std::vector<Place> places_;
  std::size_t size_ = 0;
  std::unique_ptr<Value[]> values_;
};

}  // namespace plat::sequences
