#pragma once

#include <string_view>
#include <tuple>

#include "streets/street_grower.h"
#include "streets/transition.h"

namespace plat::streets {

/// Grows streets by directed random walks through the points, level by level, as their attributes
/// say that streets go on.
///
/// Guarantees, besides the family's contract, each with the option that switches it off:
/// 1. a street of a level goes only to points that know one (`levels`), but where an open end is
/// joined in the end (`open_ends`);  2. at most two streets
/// pass a point, with two connections each (`connections`);  3. no step is less likely than
/// `threshold`;  4. no step crosses a street but at its points, and no point is added
/// (`crossings`);  5. no street runs over a point at which it does not stop (`clearance_widths`);
/// 6. in the end no step is left that could be taken;  7. an open end has one connection.
/// Complexity: O(n log n) where streets are of similar length and each point has a bounded number
/// of others within its reach.
/// Paper: [AVB08, Sec. 3.1.1, Fig. 3 and 5]. With `connections` four, `first_step` blind, `view`
/// base, `start` random, `open_ends` by_level, `clearance_widths` 0 and the deviations' bounds 0,
/// nothing is added to it. Deviation: what the paper leaves open, and what was added because it
/// recovers more of observed cities (ADR 0027): the order in which steps are taken, the first step
/// of a street, which has no angle, the look back from the target, the clearance, least deviations.
class RandomWalkGrower {
 public:
  static constexpr std::string_view kName = "random_walk";
  static constexpr std::string_view kSummary =
      "directed random walks through attributed points, level by level [AVB08, Sec. 3.1.1]";

  enum class Levels { kMatch, kIgnored };
  enum class Connections { kFour, kObserved, kUnlimited };
  enum class Crossings { kForbidden, kNoded, kTee };
  enum class Selection { kLikeliest, kSampled };
  enum class Start { kRandom, kLikeliest };
  enum class FirstStep { kBlind, kLookAhead };
  enum class View { kBase, kMutual };
  enum class OpenEnds { kJoined, kByLevel };
  enum class Curves { kTortuous, kStraight };

  struct Options {
    Levels levels = Levels::kMatch;
    Connections connections = Connections::kFour;
    Crossings crossings = Crossings::kForbidden;
    double threshold = 0.01;  ///< relative to the likeliest step (transition.h)
    AxisUse distance = AxisUse::kGaussian;
    AxisUse angle = AxisUse::kGaussian;
    double min_distance_deviation_m = 5.0;
    double min_angle_deviation_rad = 0.05;
    Selection selection = Selection::kLikeliest;
    Start start = Start::kLikeliest;
    FirstStep first_step = FirstStep::kLookAhead;
    View view = View::kMutual;
    double clearance_widths = 0.5;  ///< of the street's own width
    OpenEnds open_ends = OpenEnds::kJoined;
    double joint_angle_deviation_rad = 0.5;
    Curves curves = Curves::kTortuous;

    static constexpr auto fields() {
      return std::tuple{
          EnumField{"levels",
                    &Options::levels,
                    {EnumName{"match", Levels::kMatch}, EnumName{"ignored", Levels::kIgnored}},
                    "whether a street goes only to points that know a street of its level"},
          EnumField{
              "connections",
              &Options::connections,
              {EnumName{"four", Connections::kFour}, EnumName{"observed", Connections::kObserved},
               EnumName{"unlimited", Connections::kUnlimited}},
              "of a point: two for each of its streets (the paper), as many as its streets "
              "had in the example, or any number"},
          EnumField{"crossings",
                    &Options::crossings,
                    {EnumName{"forbidden", Crossings::kForbidden},
                     EnumName{"noded", Crossings::kNoded}, EnumName{"tee", Crossings::kTee}},
                    "of grown streets: none (the paper), a new point where they cross, or the step "
                    "ends there"},
          Field{"threshold", &Options::threshold, 1e-9, 1.0,
                "steps whose probability, relative to that of the likeliest, is below this are not "
                "taken"},
          EnumField{
              "distance",
              &Options::distance,
              {EnumName{"gaussian", AxisUse::kGaussian}, EnumName{"ignored", AxisUse::kIgnored}},
              "whether some of the distances within reach are likelier than others"},
          EnumField{
              "angle",
              &Options::angle,
              {EnumName{"gaussian", AxisUse::kGaussian}, EnumName{"ignored", AxisUse::kIgnored}},
              "whether some turns are likelier than others"},
          Field{"min_distance_deviation_m", &Options::min_distance_deviation_m, 0.0, 1000.0,
                "a street's deviation of distances counts as no less than this"},
          Field{"min_angle_deviation_rad", &Options::min_angle_deviation_rad, 0.0, 3.15,
                "a street's deviation of angles counts as no less than this"},
          EnumField{"selection",
                    &Options::selection,
                    {EnumName{"likeliest", Selection::kLikeliest},
                     EnumName{"sampled", Selection::kSampled}},
                    "of the target: the likeliest (the paper's pseudocode), or drawn by "
                    "probability (its text)"},
          EnumField{"start",
                    &Options::start,
                    {EnumName{"random", Start::kRandom}, EnumName{"likeliest", Start::kLikeliest}},
                    "of walks within a level: one after the other from random points, or all at "
                    "once, the step that is most certain first"},
          EnumField{
              "first_step",
              &Options::first_step,
              {EnumName{"blind", FirstStep::kBlind}, EnumName{"look_ahead", FirstStep::kLookAhead}},
              "of a street, which has no angle yet: by distance alone, or also by how well "
              "the street goes on to the other side"},
          EnumField{"view",
                    &Options::view,
                    {EnumName{"base", View::kBase}, EnumName{"mutual", View::kMutual}},
                    "whose attributes a step must fit: its base point's (the paper), or also its "
                    "target's, seen backwards"},
          Field{"clearance_widths", &Options::clearance_widths, 0.0, 10.0,
                "a street passes no point nearer than this share of its width; 0: through none "
                "exactly (the paper)"},
          EnumField{
              "open_ends",
              &Options::open_ends,
              {EnumName{"joined", OpenEnds::kJoined}, EnumName{"by_level", OpenEnds::kByLevel}},
              "of the existing network that no walk came to: joined to free points near them "
              "whatever their level, or left open"},
          Field{"joint_angle_deviation_rad", &Options::joint_angle_deviation_rad, 0.01, 3.15,
                "deviation of the turns where an open end is joined"},
          EnumField{
              "curves",
              &Options::curves,
              {EnumName{"tortuous", Curves::kTortuous}, EnumName{"straight", Curves::kStraight}},
              "whether segments are as tortuous as their points say, or straight"}};
    }
  };

  explicit RandomWalkGrower(const Options& options) : options_(options) {}

  [[nodiscard]] Expected<Growth> grow(const GrowthSite& site, Rng& rng) const;
  [[nodiscard]] const Options& options() const { return options_; }

 private:
  Options options_;
};
static_assert(StreetGrower<RandomWalkGrower> && Registrable<RandomWalkGrower>);

}  // namespace plat::streets
