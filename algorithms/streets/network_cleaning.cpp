#include "streets/network_cleaning.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "core/planar_graph.h"
#include "core/working_grid.h"
#include "streets/end_snapping_internal.h"
#include "streets/segment_index.h"

namespace plat::streets {
namespace {

using detail::Way;

constexpr std::uint32_t kNone = 0xffffffffU;

/// A straight piece between two nodes of the network.
struct Piece {
  std::uint32_t from = 0;
  std::uint32_t to = 0;
  std::uint32_t way = 0;
  bool is_removed = false;
};

class NetworkBuilder {
 public:
  NetworkBuilder(std::span<const RawStreet> raw, const CleaningOptions& options)
      : raw_(raw), options_(options) {}

  CleanNetwork build() {
    admit_lines();
    detail::snap_loose_ends(raw_, options_.snap_m, ways_, out_.repairs);
    node_levels();
    file_pieces();
    trim_overshoots();
    file_pieces();
    chain_pieces();
    return std::move(out_);
  }

 private:
  [[nodiscard]] const StreetAttributes& attributes(std::uint32_t way) const {
    return raw_[ways_[way].raw].attributes;
  }
  [[nodiscard]] const std::string& source_id(std::uint32_t way) const {
    return raw_[ways_[way].raw].source_id;
  }
  void report(std::string feature_id, RepairKind kind, Point place, std::string detail) {
    out_.repairs.push_back({std::move(feature_id), kind, place, std::move(detail)});
  }

  void admit_lines() {
    for (std::uint32_t i = 0; i < raw_.size(); ++i) {
      const Polyline& line = raw_[i].line;
      const bool is_usable = std::all_of(line.begin(), line.end(), [](Point p) {
        return std::abs(p.x) <= kGridExtent_m && std::abs(p.y) <= kGridExtent_m;
      });
      if (!is_usable) {
        report(raw_[i].source_id, RepairKind::kNotFinite, {},
               "a coordinate is not finite or farther than 2097 km from the origin");
        continue;
      }
      Way way{i, {}};
      for (const Point p : line) {
        const Point s = snap(p);
        if (way.line.empty() || way.line.back() != s) way.line.push_back(s);
      }
      if (way.line.size() < 2) {
        report(raw_[i].source_id, RepairKind::kZeroLength, line.empty() ? Point{} : snap(line[0]),
               "no length on the 2^-10 m grid");
        continue;
      }
      ways_.push_back(std::move(way));
    }
  }

  struct Level {
    std::vector<Segment> segments;
    std::vector<std::uint32_t> ways;
  };

  /// Each level is noded by itself; the ends of the others cut the ground.
  void node_levels() {
    std::map<int, Level> levels;
    for (std::uint32_t w = 0; w < ways_.size(); ++w) {
      Level& level = levels[attributes(w).level];
      const Polyline& line = ways_[w].line;
      for (std::size_t i = 1; i < line.size(); ++i) {
        level.segments.push_back({line[i - 1], line[i]});
        level.ways.push_back(w);
      }
    }
    if (levels.contains(0) && levels.size() > 1) cut_ground_at_ramps(levels[0]);
    std::vector<PlanarGraph> graphs;
    std::vector<Point>& nodes = out_.network.nodes;
    for (const auto& [number, level] : levels) {
      graphs.push_back(node_segments(level.segments));
      nodes.insert(nodes.end(), graphs.back().nodes.begin(), graphs.back().nodes.end());
    }
    if (graphs.size() > 1) {
      std::sort(nodes.begin(), nodes.end());
      nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    }
    auto graph = graphs.begin();
    for (const auto& [number, level] : levels) {
      add_pieces(*graph, level);
      ++graph;
    }
  }

  void cut_ground_at_ramps(Level& ground) const {
    const SegmentIndex index(ground.segments);
    std::map<std::uint32_t, std::vector<Point>> cuts;
    for (std::uint32_t w = 0; w < ways_.size(); ++w) {
      if (attributes(w).level == 0) continue;
      for (const Point p : {ways_[w].line.front(), ways_[w].line.back()}) {
        const auto hit = index.nearest(p, kGridStep_m, [](std::uint32_t) { return true; });
        if (hit) cuts[hit->segment].push_back(p);
      }
    }
    for (auto& [i, points] : cuts) {
      const Segment whole = ground.segments[i];
      std::sort(points.begin(), points.end(),
                [&](Point p, Point q) { return distance(whole.a, p) < distance(whole.a, q); });
      Point from = whole.a;
      ground.segments[i] = {from, points.front()};
      from = points.front();
      points.push_back(whole.b);
      for (std::size_t k = 1; k < points.size(); ++k) {
        ground.segments.push_back({from, points[k]});
        ground.ways.push_back(ground.ways[i]);
        from = points[k];
      }
    }
  }

