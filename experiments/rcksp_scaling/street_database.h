#pragma once

#include <array>
#include <cstdint>
#include <tuple>
#include <vector>

#include "core/options.h"
#include "sequences/sequence_problem.h"

namespace plat::rcksp {

/// The quantum of lengths [Har, Sec. 6.2].
inline constexpr double kLengthStep_m = 0.2;
/// The quantum of transition costs.
inline constexpr double kCostStep_m2 = 0.01;
/// Resources that a building may consume: its length, and up to three more.
inline constexpr std::size_t kMostResources = 4;

/// One cell's problem and how many of its best sequences are asked for.
struct CellOptions {
  int elements = 74;                ///< buildings in the database
  int resources = 1;                ///< length, then doors, balconies and solar panels
  double density_01 = 1.0;          ///< share of ordered pairs of buildings that may be neighbours
  double zero_cost_share_01 = 0.0;  ///< share of those that cost nothing
  double cost_spread_01 = 1.0;      ///< 1: cross sections decide; 0: all transitions cost the same
  double length_m = 200.0;          ///< of the street
  double length_slack_m = 0.0;      ///< by which the street may be shorter
  int k = 1;                        ///< sequences asked for
  static constexpr auto fields() {
    return std::tuple{
        Field{"elements", &CellOptions::elements, 2, 2000, "Buildings in the database"},
        Field{"resources", &CellOptions::resources, 1, 4,
              "Resources that are bounded: length, doors, balconies, solar panels"},
        Field{"density_01", &CellOptions::density_01, 0, 1,
              "Share of ordered pairs of distinct buildings that may be neighbours"},
        Field{"zero_cost_share_01", &CellOptions::zero_cost_share_01, 0, 1,
              "Share of the transitions that cost nothing"},
        Field{"cost_spread_01", &CellOptions::cost_spread_01, 0, 1,
              "0: every transition costs the mean; 1: the disagreement of cross sections"},
        Field{"length_m", &CellOptions::length_m, 1, 100000, "Length of the street"},
        Field{"length_slack_m", &CellOptions::length_slack_m, 0, 100000,
              "By how much the street may be shorter"},
        Field{"k", &CellOptions::k, 1, 10000000, "Sequences asked for"}};
  }
};

/// A complete building of a street, with a cuboid's cross section.
struct Building {
  sequences::Amount length = 0;  ///< in quanta of kLengthStep_m
  double height_m = 0.0;
  double depth_m = 0.0;
  std::array<sequences::Amount, kMostResources - 1> others{};  ///< doors, balconies, solar panels
};

/// A synthetic database of complete buildings, in place of the thesis's, which is not public.
struct StreetDatabase {
  std::vector<Building> buildings;
  sequences::SequenceDatabase database;
};

/// Makes up a database of the size of the thesis's: 74 buildings and 5,402 transitions, every
/// ordered pair of distinct ones.
///
/// Lengths are spread evenly over 5 to 19 m, the only property that node counts depend on: with
/// these, a street of 2000 m has 732,008 feasible (building, level) pairs, the thesis's 732 K.
/// Costs are the areas on which two cross sections disagree [Har, Eq. 6.1].
///
/// Guarantees: 1. the same options and seed give the same database;  2. a building has the same
/// cross section however many others there are;  3. the transitions of a smaller density, and the
/// free ones of a smaller share, are among those of a larger one.
StreetDatabase street_database(const CellOptions& options, std::uint64_t seed);

/// A street of the cell's length over `street`: an interval of lengths up to it, and of every other
/// resource exactly what buildings of mean use consume over the length.
sequences::SequenceProblem street_problem(const StreetDatabase& street, const CellOptions& options);

}  // namespace plat::rcksp
