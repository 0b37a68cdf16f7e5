#include "blocks/edge_labels.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "streets/segment_index.h"

namespace plat::blocks {
namespace {

using streets::SegmentIndex;
using streets::Street;
using streets::StreetNetwork;

/// Contour edges or street pieces with the block or street they belong to.
struct Filed {
  SegmentIndex index;
  std::vector<std::uint32_t> owner;
};

Filed file_contours(std::span<const Block> blocks) {
  std::vector<Segment> segments;
  std::vector<std::uint32_t> owner;
  for (std::uint32_t b = 0; b < blocks.size(); ++b) {
    for_each_edge(blocks[b].contour, [&](const Segment& s) {
      segments.push_back(s);
      owner.push_back(b);
    });
  }
  return {SegmentIndex(std::move(segments)), std::move(owner)};
}

Filed file_streets(const StreetNetwork& network) {
  std::vector<Segment> segments;
  std::vector<std::uint32_t> owner;
  for (const Street& street : network.streets) {
    if (street.attributes.structure == streets::Structure::kTunnel) continue;
    for (std::size_t i = 1; i < street.line.size(); ++i) {
      segments.push_back({street.line[i - 1], street.line[i]});
      owner.push_back(street.id.value);
    }
  }
  return {SegmentIndex(std::move(segments)), std::move(owner)};
}

class Labeller {
 public:
  Labeller(std::span<const Block> blocks, const StreetNetwork& network, const LabelOptions& options)
      : network_(network),
        options_(options),
        contours_(file_contours(blocks)),
        streets_(file_streets(network)) {
    std::uint32_t next = 0;
    for (const Block& block : blocks) {
      first_edge_.push_back(next);
      for_each_edge(block.contour, [&](const Segment&) { ++next; });
    }
  }

  void label(Block& block, std::uint32_t b) const {
    std::uint32_t edge = first_edge_[b];
    bool faces_any = false;
    for (std::size_t r = 0; r < block.edges.size(); ++r) {
      const Ring& ring = ring_at(block, r);
      for (std::size_t i = 0; i < ring.size(); ++i, ++edge)
        block.edges[r][i] = label_edge(b, edge, r > 0);
      give_corners_their_neighbours(ring, block.edges[r]);
      for (const BlockEdge& e : block.edges[r]) faces_any = faces_any || e.is_street();
    }
    if (!faces_any) {
      for (BlockEdge& e : block.edges.front()) {
        e.logical_street = 0;
        e.street_width_m = options_.assumed_width_m;
        e.width_source = WidthSource::kAssumed;
      }
    }
    number_logical_streets(block, network_);
  }

 private:
  [[nodiscard]] BlockEdge label_edge(std::uint32_t b, std::uint32_t edge, bool is_hole) const {
    const Segment& s = contours_.index.segments()[edge];
    BlockEdge label;
    if (const auto street = fronted_street(edge, s)) {
      label.logical_street = 0;
      label.street = StreetId{*street};
      label.street_width_m = network_.streets[*street].width_m;
      label.width_source = network_.streets[*street].width_source;
    } else if (const auto gap = gap_m(b, edge, s, is_hole)) {
      label.logical_street = 0;
      label.street_width_m = *gap;
      label.width_source = WidthSource::kGap;
    }
    return label;
  }

  [[nodiscard]] std::optional<std::uint32_t> fronted_street(std::uint32_t edge,
                                                            const Segment& s) const {
    const Point middle = midpoint(s.a, s.b);
    const Point along = normalized(s.b - s.a);
    const Point outward = -perpendicular(along);
    struct Candidate {
      bool is_oblique = false;
      double distance_m = 0.0;
      std::uint32_t piece = 0;
      Point foot;
      auto key() const { return std::tuple(is_oblique, distance_m, piece); }
    };
    std::vector<Candidate> candidates;
    const double reach = options_.max_street_distance_m;
    const double max_sine = std::sin(options_.max_turn_rad);
    const bool is_corner = length(s) < options_.corner_edge_m;
    streets_.index.for_each_near(Box{middle, middle}.expanded(reach), [&](std::uint32_t i) {
      const Segment& t = streets_.index.segments()[i];
      const Point foot = nearest_point(t, middle);
      const Point to_foot = foot - middle;
      const double d = length(to_foot);
      if (d > reach) return;
      const bool is_oblique = std::abs(cross(normalized(t.b - t.a), along)) > max_sine;
      if (is_oblique && !is_corner) return;
      // The street lies in front of the edge, not beside it; centrelines may touch a contour.
      constexpr double kTouching_m = 0.5;
      if (dot(to_foot, outward) < (is_oblique ? 0.0 : 0.7 * d) - kTouching_m) return;
      candidates.push_back({is_oblique, d, i, foot});
    });
    std::sort(candidates.begin(), candidates.end(),
              [](const Candidate& c, const Candidate& d) { return c.key() < d.key(); });
    candidates.erase(
        std::unique(candidates.begin(), candidates.end(),
                    [](const Candidate& c, const Candidate& d) { return c.piece == d.piece; }),
        candidates.end());
    for (const Candidate& c : candidates) {
      if (is_in_sight(edge, middle, c.foot)) return streets_.owner[c.piece];
    }
    return std::nullopt;
  }

