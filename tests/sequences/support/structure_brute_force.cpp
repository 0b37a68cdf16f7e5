#include "sequences/support/structure_brute_force.h"

#include <algorithm>
#include <array>
#include <functional>
#include <string>
#include <utility>

#include "core/failure.h"

namespace plat::testing {
namespace {

using namespace sequences;

using Amounts = std::vector<std::int64_t>;

/// A search that takes more steps gives up.
constexpr std::size_t kMostSteps = 12'000;

void add(Amounts& sums, const std::vector<Amount>& amounts) {
  for (std::size_t r = 0; r < amounts.size(); ++r) sums[r] += amounts[r];
}

bool is_within_maxima(const Amounts& sums, const std::vector<Bounds>& bounds) {
  for (std::size_t r = 0; r < bounds.size(); ++r)
    if (bounds[r].max != kUnbounded && sums[r] > bounds[r].max) return false;
  return true;
}

bool is_above_minima(const Amounts& sums, const std::vector<Bounds>& bounds) {
  for (std::size_t r = 0; r < bounds.size(); ++r)
    if (sums[r] < bounds[r].min) return false;
  return true;
}

/// The transitions by which two sides may touch, each once.
std::vector<const Transition*> touching(const SequenceDatabase& database, ElementIndex a, Port at_a,
                                        ElementIndex b, Port at_b) {
  std::vector<const Transition*> found;
  for (const auto& t : database.transitions) {
    const bool is_as_stored = t.from == a && t.from_port == at_a && t.to == b && t.to_port == at_b;
    const bool is_swapped = t.from == b && t.from_port == at_b && t.to == a && t.to_port == at_a;
    if (is_as_stored || is_swapped) found.push_back(&t);
  }
  return found;
}

/// A row of elements that fits between two ends.
struct Row {
  Cost cost = 0;
  std::vector<ElementIndex> elements;
  Amounts consumed;  // by its elements and all its transitions
};

/// All rows of one segment between two given key elements.
struct RowSearch {
  const SequenceProblem& problem;
  const Segment& segment;
  std::optional<ElementIndex> first;
  std::optional<ElementIndex> last;
  std::size_t& steps_left;
  std::vector<Row> found = {};

  [[nodiscard]] Port near_side() const { return segment.is_reversed ? Port::kRight : Port::kLeft; }
  [[nodiscard]] Port far_side() const { return segment.is_reversed ? Port::kLeft : Port::kRight; }
  [[nodiscard]] bool may_end(ElementIndex e, Port side) const {
    return side == Port::kLeft ? problem.database.elements[e].is_front
                               : problem.database.elements[e].is_back;
  }
  /// What the segment's own bounds count: the row and the arms at both ends.
  [[nodiscard]] Amounts locally(const Row& row) const {
    Amounts sums = row.consumed;
    const auto add_arm = [&](std::optional<ElementIndex> e, Port port) {
      if (!e || problem.database.elements[*e].arms.empty()) return;
      add(sums, problem.database.elements[*e].arms[static_cast<std::size_t>(port)]);
    };
    add_arm(first, segment.from_port);
    add_arm(last, segment.to_port);
    return sums;
  }
  void finish(const Row& row) {
    if (is_within_maxima(locally(row), segment.bounds) &&
        is_above_minima(locally(row), segment.bounds))
      found.push_back(row);
  }
  void try_element(const Row& row, ElementIndex element, const Transition* by) {
    Row longer = row;
    if (by != nullptr) {
      longer.cost += by->cost;
      add(longer.consumed, by->uses);
    }
    longer.elements.push_back(element);
    add(longer.consumed, problem.database.elements[element].uses);
    if (is_within_maxima(locally(longer), segment.bounds) &&
        is_within_maxima(longer.consumed, problem.bounds))
      extend(longer);
  }
  void finish_by(const Row& row, const std::vector<const Transition*>& ways) {
    for (const Transition* by : ways) {
      Row whole = row;
      whole.cost += by->cost;
      add(whole.consumed, by->uses);
      finish(whole);
    }
  }
  void extend(const Row& row) {
    if (steps_left == 0) return;
    --steps_left;
    const auto& database = problem.database;
    if (!row.elements.empty()) {
      const ElementIndex tail = row.elements.back();
      if (last)
        finish_by(row, touching(database, tail, far_side(), *last, segment.to_port));
      else if (may_end(tail, far_side()))
        finish(row);
    }
    for (ElementIndex e = 0; e < database.elements.size(); ++e) {
      if (!database.elements[e].is_filling) continue;
      if (row.elements.empty() && !first) {
        if (may_end(e, near_side())) try_element(row, e, nullptr);
        continue;
      }
      const auto ways = row.elements.empty()
                            ? touching(database, *first, segment.from_port, e, near_side())
                            : touching(database, row.elements.back(), far_side(), e, near_side());
      for (const Transition* by : ways) try_element(row, e, by);
    }
  }
  std::vector<Row> rows() {
    Row empty;
    empty.consumed.assign(problem.database.resources.size(), 0);
    extend(empty);
    if (first && last && segment.may_be_empty)
      finish_by(empty,
                touching(problem.database, *first, segment.from_port, *last, segment.to_port));
    return std::move(found);
  }
};

/// All ways to give elements to key points, then rows to segments.
struct ArrangementSearch {
  const SequenceProblem& problem;
  std::size_t limit;
  std::size_t steps_left = kMostSteps;
  std::vector<ElementIndex> keys = {};
  std::vector<std::vector<Row>> rows = {};
  std::vector<PlainArrangement> found = {};

