#include "sequences/unrolling.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <string>
#include <utility>

#include "core/failure.h"
#include "sequences/adjacency.h"
#include "sequences/compiled_check.h"
#include "sequences/contexts.h"
#include "sequences/structure_check.h"
#include "sequences/structure_decomposition.h"

namespace plat::sequences {
namespace {

Amount amount_of(const std::vector<Amount>& amounts, std::uint32_t resource) {
  return resource < amounts.size() ? amounts[resource] : 0;
}

Bounds bounds_of(const std::vector<Bounds>& bounds, std::uint32_t resource) {
  return resource < bounds.size() ? bounds[resource] : Bounds{};
}

Port start_port(const Segment& segment, const DirectedSegment& directed) {
  return directed.is_forward ? segment.from_port : segment.to_port;
}

Port end_port(const Segment& segment, const DirectedSegment& directed) {
  return directed.is_forward ? segment.to_port : segment.from_port;
}

/// A link whose end has no node yet, but a place in the zone that comes next.
struct OpenLink {
  std::uint32_t from = 0;
  std::uint32_t to = 0;  ///< place in the next zone, or in the next row of zones
  std::uint32_t transition = kNoTransition;
  Cost cost = 0;
};

/// A node from which the path goes on, and the choices that it stands for.
struct Tail {
  std::uint32_t node = 0;
  std::uint32_t context = 0;
};

/// One segment while it is unrolled.
struct Stage {
  const Visit& visit;
  const Segment& segment;
  bool is_rightwards = true;  ///< elements are met with their left side first
  Contexts inner;             ///< by interior zone
  Contexts start;             ///< by node of the start zone
  Contexts end;               ///< by node of the end zone
  std::uint32_t first_start = 0;
  std::uint32_t first_inner = 0;

  [[nodiscard]] Port near_side() const { return is_rightwards ? Port::kLeft : Port::kRight; }
  [[nodiscard]] Port far_side() const { return is_rightwards ? Port::kRight : Port::kLeft; }
};

class Unrolling {
 public:
  explicit Unrolling(const SequenceProblem& problem)
      : problem_(problem),
        database_(problem.database),
        structure_(problem.structure),
        adjacency_(problem.database),
        member_(problem.database.elements.size(), kNoMember) {
    for (ElementIndex e = 0; e < database_.elements.size(); ++e) {
      if (!database_.elements[e].is_filling) continue;
      member_[e] = static_cast<std::uint32_t>(members_.size());
      members_.push_back(e);
    }
    find_dimensions();
    for (std::uint32_t k = 0; k < structure_.key_points.size(); ++k) {
      allowed_.push_back(possible_elements(k));
      choice_counts_.push_back(static_cast<std::uint32_t>(allowed_.back().size()));
    }
  }

  CompiledProblem run() && {
    compiled_.is_walked_backwards.assign(structure_.segments.size(), false);
    const auto visits = visit_order(structure_, decompose(structure_));
    expect_few_links(visits);
    for (const Visit& visit : visits) {
      const Segment& segment = structure_.segments[visit.directed.segment];
      compiled_.is_walked_backwards[visit.directed.segment] = !visit.directed.is_forward;
      const Contexts inner(visit.remembered, choice_counts_);
      Stage stage{visit,
                  segment,
                  visit.directed.is_forward != segment.is_reversed,
                  inner,
                  visit.start ? inner.with(*visit.start, choice_counts_) : inner,
                  visit.end ? inner.with(*visit.end, choice_counts_) : inner};
      if (visit.start) add_start_zone(stage);
      add_interior_zones(stage);
      if (visit.end)
        add_end_zone(stage);
      else
        end_freely(stage);
    }
    for (const Tail& tail : tails_) graph_.exits.push_back({tail.node, 0});
    sort_links();
    validate(compiled_, database_);
    return std::move(compiled_);
  }

 private:
  static constexpr std::uint32_t kNoMember = kNoTransition;

  void find_dimensions() {
    const auto resource_count = static_cast<std::uint32_t>(database_.resources.size());
    for (std::uint32_t r = 0; r < resource_count; ++r)
      if (bounds_of(problem_.bounds, r) != Bounds{}) compiled_.dimensions.push_back({r, false});
    for (std::uint32_t r = 0; r < resource_count; ++r)
      if (std::ranges::any_of(structure_.segments, [r](const Segment& segment) {
            return bounds_of(segment.bounds, r) != Bounds{};
          }))
        compiled_.dimensions.push_back({r, true});
    graph_.dimension_count = static_cast<std::uint32_t>(compiled_.dimensions.size());
  }

