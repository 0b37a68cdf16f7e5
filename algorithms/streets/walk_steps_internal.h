#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "core/rng.h"
#include "streets/growth_plane.h"
#include "streets/random_walk_grower.h"
#include "streets/transition.h"
#include "streets/walk_slots_internal.h"

namespace plat::streets::detail {

/// A segment that a walk may add.
struct WalkStep {
  std::uint32_t from = 0;  ///< slots
  std::uint32_t to = 0;
  double probability = 0.0;
};

/// The steps that walks may take between the slots of one level, and how probable they are.
///
/// Steps only ever become impossible while streets grow, so what is barred once stays so, and a
/// probability is worked out again only where what it rests on has changed.
class WalkSteps {
 public:
  WalkSteps(const GrowthPlane& plane, const WalkSlots& slots,
            const RandomWalkGrower::Options& options);

  /// Finds the pairs of these slots that are within reach of each other; those found before are
  /// forgotten. Steps are then asked of these slots only.
  void look_around(std::span<const std::uint32_t> members);

  /// The likeliest possible step from a slot; of equal ones the one to the lower vertex.
  std::optional<WalkStep> likeliest(std::uint32_t slot);
  /// A possible step, with its probability among them.
  std::optional<WalkStep> sampled(std::uint32_t slot, Rng& rng);
  /// How certain the likeliest step from a slot is, in [0, 1]: its share of the probabilities of
  /// all possible steps from there; where the mutual view is taken, times its share at the other
  /// end. None where no step is possible.
  std::optional<double> certainty(std::uint32_t slot);

 private:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  struct Target {
    std::uint32_t slot = 0;
    std::uint32_t twin = kNone;      ///< the way back: number among the targets of `slot`
    double by_distance = 0.0;        ///< probability, seen from the base, of the distance alone
    double view = 0.0;               ///< probability, seen from the base, of the step
    std::uint32_t view_age = kNone;  ///< connections of the base when it was worked out
    std::uint32_t opposite = kNone;  ///< slot that goes best with it on the other side of the base
    bool is_barred = false;
  };

  void find_targets(std::uint32_t base, const std::vector<std::uint32_t>& near);
  void find_twins();
  [[nodiscard]] Point way(std::uint32_t from, std::uint32_t to) const;
  double view(std::uint32_t base, Target& target);
  void look_ahead(std::uint32_t base, Target& target);
  double probability(std::uint32_t base, Target& target);
  bool is_possible(std::uint32_t base, Target& target);
  /// Numbers of the targets of a slot whose step is not too improbable, the likeliest first.
  struct Ranked {
    double probability = 0.0;
    std::uint32_t target = 0;
  };
  std::vector<Ranked> ranked(std::uint32_t base);
  /// Share of the steps to the vertex of `to` in all possible steps from a slot.
  double share(std::uint32_t base, std::uint32_t to_vertex);

  const GrowthPlane& plane_;
  const WalkSlots& slots_;
  const RandomWalkGrower::Options& options_;
  TransitionModel model_;
  std::vector<std::uint32_t> members_;
  std::vector<std::vector<Target>> targets_;  ///< per slot, the likeliest distance first
};

}  // namespace plat::streets::detail
