#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "buildings/part_kits.h"
#include "buildings/problem_resources_internal.h"
#include "core/failure.h"

namespace plat::buildings {
namespace {

using detail::amount_of;
using detail::kLength;
using sequences::Amount;
using sequences::Bounds;
using sequences::Element;
using sequences::ElementIndex;
using SequencePort = sequences::Port;
using Kind = SkeletonKeyPoint::Kind;

SequencePort sequence_port(PortRole role) {
  switch (role) {
    case PortRole::kLeft:
    case PortRole::kBottom:
      return SequencePort::kLeft;
    case PortRole::kRight:
    case PortRole::kTop:
      return SequencePort::kRight;
    case PortRole::kStem:
      return SequencePort::kStem;
  }
  throw LogicError("unknown port role");
}

bool is_corner_for(const Part& part, double turn_rad, double tolerance_rad) {
  return part.shape.part_class == PartClass::kCorner &&
         std::abs(part.shape.angle_rad - turn_rad) <= tolerance_rad;
}

/// Whether the part may stand at the key point. Corners: within `tolerance_rad` of the turn.
bool suits(const Part& part, const SkeletonKeyPoint& key, double tolerance_rad) {
  switch (key.kind) {
    case Kind::kLeftEnd:
      return part.shape.part_class == PartClass::kLeftEnd;
    case Kind::kRightEnd:
      return part.shape.part_class == PartClass::kRightEnd;
    case Kind::kCorner:
      return is_corner_for(part, key.turn_rad, tolerance_rad);
    case Kind::kTee:
      return part.shape.part_class == PartClass::kTee && part.shape.stem_side == key.stem_side;
    case Kind::kCut:
      return false;
  }
  throw LogicError("unknown kind of key point");
}

/// Parts made for just this turn go before those that would have to be bent.
double tolerance_for(const PartDatabase& database, const SkeletonKeyPoint& key) {
  const bool has_exact = std::ranges::any_of(
      database.parts(), [&](const Part& part) { return suits(part, key, kExactTurn_rad); });
  return has_exact ? kExactTurn_rad : kAngleTolerance_rad;
}

std::string what_is_missing(const PartDatabase& database, const SkeletonKeyPoint& key) {
  switch (key.kind) {
    case Kind::kLeftEnd:
      return "no left end";
    case Kind::kRightEnd:
      return "no right end";
    case Kind::kTee:
      return fmt::format("no tee with its stem at the {}", name_of(key.stem_side));
    default:
      break;
  }
  std::set<std::string> turns;
  for (const Part& part : database.parts()) {
    if (part.shape.part_class == PartClass::kCorner)
      turns.insert(fmt::format("{:.1f}", part.shape.angle_rad * 180.0 / std::numbers::pi));
  }
  return fmt::format("no corner of {:.1f} degrees; there are: {}",
                     key.turn_rad * 180.0 / std::numbers::pi,
                     turns.empty() ? "none" : fmt::format("{}", fmt::join(turns, ", ")));
}

/// Elements, transitions and structure of a skeleton; one skeleton, one use.
class SkeletonTranslation {
 public:
  SkeletonTranslation(const BuildingSkeleton& skeleton, const SkeletonPlan& plan,
                      const PartDatabase& database, const AttributeSteps& steps,
                      const Preferences& preferences)
      : skeleton_(skeleton),
        plan_(plan),
        database_(database),
        resources_(database, steps),
        extra_(preferences) {}

  BuildingProblem translate() {
    resources_.index_of(kLength);
    resources_.add_all(skeleton_.bounds);
    for (const SkeletonRow& row : plan_.rows) resources_.add_all(row.bounds);
    choose_parts();
    add_elements();
    add_transitions();
    add_structure();
    out_.problem.database.resources = resources_.all();
    out_.problem.database.cost_step = kCostStep_m2;
    out_.problem.bounds = resources_.bounds_of(skeleton_.bounds);
    return std::move(out_);
  }