  void add_pieces(const PlanarGraph& graph, const Level& level) {
    const std::vector<Point>& nodes = out_.network.nodes;
    std::vector<std::uint32_t> node_of(graph.nodes.size());
    auto at = nodes.begin();
    for (std::size_t v = 0; v < graph.nodes.size(); ++v) {  // both are sorted
      at = std::lower_bound(at, nodes.end(), graph.nodes[v]);
      node_of[v] = static_cast<std::uint32_t>(at - nodes.begin());
    }
    std::vector<std::size_t> kept(ways_.size(), 0);
    for (const PlanarGraph::Edge& e : graph.edges) {
      const std::uint32_t way = level.ways[e.source];
      pieces_.push_back({node_of[e.from], node_of[e.to], way, false});
      ++kept[way];
    }
    struct Lost {
      double length_m = 0.0;
      Point place;
      std::uint32_t other = 0;
    };
    std::map<std::uint32_t, Lost> lost;  // by way
    for (const PlanarGraph::Overlap& overlap : graph.overlaps) {
      const PlanarGraph::Edge& e = graph.edges[overlap.edge];
      const std::uint32_t way = level.ways[overlap.source];
      const std::uint32_t other = level.ways[e.source];
      if (way == other) continue;
      Lost& entry = lost[way];
      entry.length_m += distance(graph.nodes[e.from], graph.nodes[e.to]);
      entry.place = midpoint(graph.nodes[e.from], graph.nodes[e.to]);
      entry.other = other;
    }
    for (const auto& [way, entry] : lost) {
      const bool is_duplicate = kept[way] == 0;
      report(source_id(way), is_duplicate ? RepairKind::kDuplicate : RepairKind::kOverlap,
             entry.place,
             fmt::format("{:.2f} m run along feature {}", entry.length_m, source_id(entry.other)));
    }
  }

  /// Which pieces meet at each node: offsets_ into at_.
  void file_pieces() {
    offsets_.assign(out_.network.nodes.size() + 1, 0);
    for (const Piece& p : pieces_) {
      if (p.is_removed) continue;
      ++offsets_[p.from + 1];
      ++offsets_[p.to + 1];
    }
    std::partial_sum(offsets_.begin(), offsets_.end(), offsets_.begin());
    at_.resize(offsets_.back());
    std::vector<std::uint32_t> next(offsets_.begin(), offsets_.end() - 1);
    for (std::uint32_t i = 0; i < pieces_.size(); ++i) {
      if (pieces_[i].is_removed) continue;
      at_[next[pieces_[i].from]++] = i;
      at_[next[pieces_[i].to]++] = i;
    }
  }
  [[nodiscard]] std::uint32_t degree(std::uint32_t node) const {
    return offsets_[node + 1] - offsets_[node];
  }
  [[nodiscard]] Point place(std::uint32_t node) const { return out_.network.nodes[node]; }

  void trim_overshoots() {
    std::vector<std::uint32_t> pieces_of(ways_.size(), 0);
    for (const Piece& p : pieces_) ++pieces_of[p.way];
    for (Piece& p : pieces_) {
      const double length_m = distance(place(p.from), place(p.to));
      const bool is_stub =
          (degree(p.from) == 1 && degree(p.to) >= 3) || (degree(p.to) == 1 && degree(p.from) >= 3);
      if (!is_stub || length_m >= options_.snap_m || pieces_of[p.way] < 2) continue;
      p.is_removed = true;
      report(source_id(p.way), RepairKind::kOvershoot, place(degree(p.from) == 1 ? p.to : p.from),
             fmt::format("stub of {:.2f} m beyond the crossing", length_m));
    }
  }