  void choose_keys() {
    const auto& structure = problem.structure;
    if (keys.size() < structure.key_points.size()) {
      for (const ElementIndex e : structure.key_points[keys.size()].allowed) {
        keys.push_back(e);
        choose_keys();
        keys.pop_back();
      }
      return;
    }
    rows.clear();
    for (const Segment& segment : structure.segments) {
      const auto element = [this](std::optional<std::uint32_t> key) {
        return key ? std::optional(keys[*key]) : std::nullopt;
      };
      rows.push_back(
          RowSearch{problem, segment, element(segment.from), element(segment.to), steps_left}
              .rows());
      if (rows.back().empty()) return;
    }
    PlainArrangement start{0, keys, {}, Amounts(problem.database.resources.size(), 0)};
    for (const ElementIndex e : keys) add(start.consumed, problem.database.elements[e].uses);
    choose_rows(start);
  }
  void choose_rows(const PlainArrangement& so_far) {
    if (steps_left == 0 || found.size() > limit) return;
    --steps_left;
    if (!is_within_maxima(so_far.consumed, problem.bounds)) return;
    if (so_far.segments.size() == rows.size()) {
      if (is_above_minima(so_far.consumed, problem.bounds)) found.push_back(so_far);
      return;
    }
    for (const Row& row : rows[so_far.segments.size()]) {
      PlainArrangement more = so_far;
      more.cost += row.cost;
      more.segments.push_back(row.elements);
      for (std::size_t r = 0; r < row.consumed.size(); ++r) more.consumed[r] += row.consumed[r];
      choose_rows(more);
    }
  }
};

/// All paths of a graph, by following them.
struct PathSearch {
  const SearchGraph& graph;
  std::size_t limit;
  std::size_t steps_left = kMostSteps;
  std::vector<SequencePath> found = {};
  std::vector<Step> steps = {};

