#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "buildings/part_database.h"
#include "buildings/row_builder_internal.h"

/// From a style to a kit: which parts there are of every section family.
namespace plat::buildings::detail {

/// A middle part: its length and what it has.
struct MiddlePlan {
  double length_m = 0.0;
  Features features;
  std::string suffix;  ///< of its name, behind the length
};

struct KitPlan {
  std::string_view name;
  std::string_view summary;
  RowStyle style;
  std::vector<MiddlePlan> middles;  ///< of every family
  /// Lengths of ends, in each family once per entry.
  std::vector<MiddlePlan> ends;
  std::vector<double> corner_angles_deg;  ///< both turns are made of each
  std::vector<double> tee_margins_m;      ///< arms beyond the wing's own width
};

KitPlan townhouse_plan();
KitPlan palazzo_plan();

/// The parts of every family, and between every two families one part each way.
std::vector<Part> make_rows(const KitPlan& plan);

/// Corners of every family for one angle.
std::vector<Part> make_row_corners(const KitPlan& plan, double angle_rad);

/// Stacked floors for skyscrapers.
PartDatabase make_tower_kit();

/// The next multiple of the length quantum that is not below `length_m`.
double up_to_quantum(double length_m);

}  // namespace plat::buildings::detail
