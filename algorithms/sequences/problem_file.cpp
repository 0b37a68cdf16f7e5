#include "sequences/problem_file.h"

#include <cmath>
#include <fstream>
#include <iterator>
#include <set>

#include "sequences/json_object_internal.h"
#include "sequences/or_library.h"
#include "sequences/quantisation.h"

namespace plat::sequences {
namespace {

using detail::JsonObject;
using detail::kPortNames;
using detail::NameIndex;
using nlohmann::json;

/// Amounts and costs above this many steps are refused: sums over any path still fit.
constexpr std::int64_t kMostSteps = 1'000'000'000;

/// Turns the values of one quantity into whole steps.
class Quantity {
 public:
  Quantity(std::string name, double step, bool rounds)
      : name_(std::move(name)), step_(step), rounds_(rounds) {}

  [[nodiscard]] double step() const { return step_; }
  std::int64_t steps(const json& value, const std::string& where) {
    if (!value.is_number()) throw InputError(fmt::format("{}: {} must be a number", where, name_));
    const auto number = value.get<double>();
    if (!(number >= 0.0 && number <= static_cast<double>(kMostSteps) * step_))
      throw InputError(fmt::format("{}: {} = {}, allowed 0..{} (10^9 steps of {})", where, name_,
                                   number, static_cast<double>(kMostSteps) * step_, step_));
    const Quantised found = quantised(number, step_);
    if (!found.is_multiple() && !rounds_)
      throw InputError(fmt::format(
          "{}: {} = {} is no whole multiple of its step {}, the nearest is {:.12g}; give another "
          "step, or \"round\": true",
          where, name_, number, step_, static_cast<double>(found.steps) * step_));
    if (!found.is_multiple()) {
      ++rounded_;
      largest_error_ = std::max(largest_error_, found.error * step_);
    }
    return found.steps;
  }
  void tell(std::vector<std::string>& notes) const {
    if (rounded_ > 0)
      notes.push_back(fmt::format("{}: {} values rounded to multiples of {}, by {:.6g} at most",
                                  name_, rounded_, step_, largest_error_));
    if (narrowed_ > 0)
      notes.push_back(fmt::format("{}: {} ends of intervals moved inwards to multiples of {}",
                                  name_, narrowed_, step_));
  }
  /// A number is an equality, [min, max] an interval with null for an open end, null no bound. An
  /// interval is narrowed to the whole steps in it.
  Bounds bounds(const json& value, const std::string& where) {
    if (value.is_null()) return {};
    if (value.is_number()) {
      const auto amount = static_cast<Amount>(steps(value, where));
      return {amount, amount};
    }
    if (!value.is_array() || value.size() != 2)
      throw InputError(fmt::format("{}: {} must be a number, [min, max] or null", where, name_));
    Bounds out;
    if (!value[0].is_null())
      out.min = end_of_interval(value[0], where, [](double s) { return std::ceil(s); });
    if (!value[1].is_null())
      out.max = end_of_interval(value[1], where, [](double s) { return std::floor(s); });
    if (out.min > out.max)
      throw InputError(fmt::format("{}: {} = [{}, {}] holds no multiple of the step {}", where,
                                   name_, value[0].dump(), value[1].dump(), step_));
    return out;
  }

 private:
  template <class Inward>
  Amount end_of_interval(const json& value, const std::string& where, Inward inward) {
    if (!value.is_number())
      throw InputError(fmt::format("{}: {}: the ends must be numbers or null", where, name_));
    const auto number = value.get<double>();
    if (!(number >= 0.0 && number <= static_cast<double>(kMostSteps) * step_))
      throw InputError(fmt::format("{}: {} = {}, allowed 0..{}", where, name_, number,
                                   static_cast<double>(kMostSteps) * step_));
    const Quantised nearest = quantised(number, step_);
    if (nearest.is_multiple()) return static_cast<Amount>(nearest.steps);
    ++narrowed_;
    return static_cast<Amount>(inward(number / step_));
  }

