#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "buildings/building_skeleton.h"
#include "buildings/part_database.h"
#include "buildings/skeleton_plan.h"
#include "sequences/sequence_problem.h"

namespace plat::buildings {

/// Steps of attributes, by name: amounts are rounded to whole multiples [Har, Sec. 3.3.1].
using AttributeSteps = std::map<std::string, double>;

/// What a designer prefers among parts that fit equally well, added to every transition.
struct Preferences {
  /// What one more part costs: by default a step of costs, so that of buildings whose sections
  /// disagree equally, that of fewest parts is the best.
  double part_m2 = kCostStep_m2;
  /// Every pair of parts costs up to so much more, by a random number of its own. Kits have
  /// sections that agree exactly, so that without it most buildings are equally good.
  double variety_m2 = 0.0;
  std::uint64_t seed = 0;  ///< of the random numbers

  friend bool operator==(const Preferences&, const Preferences&) = default;
};

/// The step where none is given: 0.2 for names that end in "_m", else 1 ("_m2" and counts).
double step_of(const AttributeSteps& steps, const std::string& attribute);

/// A building as a problem of sequences, with what its elements are.
struct BuildingProblem {
  sequences::SequenceProblem problem;
  /// By element: the part, as an index into the database; nothing at a cut, an element without
  /// length that stands where two parts meet.
  std::vector<std::optional<std::size_t>> parts;
};

/// How far the quantum is from a row: its parts are stretched by `factor` to fill it.
struct RowRounding {
  double length_m = 0.0;     ///< on the skeleton
  double quantised_m = 0.0;  ///< what its parts add up to
  double factor = 1.0;       ///< length_m / quantised_m
};
RowRounding rounding(const SkeletonRow& row);

/// The database with corner parts for every turn of the plan that none of its own makes within
/// kExactTurn_rad, where it is a kit that can make them (make_corner_parts).
PartDatabase with_corners(const PartDatabase& database, const SkeletonPlan& plan);

/// Below this no corner is made anew: the bend moves a vertex 10 m from the axis by 1 mm.
inline constexpr double kExactTurn_rad = 1e-4;

/// The problem of filling a skeleton with parts: resource 0 is the length, an equality on every
/// row; the arms of the part at a key point count towards the rows that they face. A cut is an
/// element per cross section that may follow only parts of just that section, so that two parts
/// meet across it at their own cost.
///
/// Guarantees: 1. the solutions are one to one the sequences of parts that fill the skeleton, at
/// the sum of the areas by which neighbours disagree [Har, Eq. 6.1], in steps of kCostStep_m2.
/// @throws InputError where a key point has no part (with the angles that there are), a bound
///         names an attribute that no part has, or max < min
/// Paper:     [Har, Sec. 6.3]
/// Deviation: an edge's length is rounded to the quantum, and its parts are stretched to fill it
///            (ADR 0022); preferences, which are 0 there
BuildingProblem skeleton_problem(const BuildingSkeleton& skeleton, const SkeletonPlan& plan,
                                 const PartDatabase& database, const AttributeSteps& steps = {},
                                 const Preferences& preferences = {});

/// A tower of floors [Har, Fig. 6.5].
struct TowerDesign {
  double height_m = 120.0;
  double ground_area_m2 = 0.0;  ///< floor areas are told as multiples of this
  double floor_area_ratio = 10.0;
  std::vector<AttributeBound> bounds;

  friend bool operator==(const TowerDesign&, const TowerDesign&) = default;
};

/// The problem of stacking floors: height and floor area as two equalities. Floors with "podiums"
/// stand on the ground and nowhere else, those with "crowns" at the top; where a database has such,
/// every tower has one.
/// @throws InputError where the database has no floors, or a bound names an attribute none has
/// Paper: [Har, Sec. 6.3, Fig. 6.5]
BuildingProblem tower_problem(const TowerDesign& tower, const PartDatabase& database,
                              const AttributeSteps& steps = {},
                              const Preferences& preferences = {});

}  // namespace plat::buildings
