#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "core/options.h"
#include "core/rng.h"
#include "imagery/parcel_shape.h"
#include "similarity/box_similarity.h"

namespace plat::imagery {

enum class ZonePolicy : std::uint8_t { kSame, kAny };

struct RetrievalOptions {
  double area_weight = 1.0;    ///< of the difference in log area of the boxes
  double aspect_weight = 1.0;  ///< of the difference in log aspect ratio of the boxes
  int variety = 1;             ///< one of as many of the nearest is drawn; 1 is the paper
  Mirroring mirroring = Mirroring::kAllowed;
  ZonePolicy zones = ZonePolicy::kSame;
  static constexpr auto fields() {
    using O = RetrievalOptions;
    return std::tuple{
        Field{"area_weight", &O::area_weight, 0.0, 100.0,
              "Weight of the difference in log area of the bounding boxes."},
        Field{"aspect_weight", &O::aspect_weight, 0.0, 100.0,
              "Weight of the difference in log aspect ratio of the bounding boxes."},
        Field{"variety", &O::variety, 1, 1000,
              "One of as many of the nearest examples is drawn; 1 takes the nearest, as AVB08."},
        EnumField<O, Mirroring, 2>{
            "mirroring",
            &O::mirroring,
            {{"allowed", Mirroring::kAllowed}, {"forbidden", Mirroring::kForbidden}},
            "Whether an image may be mirrored to bring a corner lot's "
            "fronts to the streets."},
        EnumField<O, ZonePolicy, 2>{"zones",
                                    &O::zones,
                                    {{"same", ZonePolicy::kSame}, {"any", ZonePolicy::kAny}},
                                    "Whether an example must be of the same zone, where both "
                                    "have one."}};
  }
};

/// How much of the wish was granted.
enum class MatchLevel : std::uint8_t {
  kFrontAndZone,  ///< same class of street sides, same zone
  kFront,         ///< no example of the zone has these street sides
  kAny,           ///< no example has these street sides: streets are ignored
};
std::string_view match_level_name(MatchLevel level);

struct Match {
  std::size_t example = 0;  ///< index in the examples
  double distance = 0.0;    ///< weighted, in logarithms
  MatchLevel level = MatchLevel::kFrontAndZone;
  Symmetry symmetry = Symmetry::kKept;  ///< lays the example's street sides on the target's

  friend bool operator==(const Match&, const Match&) = default;
};

/// Finds the example parcel whose bounding box is most like that of a new parcel, in area and
/// aspect ratio, among those that face the street with the same side.
///
/// Same side facing the street: a rotation by half a turn, or a mirror where permitted, lays the
/// sides of the example's box that face streets on those of the target's, all of them and no other;
/// long on long, short on short. A parcel of whose streets nothing is known matches those of which
/// nothing is known, and after them any.
///
/// Guarantees: 1. the nearest by the distance of similarity::BoxSimilarity, the lower index where
/// two are equally near;  2. the level is the first that has an example at all;  3. with
/// variety k one of the k nearest, uniformly; the same stream gives the same choice.
/// Complexity: O(log n) a query, O(n log n) to build
/// Paper:      [AVB08, Sec. 3.2]
/// Deviation:  the paper weighs area and aspect ratio in a way it does not state; logarithms make
///             twice and half the size equally far (ADR 0032)
class ImageRetrieval {
 public:
  /// @throws InputError without examples
  ImageRetrieval(std::span<const ParcelShape> examples, const RetrievalOptions& options);

  /// @param excluded  an example that may not be taken: the parcel itself, where a city is its own
  ///                  example; nullopt if there is no other
  [[nodiscard]] std::optional<Match> nearest(const ParcelShape& target, Rng& rng,
                                             std::optional<std::size_t> excluded = {}) const;

 private:
  struct Entry {
    similarity::BoxCoordinates box;
    std::size_t example;
  };
  /// A balanced tree of two dimensions in an array: the middle of a range is its root, the halves
  /// are split by the other coordinate.
  using Tree = std::vector<Entry>;
  struct Candidate {
    double squared;
    std::size_t example;
    friend auto operator<=>(const Candidate&, const Candidate&) = default;
  };
  /// The `count` nearest of a tree, nearest first.
  struct Query {
    Entry at;
    std::size_t count;
    std::optional<std::size_t> excluded;
    std::vector<Candidate> found;
  };
  static constexpr int kUnknownFront = -1;
  static constexpr int kAnyFront = -2;
  struct Key {
    int front;
    std::string zone;
    friend auto operator<=>(const Key&, const Key&) = default;
  };

  [[nodiscard]] int front_of(const ParcelShape& shape) const;
  [[nodiscard]] Entry entry_of(const ParcelShape& shape, std::size_t index) const;
  static void build(Tree& tree, std::size_t begin, std::size_t end, int depth);
  static void search(const Tree& tree, std::size_t begin, std::size_t end, int depth, Query& query);
  [[nodiscard]] Symmetry symmetry_of(std::size_t example, const ParcelShape& target) const;

  RetrievalOptions options_;
  std::vector<std::optional<BoxSides>> sides_;  // per example
  std::map<Key, Tree> trees_;                   // with zone; without ("*"); any front ("*")
};

/// The one of two sources of images a parcel takes its image from: the second with probability
/// `weight_01` [AVB08, Sec. 6, Fig. 12].
std::size_t drawn_source(double weight_01, Rng& rng);

}  // namespace plat::imagery