  std::string name_;
  double step_;
  bool rounds_;
  std::size_t rounded_ = 0;
  std::size_t narrowed_ = 0;
  double largest_error_ = 0.0;
};

/// Every number under `key` of an object in the list, whatever else is there.
void collect_uses(const json& list, std::string_view key, const std::string& resource,
                  std::vector<double>& values) {
  if (!list.is_array()) return;
  for (const json& each : list) {
    if (!each.is_object() || !each.contains(key) || !each[key].is_object()) continue;
    const json& uses = each[key];
    if (uses.contains(resource) && uses[resource].is_number())
      values.push_back(uses[resource].get<double>());
    for (const std::string_view port : kPortNames)
      if (uses.contains(port) && uses[port].is_object() && uses[port].contains(resource) &&
          uses[port][resource].is_number())
        values.push_back(uses[port][resource].get<double>());
  }
}

std::vector<double> all_costs(const json& document) {
  std::vector<double> values;
  const json transitions = document.value("transitions", json::array());
  for (const json& each : transitions)
    if (each.is_object() && each.contains("cost") && each["cost"].is_number())
      values.push_back(each["cost"].get<double>());
  const json matrix = document.value("transition_matrix", json::array());
  for (const json& row : matrix)
    if (row.is_array())
      for (const json& cost : row)
        if (cost.is_number()) values.push_back(cost.get<double>());
  return values;
}

class ProblemReader {
 public:
  ProblemReader(const json& document, const std::string& source)
      : document_(document), source_(source), root_(document, source) {}

  ReadProblem read() {
    static_cast<void>(root_.text("description"));
    read_resources();
    read_cost_step();
    for (const json& each : root_.list("elements")) read_element(each);
    if (database().elements.empty())
      throw InputError(source_ + ": \"elements\" must list at least one");
    for (const json& each : root_.list("transitions")) read_transition(each);
    read_matrix();
    read_.problem.bounds = bounds_of(root_, source_);
    for (const json& each : root_.list("key_points")) read_key_point(each);
    for (const json& each : root_.list("segments")) read_segment(each);
    root_.expect_nothing_else();
    if (read_.problem.structure.segments.empty()) {
      if (key_points_.size() > 0)
        throw InputError(source_ + ": \"key_points\" without \"segments\" that join them");
      read_.problem.structure.segments.emplace_back();
    }
    for (const Quantity& quantity : quantities_) quantity.tell(read_.notes);
    cost_->tell(read_.notes);
    return std::move(read_);
  }

 private:
  SequenceDatabase& database() { return read_.problem.database; }

  double found_step(const std::string& name, const std::vector<double>& values,
                    const std::string& where) {
    const auto step = common_step(values);
    if (!step)
      throw InputError(fmt::format(
          "{}: the values of {} share no step of at most 9 decimals; give one (\"step\")", where,
          name));
    read_.notes.push_back(fmt::format("{}: step {} found, the greatest common divisor of {} values",
                                      name, *step, values.size()));
    return *step;
  }
  double step_of(const json& value, const std::string& where) {
    const double step = value.is_number() ? value.get<double>() : 0.0;
    if (!(step >= 1e-9 && step <= 1e9))
      throw InputError(fmt::format("{}: step = {}, allowed 1e-9..1e9", where, value.dump()));
    return step;
  }

  void read_resources() {
    for (const json& each : root_.list("resources")) {
      const std::string where =
          fmt::format("{}: resource {}", source_, database().resources.size() + 1);
      JsonObject object(each, where);
      const std::string name = object.name();
      resources_.add(name, source_);
      const json* step = object.find("step");
      const bool rounds = object.flag("round", false);
      object.expect_nothing_else();
      std::vector<double> values;
      if (step == nullptr) {
        if (rounds) throw InputError(where + ": \"round\" needs a \"step\" to round to");
        collect_uses(document_.value("elements", json()), "uses", name, values);
        collect_uses(document_.value("elements", json()), "arms", name, values);
        collect_uses(document_.value("transitions", json()), "uses", name, values);
      }
      const double size = step != nullptr ? step_of(*step, where) : found_step(name, values, where);
      database().resources.push_back({name, size});
      quantities_.emplace_back(name, size, rounds);
    }
  }
  void read_cost_step() {
    const json* given = root_.find("cost_step");
    const std::string where = source_ + ": cost_step";
    bool rounds = false;
    double step = 1.0;
    if (given == nullptr) {
      step = found_step("cost", all_costs(document_), where);
    } else if (given->is_object()) {
      JsonObject object(*given, where);
      step = step_of(object.needed("step"), where);
      rounds = object.flag("round", false);
      object.expect_nothing_else();
    } else {
      step = step_of(*given, where);
    }
    database().cost_step = step;
    cost_.emplace("cost", step, rounds);
  }