  /// The piece that continues `piece` beyond `node` as the same street; kNone at a junction, a dead
  /// end, or where an attribute changes.
  [[nodiscard]] std::uint32_t continuation(std::uint32_t piece, std::uint32_t node) const {
    if (degree(node) != 2) return kNone;
    const std::uint32_t a = at_[offsets_[node]];
    const std::uint32_t b = at_[offsets_[node] + 1];
    const std::uint32_t other = a == piece ? b : a;
    if (other == piece) return kNone;
    const std::uint32_t way = pieces_[piece].way;
    const std::uint32_t other_way = pieces_[other].way;
    return way == other_way || attributes(way) == attributes(other_way) ? other : kNone;
  }

  [[nodiscard]] std::uint32_t far_end(std::uint32_t piece, std::uint32_t node) const {
    return pieces_[piece].from == node ? pieces_[piece].to : pieces_[piece].from;
  }

  void chain_pieces() {
    std::vector<bool> is_used(pieces_.size(), false);
    std::vector<Chain> found;
    for (std::uint32_t start = 0; start < pieces_.size(); ++start) {
      if (is_used[start] || pieces_[start].is_removed) continue;
      // Back to where the street begins; all the way round where it is a closed loop.
      std::uint32_t piece = start;
      std::uint32_t node = pieces_[start].from;
      for (std::uint32_t before = continuation(piece, node); before != kNone && before != start;
           before = continuation(piece, node)) {
        piece = before;
        node = far_end(piece, node);
      }
      found.push_back(walk_street(piece, node, is_used));
      found.back().order = static_cast<std::uint32_t>(found.size());
    }
    std::sort(found.begin(), found.end(), [](const Chain& a, const Chain& b) {
      return std::pair(a.lowest_way, a.order) < std::pair(b.lowest_way, b.order);
    });
    for (auto& [way, order, street] : found) {
      street.id = {static_cast<std::uint32_t>(out_.network.streets.size())};
      out_.network.streets.push_back(std::move(street));
    }
    drop_unused_nodes();
  }

  struct Chain {
    std::uint32_t lowest_way = 0;
    std::uint32_t order = 0;
    Street street;
  };

  Chain walk_street(std::uint32_t piece, std::uint32_t node, std::vector<bool>& is_used) {
    Street street;
    street.from = node;
    street.line.push_back(place(node));
    std::uint32_t lowest_way = pieces_[piece].way;
    bool runs_forward = pieces_[piece].from == node;
    while (piece != kNone && !is_used[piece]) {
      is_used[piece] = true;
      const std::uint32_t way = pieces_[piece].way;
      if (way < lowest_way) {
        lowest_way = way;
        runs_forward = pieces_[piece].from == node;
      }
      node = far_end(piece, node);
      street.line.push_back(place(node));
      const std::uint32_t next = continuation(piece, node);
      if (next != kNone && !is_used[next] && pieces_[next].way != way) {
        report(source_id(pieces_[next].way), RepairKind::kRejoined, place(node),
               fmt::format("continues feature {}", source_id(way)));
      }
      piece = next;
    }
    street.to = node;
    if (!runs_forward) {
      std::reverse(street.line.begin(), street.line.end());
      std::swap(street.from, street.to);
    }
    street.attributes = attributes(lowest_way);
    street.source_id = source_id(lowest_way);
    return {lowest_way, 0, std::move(street)};
  }

  /// Only nodes where a street ends are nodes of the network; the others are points of a line.
  void drop_unused_nodes() {
    StreetNetwork& network = out_.network;
    std::vector<std::uint32_t> new_index(network.nodes.size(), 0);
    for (const Street& s : network.streets) new_index[s.from] = new_index[s.to] = 1;
    std::vector<Point> kept;
    for (std::size_t v = 0; v < network.nodes.size(); ++v) {
      if (new_index[v] == 0) continue;
      new_index[v] = static_cast<std::uint32_t>(kept.size());
      kept.push_back(network.nodes[v]);
    }
    network.nodes = std::move(kept);
    for (Street& s : network.streets) {
      s.from = new_index[s.from];
      s.to = new_index[s.to];
    }
  }

  std::span<const RawStreet> raw_;
  CleaningOptions options_;
  CleanNetwork out_;
  std::vector<Way> ways_;
  std::vector<Piece> pieces_;
  std::vector<std::uint32_t> offsets_;
  std::vector<std::uint32_t> at_;
};

}  // namespace

CleanNetwork build_network(std::span<const RawStreet> raw, const CleaningOptions& options) {
  return NetworkBuilder(raw, options).build();
}

}  // namespace plat::streets
