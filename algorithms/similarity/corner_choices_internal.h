#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "similarity/affine_vertex_similarity.h"

namespace plat::similarity::detail {

/// The set of corners 0 to count - 1.
constexpr std::uint32_t all_of(std::size_t count) { return (1U << count) - 1U; }

/// Fills `choices` and `choice_ends`: every set of three or more corners that is left by removals,
/// in any order, of which each changes the area by at most this share of the outline's.
void find_choices(CornerOutline& outline, double area_loss_01);

/// The sets of `count` corners among them, in the order in which they were found.
std::span<const std::uint16_t> choices_of(const CornerOutline& outline, std::size_t count);

/// The corners that are left when those of the smallest triangles are removed one by one.
std::uint32_t largest_corners(const CornerOutline& outline, std::size_t count);

}  // namespace plat::similarity::detail