  /// Whether something may stand beside `element` at one end of a segment.
  [[nodiscard]] bool has_neighbour(ElementIndex element, const DirectedSegment& directed) const {
    const Segment& segment = structure_.segments[directed.segment];
    const Port port = start_port(segment, directed);
    const bool is_rightwards = directed.is_forward != segment.is_reversed;
    const Port near_side = is_rightwards ? Port::kLeft : Port::kRight;
    if (segment.may_be_empty && segment.from && segment.to &&
        !adjacency_.of(element, port, end_port(segment, directed)).empty())
      return true;
    return std::ranges::any_of(
        adjacency_.of(element, port, near_side),
        [this](const Neighbour& neighbour) { return member_[neighbour.head] != kNoMember; });
  }

  /// The elements of a key point that have a neighbour towards each of its segments, or all of them
  /// where none has: then there is no path at all.
  [[nodiscard]] std::vector<ElementIndex> possible_elements(std::uint32_t key) const {
    std::vector<ElementIndex> possible = structure_.key_points[key].allowed;
    for (std::uint32_t s = 0; s < structure_.segments.size(); ++s) {
      for (const bool is_forward : {true, false}) {
        const Segment& segment = structure_.segments[s];
        if ((is_forward ? segment.from : segment.to) != key) continue;
        std::erase_if(possible, [&](ElementIndex element) {
          return !has_neighbour(element, {s, is_forward});
        });
      }
    }
    return possible.empty() ? structure_.key_points[key].allowed : possible;
  }

  void expect_few_links(const std::vector<Visit>& visits) const {
    double links = 0.0;
    for (const Visit& visit : visits) {
      double contexts = static_cast<double>(members_.size());
      for (const std::uint32_t key : visit.remembered) contexts *= choice_counts_[key];
      links += contexts * (1.0 + (visit.start ? choice_counts_[*visit.start] : 0) +
                           (visit.end ? choice_counts_[*visit.end] : 0));
    }
    if (links > kMostUnrolledLinks)
      throw InputError("structure: the elements that key points may take lead to " +
                       std::to_string(links) + " links, allowed 0.." +
                       std::to_string(kMostUnrolledLinks));
  }

  /// Nodes that consume nothing and place nothing, for the caller to fill in.
  std::uint32_t add_zone(const Stage& stage, std::uint32_t size, bool is_start,
                         std::optional<std::uint32_t> table = std::nullopt) {
    Zone zone{graph_.node_count(), size, table, {}, {}};
    for (const auto& [resource, is_local] : compiled_.dimensions) {
      zone.bounds.push_back(bounds_of(is_local ? stage.segment.bounds : problem_.bounds, resource));
      zone.resets.push_back(is_start && is_local);
    }
    graph_.zones.push_back(std::move(zone));
    compiled_.zone_segments.push_back(stage.visit.directed.segment);
    graph_.node_uses.resize(std::size_t{graph_.node_count()} * graph_.dimension_count, 0);
    compiled_.placements.resize(graph_.node_count());
    return graph_.zones.back().first_node;
  }

  Amount& uses(std::uint32_t node, std::size_t dimension) {
    return graph_.node_uses[std::size_t{node} * graph_.dimension_count + dimension];
  }

  /// Makes a node the key element with its arm; where it is placed, also with what it consumes.
  void set_key_element(std::uint32_t node, std::uint32_t key, ElementIndex element, Port port,
                       bool is_placed) {
    const Element& used = database_.elements[element];
    const auto p = static_cast<std::size_t>(port);
    for (std::size_t d = 0; d < compiled_.dimensions.size(); ++d) {
      const auto& [resource, is_local] = compiled_.dimensions[d];
      if (is_local)
        uses(node, d) = p < used.arms.size() ? amount_of(used.arms[p], resource) : 0;
      else if (is_placed)
        uses(node, d) = amount_of(used.uses, resource);
    }
    if (is_placed)
      compiled_.placements[node] = Placement{element, Placement::Place::kKeyPoint, key};
  }

  void add_link(std::uint32_t from, std::uint32_t to, Cost cost, std::uint32_t transition) {
    graph_.links.push_back({from, to, cost});
    compiled_.link_transitions.push_back(transition);
  }

  /// Leads open links whose transition consumes something over a node that does.
  void consume_on_the_way(const Stage& stage, std::vector<OpenLink>& open) {
    const auto consumes = [this](const OpenLink& link) {
      const auto& amounts = database_.transitions[link.transition].uses;
      return std::ranges::any_of(compiled_.dimensions, [&amounts](const DimensionMeaning& meaning) {
        return amount_of(amounts, meaning.resource) > 0;
      });
    };
    const auto count = std::ranges::count_if(open, consumes);
    if (count == 0) return;
    std::uint32_t node = add_zone(stage, static_cast<std::uint32_t>(count), false);
    for (OpenLink& link : open) {
      if (!consumes(link)) continue;
      for (std::size_t d = 0; d < compiled_.dimensions.size(); ++d)
        uses(node, d) = amount_of(database_.transitions[link.transition].uses,
                                  compiled_.dimensions[d].resource);
      add_link(link.from, node, link.cost, link.transition);
      link = {node++, link.to, kNoTransition, 0};
    }
  }

