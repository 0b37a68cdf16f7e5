#include <cstdlib>
#include <set>

#include "sequences/json_object_internal.h"
#include "sequences/problem_file.h"

namespace plat::sequences {
namespace {

using detail::kPortNames;
using Json = nlohmann::ordered_json;

/// The decimal fraction that a whole number of steps was written as: 3 x 0.2 is 0.6.
Json value_of(std::int64_t steps, double step) {
  const std::string text = fmt::format("{:.15g}", static_cast<double>(steps) * step);
  const double value = std::strtod(text.c_str(), nullptr);
  const auto whole = static_cast<std::int64_t>(value);
  return static_cast<double>(whole) == value ? Json(whole) : Json(value);
}

template <class Named>
void expect_different_names(const std::vector<Named>& all, std::string_view what) {
  std::set<std::string> seen;
  for (const auto& each : all)
    if (!seen.insert(each.name).second)
      throw InputError(fmt::format("two {}s are called \"{}\"", what, each.name));
}

class ProblemWriter {
 public:
  explicit ProblemWriter(const SequenceProblem& problem)
      : problem_(problem), database_(problem.database) {}

  Json write() {
    Json out;
    for (const Resource& resource : database_.resources)
      out["resources"].push_back({{"name", resource.name}, {"step", resource.step}});
    out["cost_step"] = database_.cost_step;
    for (const Element& element : database_.elements) out["elements"].push_back(of(element));
    for (const Transition& each : database_.transitions) out["transitions"].push_back(of(each));
    if (const Json bounds = of(problem_.bounds); !bounds.empty()) out["bounds"] = bounds;
    for (const KeyPoint& point : problem_.structure.key_points)
      out["key_points"].push_back(of(point));
    for (const Segment& segment : problem_.structure.segments)
      out["segments"].push_back(of(segment));
    return out;
  }

 private:
  [[nodiscard]] Json uses(const std::vector<Amount>& amounts) const {
    Json out = Json::object();
    for (std::size_t r = 0; r < amounts.size(); ++r)
      if (amounts[r] != 0)
        out[database_.resources[r].name] = value_of(amounts[r], database_.resources[r].step);
    return out;
  }
  [[nodiscard]] Json of(const std::vector<Bounds>& bounds) const {
    Json out = Json::object();
    for (std::size_t r = 0; r < bounds.size(); ++r) {
      const double step = database_.resources[r].step;
      Json& written = out[database_.resources[r].name];
      const Json min = value_of(bounds[r].min, step);
      if (bounds[r] == Bounds{})
        out.erase(database_.resources[r].name);
      else if (bounds[r].max == kUnbounded)
        written = {min, nullptr};
      else if (bounds[r].min == bounds[r].max)
        written = min;
      else
        written = {min, value_of(bounds[r].max, step)};
    }
    return out;
  }
  [[nodiscard]] Json of(const Element& element) const {
    Json out{{"name", element.name}};
    if (!element.classes.empty()) out["classes"] = element.classes;
    if (const Json amounts = uses(element.uses); !amounts.empty()) out["uses"] = amounts;
    for (std::size_t p = 0; p < element.arms.size(); ++p)
      out["arms"][std::string(kPortNames[p])] = uses(element.arms[p]);
    if (!element.is_filling) out["filling"] = false;
    if (!element.is_front) out["front"] = false;
    if (!element.is_back) out["back"] = false;
    return out;
  }
  [[nodiscard]] Json of(const Transition& transition) const {
    Json out{{"from", database_.elements[transition.from].name},
             {"to", database_.elements[transition.to].name},
             {"cost", value_of(transition.cost, database_.cost_step)}};
    if (transition.from_port != Port::kRight) out["from_port"] = name(transition.from_port);
    if (transition.to_port != Port::kLeft) out["to_port"] = name(transition.to_port);
    if (const Json amounts = uses(transition.uses); !amounts.empty()) out["uses"] = amounts;
    return out;
  }
  [[nodiscard]] Json of(const KeyPoint& point) const {
    Json out{{"name", point.name}};
    for (const ElementIndex e : point.allowed)
      out["elements"].push_back(database_.elements[e].name);
    return out;
  }
  [[nodiscard]] Json of(const Segment& segment) const {
    const auto& points = problem_.structure.key_points;
    Json out = Json::object();
    if (!segment.name.empty()) out["name"] = segment.name;
    if (segment.from) out["from"] = points[*segment.from].name;
    if (segment.to) out["to"] = points[*segment.to].name;
    if (segment.from_port != Port::kRight) out["from_port"] = name(segment.from_port);
    if (segment.to_port != Port::kLeft) out["to_port"] = name(segment.to_port);
    if (segment.is_reversed) out["reversed"] = true;
    if (const Json bounds = of(segment.bounds); !bounds.empty()) out["bounds"] = bounds;
    if (!segment.may_be_empty) out["may_be_empty"] = false;
    return out;
  }
  static std::string name(Port port) {
    return std::string(kPortNames[static_cast<std::size_t>(port)]);
  }

  const SequenceProblem& problem_;
  const SequenceDatabase& database_;
};

}  // namespace

std::string problem_json(const SequenceProblem& problem) {
  expect_different_names(problem.database.resources, "resource");
  expect_different_names(problem.database.elements, "element");
  expect_different_names(problem.structure.key_points, "key point");
  return ProblemWriter(problem).write().dump(1) + "\n";
}

}  // namespace plat::sequences
