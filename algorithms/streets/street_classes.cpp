#include "streets/street_classes.h"

#include <algorithm>
#include <array>

namespace plat::streets {
namespace {

struct Row {
  std::string_view name;
  ClassRule rule;
};

// Sorted by name. Service roads, tracks and all that is for feet, bicycles or rails run inside
// blocks; so do pedestrian streets in most cities, but they have plots on both sides and divide.
constexpr std::array kTable{
    Row{"aerialway", {2.0, false}},
    Row{"bridleway", {3.0, false}},
    Row{"construction", {8.0, false}},
    Row{"corridor", {3.0, false}},
    Row{"cycleway", {3.0, false}},
    Row{"elevator", {2.0, false}},
    Row{"ferry", {2.0, false}},
    Row{"footway", {3.0, false}},
    Row{"golf", {3.0, false}},
    Row{"level_crossing", {3.0, false}},
    Row{"link", {9.0, true}},
    Row{"living_street", {9.0, true}},
    Row{"local", {12.0, true}},
    Row{"main", {20.0, true}},
    Row{"major_1", {22.0, true}},
    Row{"major_2", {16.0, true}},
    Row{"major_rail", {12.0, false}},
    Row{"minor_rail", {8.0, false}},
    Row{"motorway", {32.0, true}},
    Row{"motorway_link", {10.0, true}},
    Row{"path", {3.0, false}},
    Row{"pedestrian", {9.0, true}},
    Row{"platform", {3.0, false}},
    Row{"primary", {22.0, true}},
    Row{"primary_link", {10.0, true}},
    Row{"proposed", {8.0, false}},
    Row{"raceway", {10.0, false}},
    Row{"rail", {12.0, false}},
    Row{"residential", {12.0, true}},
    Row{"road", {12.0, true}},
    Row{"secondary", {18.0, true}},
    Row{"secondary_link", {9.0, true}},
    Row{"service", {6.0, false}},
    Row{"service_rail", {8.0, false}},
    Row{"steps", {3.0, false}},
    Row{"street", {12.0, true}},
    Row{"street_limited", {9.0, true}},
    Row{"tertiary", {15.0, true}},
    Row{"tertiary_link", {9.0, true}},
    Row{"track", {4.0, false}},
    Row{"trunk", {28.0, true}},
    Row{"trunk_link", {10.0, true}},
    Row{"turning_circle", {12.0, false}},
    Row{"turning_loop", {12.0, false}},
    Row{"unclassified", {10.0, true}},
};
static_assert(std::ranges::is_sorted(kTable, {}, &Row::name));

}  // namespace

std::optional<ClassRule> class_rule(std::string_view street_class) {
  const auto* it = std::ranges::lower_bound(kTable, street_class, {}, &Row::name);
  if (it == kTable.end() || it->name != street_class) return std::nullopt;
  return it->rule;
}

bool bounds_blocks(std::string_view street_class, BoundingClasses classes) {
  if (classes == BoundingClasses::kAll) return true;
  const auto rule = class_rule(street_class);
  return !rule || rule->bounds_blocks;
}

}  // namespace plat::streets
