#include "sequences/contexts.h"

#include <algorithm>
#include <utility>

#include "core/failure.h"

namespace plat::sequences {

Contexts::Contexts(std::vector<std::uint32_t> key_points,
                   const std::vector<std::uint32_t>& choice_counts)
    : key_points_(std::move(key_points)) {
  for (const std::uint32_t key_point : key_points_) {
    counts_.push_back(choice_counts[key_point]);
    strides_.push_back(size_);
    size_ *= choice_counts[key_point];
  }
}

std::uint32_t Contexts::choice(std::uint32_t context, std::uint32_t key_point) const {
  const auto found = std::ranges::lower_bound(key_points_, key_point);
  expects(found != key_points_.end() && *found == key_point, "the key point is chosen for");
  const auto position = static_cast<std::size_t>(found - key_points_.begin());
  return context / strides_[position] % counts_[position];
}

std::uint32_t Contexts::project(std::uint32_t context, const Contexts& onto) const {
  std::uint32_t projected = 0;
  for (std::size_t i = 0; i < onto.key_points_.size(); ++i)
    projected += choice(context, onto.key_points_[i]) * onto.strides_[i];
  return projected;
}

Contexts Contexts::with(std::uint32_t key_point,
                        const std::vector<std::uint32_t>& choice_counts) const {
  auto key_points = key_points_;
  const auto place = std::ranges::lower_bound(key_points, key_point);
  if (place == key_points.end() || *place != key_point) key_points.insert(place, key_point);
  return {std::move(key_points), choice_counts};
}

}  // namespace plat::sequences
