#pragma once

#include <span>
#include <vector>

#include "blocks/face_blocks.h"
#include "core/polygon.h"

namespace plat::blocks::detail {

/// The ring inset by each side's own half width, where that is a matter of meeting neighbouring
/// offset lines. A side that vanishes between two that turn left leaves them to meet; empty where
/// that is not so simple and the ring must be cut instead. The ring may still cross itself. Pre:
/// the sides form a simple counter-clockwise ring. Guarantee: 1. the ring keeps the half width of
/// every side that vanished.
Ring inset_ring(std::span<const StreetSide> sides);

/// What the streets of one boundary walk take from the face: a strip per side, and a wedge where
/// the walk turns right, so that corners of the street are filled. Same rules as inset_ring().
/// @param is_wanted  only strips of these sides, and wedges that they are at; empty: all
std::vector<Polygon> street_strips(std::span<const StreetSide> walk,
                                   const std::vector<bool>& is_wanted = {});

}  // namespace plat::blocks::detail
