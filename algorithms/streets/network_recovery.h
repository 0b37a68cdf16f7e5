#pragma once

#include <cstdint>
#include <map>
#include <numbers>
#include <optional>
#include <span>
#include <tuple>
#include <vector>

#include "core/options.h"
#include "streets/street_grower.h"
#include "streets/street_network.h"

/// How much of a known network a grown one recovered, by geometry alone (ADR 0033).
namespace plat::streets {

/// A part of one network and how much of it the other has: 0 or 1 of an edge, metres of a street.
struct JudgedPart {
  Segment chord;        ///< from end to end
  int level = 0;        ///< of its street
  double amount = 0.0;  ///< 1, or its length
  double matched = 0.0;
};

/// Both sides of a comparison.
struct Recovery {
  std::vector<JudgedPart> known;  ///< what is matched was recovered
  std::vector<JudgedPart> grown;  ///< what is matched is true
};

/// Shares of sums; absent where there is nothing to take a share of.
struct RecoveryShares {
  double known = 0.0;
  double recovered = 0.0;
  double grown = 0.0;
  double right = 0.0;  ///< grown parts that are true

  [[nodiscard]] std::optional<double> recall_01() const;
  [[nodiscard]] std::optional<double> precision_01() const;
  /// Harmonic mean of the two, 2 matched / (known + grown).
  [[nodiscard]] std::optional<double> f1_01() const;

  RecoveryShares& operator+=(const RecoveryShares& other);
};

RecoveryShares shares_of(const Recovery& recovery);
/// By the part's own level: a known part's in recall, a grown one's in precision.
std::map<int, RecoveryShares> shares_by_level(const Recovery& recovery);

/// A network and the level of each of its streets.
struct LevelledNetwork {
  const StreetNetwork& network;
  std::span<const int> levels;  ///< one per street
};

/// The levels of a growth's streets; `existing_level` for those that were there before.
std::vector<int> levels_of(const Growth& growth, int existing_level = 0);

/// Recovery by edges: pairs of places next to each other along a street.
///
/// Guarantees: 1. a part per pair, however many streets join it; its level is the most important of
/// theirs;  2. matched where the other network has the same pair;  3. places where other than two
/// streets meet are ends of edges, too, listed or not;  4. a network recovers itself; the other way
/// round known and grown change places.
/// @param places  where both networks have their points, on the working grid, any order
/// Complexity: O(n log n).
Recovery recover_edges(const LevelledNetwork& known, const LevelledNetwork& grown,
                       std::span<const Point> places);

struct LengthRecoveryOptions {
  double buffer_m = 10.0;
  double max_turn_rad = std::numbers::pi / 6;
  static constexpr auto fields() {
    return std::tuple{Field{"buffer_m", &LengthRecoveryOptions::buffer_m, 0.01, 1000.0,
                            "A place of a street is matched where the other network has a street "
                            "no farther away."},
                      Field{"max_turn_rad", &LengthRecoveryOptions::max_turn_rad, 0.0,
                            std::numbers::pi / 2, "And which runs in a direction no farther off."}};
  }
};

/// Recovery by length: what of each street lies in the buffer of streets of the other network that
/// run in about the same direction.
///
/// Guarantees: 1. a part per street, in their order;  2. lengths are computed, not sampled: what of
/// a segment is within the buffer of another is an interval;  3. a network recovers itself; the
/// other way round known and grown change places.
/// Complexity: O(n k) for k segments in the neighbourhood of one.
Recovery recover_length(const LevelledNetwork& known, const LevelledNetwork& grown,
                        const LengthRecoveryOptions& options = {});

}  // namespace plat::streets
