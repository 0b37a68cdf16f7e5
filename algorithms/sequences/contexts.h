#pragma once

#include <cstdint>
#include <vector>

namespace plat::sequences {

/// All ways to choose one element at each of some key points, numbered: what the copies of a
/// segment are told apart by [Har, Fig. 3.4, 3.5].
class Contexts {
 public:
  /// @param key_points    ascending
  /// @param choice_counts by key point of the structure: how many elements it may take
  Contexts(std::vector<std::uint32_t> key_points, const std::vector<std::uint32_t>& choice_counts);
  /// One where there are no key points.
  [[nodiscard]] std::uint32_t size() const { return size_; }
  [[nodiscard]] const std::vector<std::uint32_t>& key_points() const { return key_points_; }
  /// What is chosen at one of its key points.
  [[nodiscard]] std::uint32_t choice(std::uint32_t context, std::uint32_t key_point) const;
  /// The same choices at fewer key points: `onto`'s are among these.
  [[nodiscard]] std::uint32_t project(std::uint32_t context, const Contexts& onto) const;
  /// These key points and one more, which may be among them already.
  [[nodiscard]] Contexts with(std::uint32_t key_point,
                              const std::vector<std::uint32_t>& choice_counts) const;

 private:
  std::vector<std::uint32_t> key_points_;
  std::vector<std::uint32_t> counts_;   // by position in key_points_
  std::vector<std::uint32_t> strides_;  // by position in key_points_
  std::uint32_t size_ = 1;
};

}  // namespace plat::sequences