  void close(const std::vector<OpenLink>& open, std::uint32_t first) {
    for (const OpenLink& link : open)
      add_link(link.from, first + link.to, link.cost, link.transition);
  }

  [[nodiscard]] OpenLink open_link(std::uint32_t from, std::uint32_t to,
                                   std::uint32_t transition) const {
    return {from, to, transition, database_.transitions[transition].cost};
  }

  [[nodiscard]] ElementIndex element_at(const Contexts& contexts, std::uint32_t context,
                                        std::uint32_t key) const {
    return allowed_[key][contexts.choice(context, key)];
  }

  /// The key element that the segment leaves: placed where the path begins, else a duplicate of the
  /// one that was placed, t' of [Har, Fig. 3.4].
  void add_start_zone(Stage& stage) {
    const std::uint32_t key = *stage.visit.start;
    const bool is_first = graph_.zones.empty();
    stage.first_start = add_zone(stage, stage.start.size(), true);
    for (std::uint32_t context = 0; context < stage.start.size(); ++context) {
      const std::uint32_t node = stage.first_start + context;
      set_key_element(node, key, element_at(stage.start, context, key),
                      start_port(stage.segment, stage.visit.directed), is_first);
      if (is_first) graph_.entries.push_back({node, 0});
    }
    for (const Tail& tail : tails_)
      add_link(tail.node, stage.first_start + tail_contexts_.project(tail.context, stage.start), 0,
               kNoTransition);
  }

  std::uint32_t table(bool is_rightwards) {
    auto& index = tables_[is_rightwards ? 1 : 0];
    if (index) return *index;
    TransitionTable table;
    std::vector<std::uint32_t> transitions;
    const auto [near_side, far_side] =
        is_rightwards ? std::pair(Port::kLeft, Port::kRight) : std::pair(Port::kRight, Port::kLeft);
    table.first.push_back(0);
    for (const ElementIndex tail : members_) {
      for (const Neighbour& neighbour : adjacency_.of(tail, far_side, near_side)) {
        if (member_[neighbour.head] == kNoMember) continue;
        const Transition& transition = database_.transitions[neighbour.transition];
        table.arcs.push_back({member_[neighbour.head], transition.cost});
        transitions.push_back(neighbour.transition);
        for (const auto& meaning : compiled_.dimensions)
          table.arc_uses.push_back(amount_of(transition.uses, meaning.resource));
      }
      table.first.push_back(static_cast<std::uint32_t>(table.arcs.size()));
    }
    if (std::ranges::all_of(table.arc_uses, [](Amount used) { return used == 0; }))
      table.arc_uses.clear();
    index = static_cast<std::uint32_t>(graph_.tables.size());
    graph_.tables.push_back(std::move(table));
    compiled_.arc_transitions.push_back(std::move(transitions));
    return *index;
  }

  void add_interior_zones(Stage& stage) {
    const auto size = static_cast<std::uint32_t>(members_.size());
    if (size == 0) return;
    std::vector<OpenLink> open;
    for (std::uint32_t context = 0; stage.visit.start && context < stage.start.size(); ++context) {
      const std::uint32_t inner = stage.start.project(context, stage.inner);
      const auto element = element_at(stage.start, context, *stage.visit.start);
      for (const Neighbour& neighbour : adjacency_.of(
               element, start_port(stage.segment, stage.visit.directed), stage.near_side()))
        if (member_[neighbour.head] != kNoMember)
          open.push_back(open_link(stage.first_start + context,
                                   inner * size + member_[neighbour.head], neighbour.transition));
    }
    consume_on_the_way(stage, open);
    stage.first_inner = graph_.node_count();
    for (std::uint32_t context = 0; context < stage.inner.size(); ++context) {
      std::uint32_t node = add_zone(stage, size, false, table(stage.is_rightwards));
      for (const ElementIndex element : members_) {
        for (std::size_t d = 0; d < compiled_.dimensions.size(); ++d)
          uses(node, d) =
              amount_of(database_.elements[element].uses, compiled_.dimensions[d].resource);
        compiled_.placements[node++] =
            Placement{element, Placement::Place::kSegment, stage.visit.directed.segment};
      }
    }
    close(open, stage.first_inner);
    if (stage.visit.start) return;
    for (std::uint32_t m = 0; m < size; ++m)
      if (may_end(members_[m], stage.near_side()))
        graph_.entries.push_back({stage.first_inner + m, 0});
  }

