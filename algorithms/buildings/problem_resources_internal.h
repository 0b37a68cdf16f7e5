#pragma once

#include <string>
#include <vector>

#include "buildings/building_problem.h"

/// What problems of skeletons and of towers share.
namespace plat::buildings::detail {

inline constexpr const char* kLength = "length_m";

sequences::Amount amount_of(double value, double step);

/// The resources of a problem and what elements and bounds come to in them.
class Resources {
 public:
  Resources(const PartDatabase& database, const AttributeSteps& steps)
      : database_(database), steps_(steps) {}

  /// The index of an attribute, which is appended where it is new.
  /// @throws InputError where no part has it
  std::size_t index_of(const std::string& attribute);
  void add_all(const std::vector<AttributeBound>& bounds);

  /// By resource, unbounded where nothing is said. Pre: every attribute was added.
  /// @throws InputError where bounds hold no multiple of the step, or contradict each other
  std::vector<sequences::Bounds> bounds_of(const std::vector<AttributeBound>& bounds);
  [[nodiscard]] std::vector<sequences::Amount> uses_of(const Part& part) const;
  [[nodiscard]] const std::vector<sequences::Resource>& all() const { return resources_; }

 private:
  [[nodiscard]] std::string known_attributes() const;

  const PartDatabase& database_;
  const AttributeSteps& steps_;
  std::vector<sequences::Resource> resources_;
};

/// What preferences add to a transition, in steps of kCostStep_m2.
class ExtraCost {
 public:
  explicit ExtraCost(const Preferences& preferences) : preferences_(preferences) {}
  [[nodiscard]] sequences::Cost between(const std::string& from, const std::string& to) const;

 private:
  Preferences preferences_;
};

}  // namespace plat::buildings::detail