  void walk(const Step& step, Cost cost, std::vector<std::int64_t> consumed,
            const Amount* arc_uses) {
    if (steps_left == 0 || found.size() > limit) return;
    --steps_left;
    const Zone& zone = graph.zones[graph.zone_of(step.node)];
    for (std::uint32_t d = 0; d < graph.dimension_count; ++d) {
      consumed[d] += graph.uses(step.node)[d] + (arc_uses == nullptr ? 0 : arc_uses[d]);
      if (zone.bounds[d].max != kUnbounded && consumed[d] > zone.bounds[d].max) return;
    }
    steps.push_back(step);
    for (const Terminal& exit : graph.exits)
      if (exit.node == step.node)
        if (SequencePath path{cost + exit.cost, steps}; is_at_its_minima(zone, consumed))
          found.push_back(path);
    if (zone.table) {
      const auto& table = graph.tables[*zone.table];
      const std::uint32_t local = step.node - zone.first_node;
      for (std::uint32_t a = table.first[local]; a < table.first[local + 1]; ++a)
        walk({zone.first_node + table.arcs[a].head, a}, cost + table.arcs[a].cost, consumed,
             table.arc_uses.empty() ? nullptr : table.arc_uses.data() + a * graph.dimension_count);
    }
    const auto [first, last] = graph.links_from(step.node);
    for (std::uint32_t link = first; link < last; ++link) follow(link, cost, consumed, zone);
    steps.pop_back();
  }
  [[nodiscard]] static bool is_at_its_minima(const Zone& zone,
                                             const std::vector<std::int64_t>& consumed) {
    return is_above_minima(consumed, zone.bounds);
  }
  void follow(std::uint32_t link, Cost cost, std::vector<std::int64_t> consumed, const Zone& from) {
    const Zone& to = graph.zones[graph.zone_of(graph.links[link].to)];
    for (std::uint32_t d = 0; d < graph.dimension_count; ++d) {
      if (!to.resets[d]) continue;
      if (consumed[d] < from.bounds[d].min) return;
      consumed[d] = 0;
    }
    walk({graph.links[link].to, link}, cost + graph.links[link].cost, std::move(consumed), nullptr);
  }
};

}  // namespace

std::optional<std::vector<PlainArrangement>> enumerate_arrangements(const SequenceProblem& problem,
                                                                    std::size_t limit) {
  ArrangementSearch search{problem, limit};
  search.choose_keys();
  if (search.found.size() > limit || search.steps_left == 0) return std::nullopt;
  std::ranges::sort(search.found);
  return std::move(search.found);
}

std::optional<std::vector<PlainArrangement>> arrangements_of_all_paths(
    const CompiledProblem& compiled, const SequenceProblem& problem, std::size_t limit) {
  const SearchGraph& graph = compiled.graph;
  PathSearch search{graph, limit};
  for (std::uint32_t i = 0; i < graph.entries.size(); ++i)
    search.walk({graph.entries[i].node, i}, graph.entries[i].cost,
                std::vector<std::int64_t>(graph.dimension_count, 0), nullptr);
  if (search.found.size() > limit || search.steps_left == 0) return std::nullopt;
  std::vector<PlainArrangement> result;
  for (const SequencePath& path : search.found) {
    const std::string wrong = why_not_feasible(graph, path);
    expects(wrong.empty(), wrong.c_str());
    const Arrangement placed = arrangement(compiled, problem, path);
    ArrangementByPart parts = by_part(problem.structure, placed);
    result.push_back(
        {placed.cost, std::move(parts.key_points), std::move(parts.segments), placed.consumed});
  }
  std::ranges::sort(result);
  return result;
}

namespace {

bool chance(Rng& rng, double probability) { return rng.uniform_01() < probability; }

Amount up_to(Rng& rng, Amount n) {
  return static_cast<Amount>(rng.index(static_cast<std::uint64_t>(n) + 1));
}

constexpr std::array kAllPorts{Port::kLeft, Port::kRight, Port::kStem};

void add_elements(Rng& rng, const StructureSize& size, SequenceDatabase& database) {
  for (std::uint32_t e = 0; e < size.filling + size.key_elements; ++e) {
    Element element{.name = "e" + std::to_string(e)};
    element.is_filling = e < size.filling || chance(rng, 0.1);
    element.is_front = chance(rng, 0.7);
    element.is_back = chance(rng, 0.7);
    element.uses = {1 + up_to(rng, 2), up_to(rng, 1)};
    if (chance(rng, 0.7))
      for (std::size_t p = 0; p < kPortCount; ++p)
        element.arms.push_back({up_to(rng, 1), up_to(rng, 1)});
    database.elements.push_back(std::move(element));
  }
}

void add_transitions(Rng& rng, SequenceDatabase& database) {
  const auto count = static_cast<ElementIndex>(database.elements.size());
  for (ElementIndex a = 0; a < count; ++a) {
    for (ElementIndex b = 0; b < count; ++b) {
      for (const Port at_a : kAllPorts) {
        for (const Port at_b : kAllPorts) {
          const bool is_row = at_a == Port::kRight && at_b == Port::kLeft;
          for (double likely = is_row ? 0.7 : 0.4; chance(rng, likely); likely = 0.1) {
            Transition t{a, b, at_a, at_b, static_cast<Cost>(rng.index(6)), {}};
            if (chance(rng, 0.1)) t.uses = {up_to(rng, 1), up_to(rng, 1)};
            database.transitions.push_back(std::move(t));
          }
        }
      }
    }
  }
}

/// Grows a structure segment by segment from a key point.
struct StructureGrowth {
  Rng& rng;
  const SequenceProblem& problem;
  const StructureSize& size;
  Structure structure = {};
  std::vector<std::vector<Port>> free_ports = {};