  /// Whether an element may stand at a free end with this side out.
  [[nodiscard]] bool may_end(ElementIndex element, Port side) const {
    return side == Port::kLeft ? database_.elements[element].is_front
                               : database_.elements[element].is_back;
  }

  /// The key element that the segment arrives at: placed, or the duplicate that closes a cycle at a
  /// real cost [Har, Fig. 3.5].
  void add_end_zone(Stage& stage) {
    const std::uint32_t key = *stage.visit.end;
    const Port port = end_port(stage.segment, stage.visit.directed);
    std::vector<OpenLink> open;
    for (std::uint32_t context = 0; context < stage.end.size(); ++context) {
      const auto element = element_at(stage.end, context, key);
      const std::uint32_t first =
          stage.first_inner +
          stage.end.project(context, stage.inner) * static_cast<std::uint32_t>(members_.size());
      for (const Neighbour& neighbour : adjacency_.of(element, port, stage.far_side()))
        if (member_[neighbour.head] != kNoMember)
          open.push_back(open_link(first + member_[neighbour.head], context, neighbour.transition));
    }
    if (stage.visit.start && stage.segment.may_be_empty) open_direct_links(stage, open);
    consume_on_the_way(stage, open);
    const std::uint32_t first_end = add_zone(stage, stage.end.size(), false);
    close(open, first_end);
    tails_.clear();
    for (std::uint32_t context = 0; context < stage.end.size(); ++context) {
      set_key_element(first_end + context, key, element_at(stage.end, context, key), port,
                      !stage.visit.is_end_placed);
      tails_.push_back({first_end + context, context});
    }
    tail_contexts_ = stage.end;
  }

  /// Of an empty segment: the two key elements touch.
  void open_direct_links(const Stage& stage, std::vector<OpenLink>& open) const {
    std::vector<std::vector<std::uint32_t>> starts(stage.inner.size());
    for (std::uint32_t context = 0; context < stage.start.size(); ++context)
      starts[stage.start.project(context, stage.inner)].push_back(context);
    for (std::uint32_t context = 0; context < stage.end.size(); ++context) {
      const auto touching = adjacency_.of(element_at(stage.end, context, *stage.visit.end),
                                          end_port(stage.segment, stage.visit.directed),
                                          start_port(stage.segment, stage.visit.directed));
      for (const std::uint32_t start : starts[stage.end.project(context, stage.inner)]) {
        const auto element = element_at(stage.start, start, *stage.visit.start);
        for (const Neighbour& neighbour :
             std::ranges::equal_range(touching, element, {}, &Neighbour::head))
          open.push_back(open_link(stage.first_start + start, context, neighbour.transition));
      }
    }
  }

  void end_freely(const Stage& stage) {
    tails_.clear();
    std::uint32_t node = stage.first_inner;
    for (std::uint32_t context = 0; context < stage.inner.size(); ++context)
      for (const ElementIndex element : members_) {
        if (may_end(element, stage.far_side())) tails_.push_back({node, context});
        ++node;
      }
    tail_contexts_ = stage.inner;
  }

  void sort_links() {
    std::vector<std::uint32_t> order(graph_.links.size());
    std::iota(order.begin(), order.end(), 0U);
    std::ranges::sort(order, {}, [this](std::uint32_t i) {
      return std::tuple(graph_.links[i].from, graph_.links[i].to, i);
    });
    std::vector<Link> links;
    std::vector<std::uint32_t> transitions;
    links.reserve(order.size());
    transitions.reserve(order.size());
    for (const std::uint32_t i : order) {
      links.push_back(graph_.links[i]);
      transitions.push_back(compiled_.link_transitions[i]);
    }
    graph_.links = std::move(links);
    compiled_.link_transitions = std::move(transitions);
  }

  const SequenceProblem& problem_;
  const SequenceDatabase& database_;
  const Structure& structure_;
  Adjacency adjacency_;
  std::vector<std::uint32_t> member_;               // by element: its place in interior zones
  std::vector<ElementIndex> members_;               // the filling elements
  std::vector<std::vector<ElementIndex>> allowed_;  // by key point
  std::vector<std::uint32_t> choice_counts_;        // by key point
  CompiledProblem compiled_;
  SearchGraph& graph_ = compiled_.graph;
  std::array<std::optional<std::uint32_t>, 2> tables_;  // leftwards, rightwards
  std::vector<Tail> tails_;                             // where the last segment ended
  Contexts tail_contexts_{{}, {}};
};

}  // namespace

CompiledProblem unroll(const SequenceProblem& problem) {
  check_structure(problem);
  return Unrolling(problem).run();
}

}  // namespace plat::sequences