  [[nodiscard]] bool is_in_sight(std::uint32_t edge, Point from, Point to) const {
    const double d = distance(from, to);
    if (d <= 0.0) return true;
    const auto hit = contours_.index.first_hit(from, (to - from) / d, d,
                                               [&](std::uint32_t i) { return i != edge; });
    return !hit;
  }

  /// Median over three rays; two of them must meet land.
  [[nodiscard]] std::optional<double> gap_m(std::uint32_t b, std::uint32_t edge, const Segment& s,
                                            bool is_hole) const {
    const Point outward = -perpendicular(normalized(s.b - s.a));
    std::vector<double> gaps;
    for (const double t : {0.25, 0.5, 0.75}) {
      const auto hit = contours_.index.first_hit(lerp(s.a, s.b, t), outward, options_.max_gap_m,
                                                 [&](std::uint32_t i) { return i != edge; });
      if (hit && !(is_hole && contours_.owner[hit->segment] == b)) gaps.push_back(hit->distance_m);
    }
    if (gaps.size() < 2) return std::nullopt;
    std::sort(gaps.begin(), gaps.end());
    const double gap = gaps.size() == 3 ? gaps[1] : gaps[0];
    if (gap < options_.min_gap_m) return std::nullopt;
    return gap;
  }

  /// A chamfered or rounded corner looks diagonally across the crossing: its own gap says nothing.
  void give_corners_their_neighbours(const Ring& ring, std::vector<BlockEdge>& labels) const {
    const std::size_t n = ring.size();
    const auto edge_length = [&](std::size_t i) { return distance(ring[i], ring[(i + 1) % n]); };
    const std::vector<BlockEdge> before = labels;
    for (std::size_t i = 0; i < n; ++i) {
      if (before[i].street || edge_length(i) >= options_.corner_edge_m) continue;
      const std::size_t previous = (i + n - 1) % n;
      const std::size_t next = (i + 1) % n;
      const std::size_t longer = edge_length(previous) >= edge_length(next) ? previous : next;
      if (edge_length(longer) > edge_length(i) && before[longer].is_street())
        labels[i] = before[longer];
    }
  }

  const StreetNetwork& network_;
  LabelOptions options_;
  Filed contours_;
  Filed streets_;
  std::vector<std::uint32_t> first_edge_;  // of each block in contours_
};

double turn_rad(const Ring& ring, std::size_t vertex) {
  const std::size_t n = ring.size();
  const Point in = ring[vertex] - ring[(vertex + n - 1) % n];
  const Point out = ring[(vertex + 1) % n] - ring[vertex];
  return std::atan2(cross(in, out), dot(in, out));
}

}  // namespace

void number_logical_streets(Block& block, const StreetNetwork& network,
                            double same_street_turn_rad) {
  // Every run of edges that a person would call one street gets a key of its own.
  std::vector<std::vector<std::string>> keys;
  for (std::size_t r = 0; r < block.edges.size(); ++r) {
    const Ring& ring = ring_at(block, r);
    const auto& edges = block.edges[r];
    const std::size_t n = edges.size();
    const auto attributes = [&](std::size_t i) -> const streets::StreetAttributes* {
      return edges[i].street ? &network.streets[edges[i].street->value].attributes : nullptr;
    };
    const auto name = [&](std::size_t i) {
      return attributes(i) == nullptr ? std::string() : attributes(i)->name;
    };
    const auto street_class = [&](std::size_t i) {
      return attributes(i) == nullptr ? std::string() : attributes(i)->street_class;
    };
    const auto continues = [&](std::size_t i) {
      const std::size_t before = (i + n - 1) % n;
      if (!edges[i].is_street() || !edges[before].is_street()) return false;
      if (!name(i).empty() || !name(before).empty()) return name(i) == name(before);
      return street_class(i) == street_class(before) &&
             std::abs(turn_rad(ring, i)) < same_street_turn_rad;
    };
    std::size_t start = 0;
    while (start < n && continues(start)) ++start;
    if (start == n) start = 0;
    std::vector<std::string> row(n);
    std::size_t run = 0;
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t i = (start + k) % n;
      if (k == 0 || !continues(i)) ++run;
      if (edges[i].is_street()) row[i] = std::to_string(run);
    }
    keys.push_back(std::move(row));
  }
  assign_logical_streets(block, keys, same_street_turn_rad);
}

void label_edges(std::span<Block> blocks, const StreetNetwork& network, const LabelOptions& options,
                 Jobs jobs) {
  const Labeller labeller(blocks, network, options);
  parallel_for(blocks.size(), jobs,
               [&](std::size_t b) { labeller.label(blocks[b], static_cast<std::uint32_t>(b)); });
}

}  // namespace plat::blocks
