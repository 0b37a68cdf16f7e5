#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "streets/growth_plane.h"
#include "streets/random_walk_grower.h"
#include "streets/street_grower.h"

namespace plat::streets::detail {

/// A street that may pass through a vertex of the plane, and how far it has come there.
struct WalkSlot {
  std::uint32_t vertex = 0;
  Point place;
  PassingStreet style;
  std::uint32_t capacity = 0;     ///< connections that it may have
  std::uint32_t connections = 0;  ///< that it has
  /// Direction in which the street would go straight on, not normalised: that of its last segment,
  /// or of the open end; none before the first.
  std::optional<Point> heading;

  [[nodiscard]] bool is_free() const { return connections < capacity; }
};

/// All slots of a site: those of its open ends, then those of its points, in their order; and
/// which of them are connected to one street.
class WalkSlots {
 public:
  WalkSlots(const GrowthSite& site, const GrowthPlane& plane,
            const RandomWalkGrower::Options& options);

  [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(slots_.size()); }
  [[nodiscard]] const WalkSlot& operator[](std::uint32_t slot) const { return slots_[slot]; }

  /// Slots 0 .. n-1 are those of the site's open ends.
  [[nodiscard]] std::uint32_t open_ends() const { return open_ends_; }

  /// A new segment leaves `from` in a direction; where it reaches a slot, both are one street.
  void connect(std::uint32_t from, std::optional<std::uint32_t> to, Point way);

  /// The same number for all slots of one street.
  [[nodiscard]] std::uint32_t street_of(std::uint32_t slot);

 private:
  std::vector<WalkSlot> slots_;
  std::uint32_t open_ends_ = 0;
  std::vector<std::uint32_t> parents_;  ///< a forest: one tree per street
};

/// How near to other points a segment between two slots may pass, metres.
double clearance_m(const WalkSlot& from, const WalkSlot& to,
                   const RandomWalkGrower::Options& options);

}  // namespace plat::streets::detail
