#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/point.h"

namespace plat::buildings {

/// What an attribute of parts must add up to, in its own unit, both ends included.
struct AttributeBound {
  std::string attribute;  ///< e.g. "balconies" (Part::attributes)
  double min = 0.0;
  std::optional<double> max;  ///< none: no upper bound

  friend bool operator==(const AttributeBound&, const AttributeBound&) = default;
};

/// The side of an edge on which its front lies, for who walks from `from` to `to`.
enum class FrontSide { kLeft, kRight };

struct SkeletonEdge {
  std::uint32_t from = 0;  ///< index into BuildingSkeleton::nodes
  std::uint32_t to = 0;
  FrontSide front = FrontSide::kRight;
  /// Of the parts between the key points of the edge; what stands at a key point belongs to none of
  /// its edges.
  std::vector<AttributeBound> bounds = {};

  friend bool operator==(const SkeletonEdge&, const SkeletonEdge&) = default;
};

/// The lines along which a building stands, with the sides of its fronts [Har, Sec. 6.3, Fig. 6.6].
struct BuildingSkeleton {
  std::vector<Point> nodes;  ///< metres
  std::vector<SkeletonEdge> edges;
  std::vector<AttributeBound> bounds;  ///< of the whole building, key points included

  friend bool operator==(const BuildingSkeleton&, const BuildingSkeleton&) = default;
};

}  // namespace plat::buildings