  std::vector<Amount> amounts_of(const json* uses, const std::string& where) {
    if (uses == nullptr) return {};
    if (!uses->is_object()) throw InputError(where + ": must be an object of amounts by resource");
    std::vector<Amount> out(quantities_.size(), 0);
    for (const auto& [name, value] : uses->items()) {
      const std::uint32_t resource = resources_.at(name, where);
      out[resource] = static_cast<Amount>(quantities_[resource].steps(value, where));
    }
    return out;
  }
  std::vector<Bounds> bounds_of(JsonObject& object, const std::string& owner) {
    std::vector<Bounds> out(quantities_.size());
    const json* bounds = object.find("bounds");
    if (bounds == nullptr) return out;
    const std::string where = owner + ": bounds";
    if (!bounds->is_object()) throw InputError(where + ": must be an object by resource");
    for (const auto& [name, value] : bounds->items()) {
      const std::uint32_t resource = resources_.at(name, where);
      out[resource] = quantities_[resource].bounds(value, where);
    }
    return out;
  }
  std::vector<std::string> texts_of(JsonObject& object, std::string_view key) {
    std::vector<std::string> out;
    for (const json& each : object.list(key)) {
      if (!each.is_string())
        throw InputError(fmt::format("{}: \"{}\" must list texts", object.where(), key));
      out.push_back(each.get<std::string>());
    }
    return out;
  }
  Port port_of(JsonObject& object, std::string_view key, Port fallback) {
    const auto text = object.text(key);
    if (!text) return fallback;
    for (std::size_t p = 0; p < kPortCount; ++p)
      if (kPortNames[p] == *text) return static_cast<Port>(p);
    throw InputError(
        fmt::format("{}: {} = \"{}\", allowed left, right, stem", object.where(), key, *text));
  }

  void read_element(const json& value) {
    JsonObject object(value,
                      fmt::format("{}: element {}", source_, database().elements.size() + 1));
    Element element{.name = object.name()};
    const std::string where = fmt::format("{}: element \"{}\"", source_, element.name);
    elements_.add(element.name, source_);
    element.classes = texts_of(object, "classes");
    element.uses = amounts_of(object.find("uses"), where + ": uses");
    element.uses.resize(quantities_.size(), 0);
    if (const json* arms = object.find("arms")) {
      JsonObject by_port(*arms, where + ": arms");
      for (const std::string_view port : kPortNames) {
        element.arms.push_back(
            amounts_of(by_port.find(port), fmt::format("{}: arms: {}", where, port)));
        element.arms.back().resize(quantities_.size(), 0);
      }
      by_port.expect_nothing_else();
    }
    element.is_filling = object.flag("filling", true);
    element.is_front = object.flag("front", true);
    element.is_back = object.flag("back", true);
    object.expect_nothing_else();
    database().elements.push_back(std::move(element));
  }
  void read_transition(const json& value) {
    JsonObject object(value,
                      fmt::format("{}: transition {}", source_, database().transitions.size() + 1));
    Transition transition;
    transition.from = elements_.at(object.needed("from"), object.where() + ": from");
    transition.to = elements_.at(object.needed("to"), object.where() + ": to");
    transition.from_port = port_of(object, "from_port", Port::kRight);
    transition.to_port = port_of(object, "to_port", Port::kLeft);
    if (const json* cost = object.find("cost"))
      transition.cost = cost_->steps(*cost, object.where());
    transition.uses = amounts_of(object.find("uses"), object.where() + ": uses");
    object.expect_nothing_else();
    database().transitions.push_back(std::move(transition));
  }
  void read_matrix() {
    const json& rows = root_.list("transition_matrix");
    if (rows.empty()) return;
    const std::size_t n = database().elements.size();
    const std::string where = source_ + ": transition_matrix";
    if (rows.size() != n)
      throw InputError(fmt::format("{}: {} rows for {} elements", where, rows.size(), n));
    for (std::uint32_t from = 0; from < n; ++from) {
      const std::string row = fmt::format("{}: row {}", where, from + 1);
      if (!rows[from].is_array() || rows[from].size() != n)
        throw InputError(fmt::format("{}: must list {} costs, null where none may follow", row, n));
      for (std::uint32_t to = 0; to < n; ++to)
        if (!rows[from][to].is_null())
          database().transitions.push_back(
              {.from = from, .to = to, .cost = cost_->steps(rows[from][to], row)});
    }
  }