  std::uint32_t add_key_point() {
    KeyPoint key;
    const auto count = static_cast<ElementIndex>(problem.database.elements.size());
    for (ElementIndex e = 0; e < count; ++e)
      if (e >= size.filling ? chance(rng, 0.5) : chance(rng, 0.1)) key.allowed.push_back(e);
    if (key.allowed.empty()) key.allowed.push_back(count - 1);
    structure.key_points.push_back(std::move(key));
    free_ports.emplace_back(kAllPorts.begin(), kAllPorts.end());
    return static_cast<std::uint32_t>(free_ports.size()) - 1;
  }
  Port take_port(std::uint32_t key) {
    auto& ports = free_ports[key];
    const std::size_t chosen = rng.index(ports.size());
    const Port port = ports[chosen];
    ports.erase(ports.begin() + static_cast<std::ptrdiff_t>(chosen));
    return port;
  }
  std::vector<std::uint32_t> open_key_points() {
    std::vector<std::uint32_t> open;
    for (std::uint32_t k = 0; k < free_ports.size(); ++k)
      if (!free_ports[k].empty()) open.push_back(k);
    return open;
  }
  bool add_segment() {
    auto open = open_key_points();
    if (open.empty()) return false;
    Segment segment;
    segment.from = open[rng.index(open.size())];
    segment.from_port = take_port(*segment.from);
    if (!chance(rng, 0.25)) {
      open = open_key_points();
      const bool closes = size.has_cycles && !open.empty() && chance(rng, 0.35);
      segment.to = closes ? open[rng.index(open.size())] : add_key_point();
      segment.to_port = take_port(*segment.to);
    }
    segment.is_reversed = chance(rng, 0.4);
    segment.may_be_empty = chance(rng, 0.6);
    if (chance(rng, 0.8)) {
      const Amount most = 2 + up_to(rng, 4);
      segment.bounds = {{chance(rng, 0.4) ? most : up_to(rng, most / 2), most}};
      if (chance(rng, 0.3)) segment.bounds.push_back({up_to(rng, 1), 1 + up_to(rng, 3)});
    }
    if (chance(rng, 0.5)) {
      std::swap(segment.from, segment.to);
      std::swap(segment.from_port, segment.to_port);
    }
    structure.segments.push_back(std::move(segment));
    return true;
  }
};

}  // namespace

SequenceProblem random_structure_problem(Rng& rng, const StructureSize& size) {
  SequenceProblem problem;
  problem.database.resources = {{"length", 1.0}, {"balconies", 1.0}};
  add_elements(rng, size, problem.database);
  add_transitions(rng, problem.database);
  StructureGrowth growth{rng, problem, size};
  growth.add_key_point();
  const auto count = 1 + rng.index(size.segments);
  for (std::uint64_t s = 0; s < count; ++s)
    if (!growth.add_segment()) break;
  problem.structure = std::move(growth.structure);
  const auto room = static_cast<Amount>(2 * (count + problem.structure.key_points.size()));
  problem.bounds = {{up_to(rng, room), room + 2 + up_to(rng, room / 2)}};
  if (chance(rng, 0.4))
    problem.bounds.push_back({up_to(rng, 3), chance(rng, 0.5) ? kUnbounded : 5});
  return problem;
}

}  // namespace plat::testing
