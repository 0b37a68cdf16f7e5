#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "core/failure.h"
#include "core/options.h"
#include "core/parallel.h"
#include "similarity/labelled_shape.h"
#include "similarity/prepared_shapes.h"
#include "similarity/shape_similarity.h"
#include "similarity/weighted_k_means.h"

namespace plat::similarity {

enum class ZoneRule {
  kSame,  ///< candidates of the place's zone; of any where the place's is unknown (empty)
  kAny,
};

struct CandidateOptions {
  int count = 5;
  int clusters = 1;
  ZoneRule zones = ZoneRule::kSame;

  static constexpr auto fields() {
    return std::tuple{
        Field{"count", &CandidateOptions::count, 1, 100000, "candidates wanted"},
        Field{"clusters", &CandidateOptions::clusters, 1, 100000,
              "clusters whose members are all compared; more where these hold too few candidates"},
        EnumField<CandidateOptions, ZoneRule, 2>{
            "zones",
            &CandidateOptions::zones,
            {{"same", ZoneRule::kSame}, {"any", ZoneRule::kAny}},
            "candidates of the zone of the place, or of any"}};
  }
};

/// A shape that may take a place, and how far it is from it.
struct Candidate {
  std::uint32_t shape = 0;  ///< index
  double distance = 0.0;    ///< measure.distance(shape, place)

  friend bool operator==(const Candidate&, const Candidate&) = default;
};

/// The order of candidates: nearest first, among equals the lower index.
constexpr bool is_nearer(const Candidate& a, const Candidate& b) {
  return a.distance != b.distance ? a.distance < b.distance : a.shape < b.shape;
}

/// Finds the shapes that are most like a place that may be none of them: a deformed tile, an empty
/// lot.
///
/// The place is compared with the representative of each cluster, then with the members of the
/// clusters whose representatives are nearest.
/// Guarantees: 1. candidates come nearest first, among equals the lower index;  2. never one that
/// is excluded, of another zone where zones are to be the same, or that the measure cannot prepare;
/// 3. `count` of them wherever as many are allowed;  4. with as many clusters as there are, they
/// are those that comparing with every shape gives;  5. safe to call from several threads.
/// Complexity:  one comparison per cluster and per member of the clusters looked into.
/// Paper:       [ABVA08, Sec. 5]
/// Deviation:   of a cluster without any allowed member the representative is not asked; clusters
///              beyond the first are an option (ADR 0036).
class CandidateSearch {
 public:
  /// Prepares every shape once.
  CandidateSearch(std::span<const LabelledShape> shapes, const Clusters& clusters,
                  AnyShapeSimilarity measure, Jobs jobs = {});

  /// A failure where the measure cannot prepare the place.
  [[nodiscard]] Expected<std::vector<Candidate>> most_similar(
      const LabelledShape& place, const CandidateOptions& options,
      std::span<const std::uint32_t> excluded = {}) const;

  [[nodiscard]] const std::vector<ShapeFailure>& failures() const { return prepared_.failures; }
  [[nodiscard]] const AnyShapeSimilarity& measure() const { return measure_; }

 private:
  struct Query;
  [[nodiscard]] bool is_allowed(std::uint32_t shape, const Query& query) const;

  AnyShapeSimilarity measure_;
  PreparedShapes prepared_;
  std::vector<std::string> zones_;
  std::vector<std::vector<std::uint32_t>> members_;  // prepared ones, the representative first
};

}  // namespace plat::similarity