 private:
  void choose_parts() {
    std::set<std::size_t> chosen;
    allowed_.resize(plan_.key_points.size());
    for (std::size_t k = 0; k < plan_.key_points.size(); ++k) {
      const SkeletonKeyPoint& key = plan_.key_points[k];
      if (key.kind == Kind::kCut) continue;
      const double tolerance = tolerance_for(database_, key);
      for (std::size_t p = 0; p < database_.parts().size(); ++p) {
        if (suits(database_.parts()[p], key, tolerance)) allowed_[k].push_back(p);
      }
      if (allowed_[k].empty()) {
        const Point at = skeleton_.nodes[key.node];
        throw InputError(fmt::format("node {} at ({:.1f}, {:.1f}): \"{}\" has {}", key.node, at.x,
                                     at.y, database_.info().name, what_is_missing(database_, key)));
      }
      chosen.insert(allowed_[k].begin(), allowed_[k].end());
    }
    for (std::size_t p = 0; p < database_.parts().size(); ++p) {
      if (database_.parts()[p].shape.part_class == PartClass::kMiddle) chosen.insert(p);
    }
    for (const std::size_t part : chosen) {
      element_of_[part] = static_cast<ElementIndex>(out_.parts.size());
      out_.parts.emplace_back(part);
    }
  }

  [[nodiscard]] std::vector<std::vector<Amount>> arms_of(const Part& part) const {
    std::vector<std::vector<Amount>> arms(sequences::kPortCount,
                                          std::vector<Amount>(resources_.all().size(), 0));
    for (const Port& port : part.ports) {
      arms[static_cast<std::size_t>(sequence_port(port.role))][0] =
          amount_of(port.arm_m, kLengthQuantum_m);
    }
    return arms;
  }

  void add_elements() {
    auto& elements = out_.problem.database.elements;
    for (const auto& [index, element] : element_of_) {
      const Part& part = database_.parts()[index];
      const bool is_filling = part.shape.part_class == PartClass::kMiddle;
      elements.push_back({part.name,
                          {std::string(name_of(part.shape.part_class))},
                          resources_.uses_of(part),
                          is_filling ? std::vector<std::vector<Amount>>{} : arms_of(part),
                          is_filling,
                          is_filling,
                          is_filling});
    }
    if (std::ranges::none_of(plan_.key_points, [](auto& key) { return key.kind == Kind::kCut; }))
      return;
    std::set<std::size_t> sections;
    for (const auto& [index, element] : element_of_) {
      if (const auto port = find_port(database_.parts()[index], PortRole::kRight))
        sections.insert(database_.section_of({index, *port}));
    }
    for (const std::size_t section : sections) {
      cut_of_[section] = static_cast<ElementIndex>(elements.size());
      elements.push_back({fmt::format("cut_{}", section),
                          {"cut"},
                          std::vector<Amount>(resources_.all().size(), 0),
                          {},
                          false,
                          false,
                          false});
      out_.parts.emplace_back(std::nullopt);
    }
  }

  /// The transition from a port that is left to one that is entered, where the parts may meet.
  void add_transition(std::size_t from, PortRole from_role, std::size_t to, PortRole to_role) {
    const auto left = find_port(database_.parts()[from], from_role);
    const auto entered = find_port(database_.parts()[to], to_role);
    if (!left || !entered) return;
    // A stem that is entered has its section as seen by who comes out.
    const Facing facing = to_role == PortRole::kStem ? Facing::kMirrored : Facing::kSame;
    if (!database_.may_meet({from, *left}, {to, *entered}, facing)) return;
    out_.problem.database.transitions.push_back(
        {element_of_.at(from),
         element_of_.at(to),
         sequence_port(from_role),
         sequence_port(to_role),
         database_.cost({from, *left}, {to, *entered}, facing) +
             extra_.between(database_.parts()[from].name, database_.parts()[to].name),
         {}});
  }