  void read_key_point(const json& value) {
    JsonObject object(value, fmt::format("{}: key point {}", source_, key_points_.size() + 1));
    KeyPoint point{object.name(), {}};
    const std::string where = fmt::format("{}: key point \"{}\"", source_, point.name);
    key_points_.add(point.name, source_);
    std::set<ElementIndex> allowed;
    for (const json& name : object.list("elements"))
      allowed.insert(elements_.at(name, where + ": elements"));
    for (const std::string& wanted : texts_of(object, "classes")) {
      const std::size_t before = allowed.size();
      for (ElementIndex e = 0; e < database().elements.size(); ++e)
        if (std::ranges::count(database().elements[e].classes, wanted) > 0) allowed.insert(e);
      if (allowed.size() == before && !is_class(wanted))
        throw InputError(fmt::format("{}: no element is of class \"{}\"", where, wanted));
    }
    if (allowed.empty())
      throw InputError(where + ": give \"classes\" or \"elements\" that may stand there");
    object.expect_nothing_else();
    point.allowed.assign(allowed.begin(), allowed.end());
    read_.problem.structure.key_points.push_back(std::move(point));
  }
  bool is_class(const std::string& name) {
    return std::ranges::any_of(database().elements, [&](const Element& element) {
      return std::ranges::count(element.classes, name) > 0;
    });
  }
  void read_segment(const json& value) {
    auto& segments = read_.problem.structure.segments;
    JsonObject object(value, fmt::format("{}: segment {}", source_, segments.size() + 1));
    Segment segment;
    segment.name = object.text("name").value_or("");
    const std::string where = segment.name.empty()
                                  ? object.where()
                                  : fmt::format("{}: segment \"{}\"", source_, segment.name);
    if (const json* from = object.find("from"))
      segment.from = key_points_.at(*from, where + ": from");
    if (const json* to = object.find("to")) segment.to = key_points_.at(*to, where + ": to");
    segment.from_port = port_of(object, "from_port", Port::kRight);
    segment.to_port = port_of(object, "to_port", Port::kLeft);
    segment.is_reversed = object.flag("reversed", false);
    segment.may_be_empty = object.flag("may_be_empty", true);
    segment.bounds = bounds_of(object, where);
    object.expect_nothing_else();
    segments.push_back(std::move(segment));
  }

  const json& document_;
  std::string source_;
  JsonObject root_;
  ReadProblem read_;
  std::vector<Quantity> quantities_;
  std::optional<Quantity> cost_;
  NameIndex resources_{"resource"};
  NameIndex elements_{"element"};
  NameIndex key_points_{"key point"};
};

}  // namespace

ReadProblem parse_problem(std::string_view text, const std::string& source) {
  json document;
  try {
    document = json::parse(text);
  } catch (const json::exception& error) {
    throw InputError(fmt::format("{}: is no JSON: {}", source, error.what()));
  }
  return ProblemReader(document, source).read();
}

ReadProblem read_problem(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw InputError(file.string() + ": cannot be read");
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  const bool is_number = first != std::string::npos && text[first] >= '0' && text[first] <= '9';
  if (is_number) return {parse_or_library(text, file.string()), {}};
  return parse_problem(text, file.string());
}

}  // namespace plat::sequences