  /// From a part to the cut of its own section, at no cost; from a cut to whatever its section may
  /// meet.
  void add_cut_transitions(std::size_t part) {
    auto& transitions = out_.problem.database.transitions;
    for (const PortRole role : {PortRole::kRight, PortRole::kStem}) {
      const auto port = find_port(database_.parts()[part], role);
      if (!port) continue;
      const auto cut = cut_of_.find(database_.section_of({part, *port}));
      if (cut == cut_of_.end()) continue;
      transitions.push_back(
          {element_of_.at(part), cut->second, sequence_port(role), SequencePort::kLeft, 0, {}});
    }
    for (const PortRole role : {PortRole::kLeft, PortRole::kStem}) {
      const auto port = find_port(database_.parts()[part], role);
      if (!port) continue;
      const Facing facing = role == PortRole::kStem ? Facing::kMirrored : Facing::kSame;
      for (const auto& [section, cut] : cut_of_) {
        const std::int64_t cost =
            database_.transitions().cost(section, database_.section_of({part, *port}), facing);
        const auto limit = database_.info().transition_limit_m2;
        if (limit && static_cast<double>(cost) * kCostStep_m2 > *limit) continue;
        transitions.push_back(
            {cut, element_of_.at(part), SequencePort::kRight, sequence_port(role), cost, {}});
      }
    }
  }

  void add_transitions() {
    for (const auto& [from, from_element] : element_of_) {
      for (const auto& [to, to_element] : element_of_) {
        add_transition(from, PortRole::kRight, to, PortRole::kLeft);
        add_transition(from, PortRole::kStem, to, PortRole::kLeft);
        add_transition(from, PortRole::kRight, to, PortRole::kStem);
        add_transition(from, PortRole::kStem, to, PortRole::kStem);
      }
      add_cut_transitions(from);
    }
  }

  void add_structure() {
    auto& structure = out_.problem.structure;
    for (std::size_t k = 0; k < plan_.key_points.size(); ++k) {
      std::vector<ElementIndex> allowed;
      for (const std::size_t part : allowed_[k]) allowed.push_back(element_of_.at(part));
      if (plan_.key_points[k].kind == Kind::kCut) {
        for (const auto& [section, cut] : cut_of_) allowed.push_back(cut);
      }
      structure.key_points.push_back(
          {fmt::format("node {}", plan_.key_points[k].node), std::move(allowed)});
    }
    for (const SkeletonRow& row : plan_.rows) {
      std::vector<Bounds> bounds = resources_.bounds_of(row.bounds);
      const Amount quanta = amount_of(length_m(row), kLengthQuantum_m);
      bounds[0] = {quanta, quanta};
      structure.segments.push_back({fmt::format("edge {}", row.edges.front()), row.from, row.to,
                                    sequence_port(row.from_port), sequence_port(row.to_port), false,
                                    std::move(bounds), true});
    }
  }

  const BuildingSkeleton& skeleton_;
  const SkeletonPlan& plan_;
  const PartDatabase& database_;
  detail::Resources resources_;
  detail::ExtraCost extra_;
  BuildingProblem out_;
  std::vector<std::vector<std::size_t>> allowed_;   ///< by key point: parts
  std::map<std::size_t, ElementIndex> element_of_;  ///< by part
  std::map<std::size_t, ElementIndex> cut_of_;      ///< by section
};

}  // namespace

RowRounding rounding(const SkeletonRow& row) {
  const double length = length_m(row);
  const double quantised = kLengthQuantum_m * std::round(length / kLengthQuantum_m);
  return {length, quantised, length / quantised};
}

PartDatabase with_corners(const PartDatabase& database, const SkeletonPlan& plan) {
  if (!database.info().kit) return database;
  std::vector<Part> more;
  std::vector<double> made;
  for (const SkeletonKeyPoint& key : plan.key_points) {
    if (key.kind != Kind::kCorner) continue;
    const auto is_near = [&](double turn) {
      return std::abs(turn - key.turn_rad) <= kExactTurn_rad;
    };
    if (std::ranges::any_of(made, is_near)) continue;
    if (std::ranges::any_of(database.parts(), [&](const Part& part) {
          return is_corner_for(part, key.turn_rad, kExactTurn_rad);
        }))
      continue;
    made.push_back(key.turn_rad);
    std::ranges::move(make_corner_parts(*database.info().kit, key.turn_rad),
                      std::back_inserter(more));
  }
  return more.empty() ? database : with_parts(database, std::move(more));
}

BuildingProblem skeleton_problem(const BuildingSkeleton& skeleton, const SkeletonPlan& plan,
                                 const PartDatabase& database, const AttributeSteps& steps,
                                 const Preferences& preferences) {
  return SkeletonTranslation(skeleton, plan, database, steps, preferences).translate();
}

}  // namespace plat::buildings
