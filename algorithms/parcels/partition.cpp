#include "parcels/partition.h"

#include <algorithm>
#include <limits>
#include <set>
#include <utility>

#include "parcels/coverage.h"

namespace plat::parcels {
namespace {

/// Faces on the inner side of the contour, found by walking from face to face across cuts only.
std::vector<bool> find_inside(const PlanarGraph& graph, const PlanarFaces& faces,
                              std::size_t contour_size) {
  enum : char { kUnknown, kInside, kOut };
  std::vector<char> state(faces.faces.size(), kUnknown);
  std::vector<std::uint32_t> open;
  const auto mark = [&](std::uint32_t face, char value) {
    if (face == PlanarFaces::kUnbounded || state[face] != kUnknown) return;
    state[face] = value;
    open.push_back(face);
  };
  for (std::uint32_t e = 0; e < graph.edges.size(); ++e) {
    if (graph.edges[e].source >= contour_size) continue;
    mark(faces.face_of[2 * e], kInside);  // contour edges run with the block on their left
    mark(faces.face_of[2 * e + 1], kOut);
  }
  while (!open.empty()) {
    const std::uint32_t f = open.back();
    open.pop_back();
    const auto cross = [&](const std::vector<HalfEdge>& walk) {
      for (const HalfEdge h : walk) {
        if (graph.edges[edge_of(h)].source >= contour_size) mark(faces.face_of[twin(h)], state[f]);
      }
    };
    cross(faces.faces[f].outer);
    for (const auto& island : faces.faces[f].islands) cross(island);
  }
  std::vector<bool> is_inside(state.size());
  for (std::size_t f = 0; f < state.size(); ++f) is_inside[f] = state[f] == kInside;
  return is_inside;
}

/// Nodes in which the contour is not itself after noding: it touches itself there, as it has bent
/// through one of its own vertices or through the end of a cut, or it is drawn farther off its edge
/// than a coverage may be.
std::vector<bool> find_departures(const PlanarGraph& graph, std::span<const Segment> contour) {
  std::vector<int> contour_edges(graph.nodes.size(), 0);
  std::vector<bool> is_departure(graph.nodes.size());
  for (const PlanarGraph::Edge& e : graph.edges) {
    if (e.source >= contour.size()) continue;
    for (const std::uint32_t node : {e.from, e.to}) {
      ++contour_edges[node];
      if (distance(contour[e.source], graph.nodes[node]) > kContourTolerance_m)
        is_departure[node] = true;
    }
  }
  for (std::size_t n = 0; n < is_departure.size(); ++n) {
    if (contour_edges[n] > 2) is_departure[n] = true;
  }
  for (const PlanarGraph::Overlap& o : graph.overlaps) {
    if (o.source >= contour.size()) continue;
    is_departure[graph.edges[o.edge].from] = true;
    is_departure[graph.edges[o.edge].to] = true;
  }
  return is_departure;
}

/// Cuts with a node where the contour is not itself.
std::vector<std::uint32_t> find_bending_cuts(const PlanarGraph& graph,
                                             const std::vector<bool>& is_departure,
                                             std::size_t contour_size) {
  std::vector<std::uint32_t> out;
  for (const PlanarGraph::Edge& e : graph.edges) {
    if (e.source >= contour_size && (is_departure[e.from] || is_departure[e.to]))
      out.push_back(e.source);
  }
  // A cut may have run along the contour only, under another source.
  for (const PlanarGraph::Overlap& o : graph.overlaps) {
    const PlanarGraph::Edge& e = graph.edges[o.edge];
    if (o.source >= contour_size && (is_departure[e.from] || is_departure[e.to]))
      out.push_back(o.source);
  }
  return out;
}

}  // namespace

Expected<BlockPartition> BlockPartition::cut(const blocks::Block& block,
                                             std::span<const Segment> cuts) {
  BlockPartition out;
  out.block_ = &block;
  std::vector<Segment> segments;
  for (std::uint32_t r = 0; r <= block.contour.holes.size(); ++r) {
    const Ring& ring = blocks::ring_at(block, r);
    for (std::uint32_t i = 0; i < ring.size(); ++i) {
      segments.push_back({ring[i], ring[i + 1 == ring.size() ? 0 : i + 1]});
      out.contour_edges_.push_back({r, i});
    }
  }
  const std::size_t contour_size = segments.size();
  segments.insert(segments.end(), cuts.begin(), cuts.end());
  PlanarGraph noded = node_segments(segments);
  // A cut that ends within a grid step of the tip of a spike would close it, and one along a spike
  // may draw its sides off themselves: such cuts are left out, one by one where need be.
  for (;;) {
    const std::vector<bool> is_departure =
        find_departures(noded, std::span(segments).first(contour_size));
    if (std::find(is_departure.begin(), is_departure.end(), true) == is_departure.end()) break;
    const std::vector<std::uint32_t> bending = find_bending_cuts(noded, is_departure, contour_size);
    if (bending.empty())
      return fail(FailureCode::kNotSimple, "the contour touches itself within a grid step");
    for (const std::uint32_t source : bending) segments[source].b = segments[source].a;
    noded = node_segments(segments);
  }
  out.graph_ = without_edges(noded, find_dead_ends(noded));
  const PlanarFaces faces = find_faces(out.graph_);
  out.number_cells(faces, find_inside(out.graph_, faces, contour_size));
  if (out.cell_faces_.empty())
    return fail(FailureCode::kEmptyGeometry, "nothing is left of the block after noding");
  return out;
}

void BlockPartition::number_cells(const PlanarFaces& faces, const std::vector<bool>& is_inside) {
  // Order: first contact with the contour (ring, edge, distance along it), then lowest half-edge
  // for inner cells.
  struct Key {
    ContourEdge edge{0xffffffffU, 0xffffffffU};
    double along = 0.0;
    std::uint32_t face = 0;
    auto operator<=>(const Key&) const = default;
  };
  std::vector<Key> keys;
  for (std::uint32_t f = 0; f < faces.faces.size(); ++f) {
    if (!is_inside[f]) continue;
    Key key{{0xffffffffU, 0xffffffffU}, 0.0, f};
    const auto scan = [&](const std::vector<HalfEdge>& walk) {
      for (const HalfEdge h : walk) {
        const auto edge = contour_edge(edge_of(h));
        if (!edge) continue;
        const Point start = blocks::ring_at(*block_, edge->ring)[edge->index];
        key = std::min(key, Key{*edge, distance(start, graph_.nodes[origin(graph_, h)]), f});
      }
    };
    scan(faces.faces[f].outer);
    for (const auto& island : faces.faces[f].islands) scan(island);
    keys.push_back(key);
  }
  std::sort(keys.begin(), keys.end());

  const std::size_t half_edges = 2 * graph_.edges.size();
  next_.assign(half_edges, 0);
  cell_of_.assign(half_edges, kOutside);
  for (const Key& key : keys) {
    const auto cell = static_cast<std::uint32_t>(cell_faces_.size());
    const Face& face = faces.faces[key.face];
    const auto link = [&](const std::vector<HalfEdge>& walk) {
      for (std::size_t i = 0; i < walk.size(); ++i) {
        next_[walk[i]] = walk[i + 1 == walk.size() ? 0 : i + 1];
        cell_of_[walk[i]] = cell;
      }
    };
    link(face.outer);
    for (const auto& island : face.islands) link(island);
    cell_faces_.push_back(face);
    cell_areas_.push_back(plat::area_m2(polygon_of(graph_, face)));
    region_of_cell_.push_back(cell);
    cells_of_region_.push_back({cell});
  }
  region_areas_ = cell_areas_;
}

std::optional<ContourEdge> BlockPartition::contour_edge(std::uint32_t edge) const {
  const std::uint32_t source = graph_.edges[edge].source;
  if (source >= contour_edges_.size()) return std::nullopt;
  return contour_edges_[source];
}

std::uint32_t BlockPartition::region_left_of(HalfEdge h) const {
  return cell_of_[h] == kOutside ? kOutside : region_of_cell_[cell_of_[h]];
}

Polygon BlockPartition::cell_polygon(std::uint32_t cell) const {
  return polygon_of(graph_, cell_faces_[cell]);
}

std::vector<std::uint32_t> BlockPartition::regions() const {
  std::vector<std::uint32_t> out;
  for (std::uint32_t r = 0; r < cells_of_region_.size(); ++r) {
    if (!cells_of_region_[r].empty()) out.push_back(r);
  }
  return out;
}

std::vector<std::vector<HalfEdge>> BlockPartition::boundary_walks(std::uint32_t region) const {
  const auto is_boundary = [&](HalfEdge h) { return region_left_of(twin(h)) != region; };
  std::vector<HalfEdge> starts;
  for (const std::uint32_t cell : cells_of_region_[region]) {
    const auto collect = [&](const std::vector<HalfEdge>& walk) {
      std::copy_if(walk.begin(), walk.end(), std::back_inserter(starts), is_boundary);
    };
    collect(cell_faces_[cell].outer);
    for (const auto& island : cell_faces_[cell].islands) collect(island);
  }
  std::sort(starts.begin(), starts.end());
  std::vector<bool> is_done(starts.size(), false);
  std::vector<std::vector<HalfEdge>> walks;
  for (std::size_t i = 0; i < starts.size(); ++i) {
    if (is_done[i]) continue;
    std::vector<HalfEdge> walk;
    HalfEdge h = starts[i];
    do {
      walk.push_back(h);
      is_done[static_cast<std::size_t>(std::lower_bound(starts.begin(), starts.end(), h) -
                                       starts.begin())] = true;
      h = next_[h];
      while (!is_boundary(h))
        h = next_[twin(h)];  // turn around the node through the region's inside
    } while (h != starts[i]);
    walks.push_back(std::move(walk));
  }
  return walks;
}

Polygon BlockPartition::polygon(std::uint32_t region) const {
  return polygon_of(graph_, boundary_walks(region));
}

std::vector<BlockPartition::Border> BlockPartition::borders(std::uint32_t region) const {
  std::vector<Border> out;
  for (const std::uint32_t cell : cells_of_region_[region]) {
    const auto collect = [&](const std::vector<HalfEdge>& walk) {
      for (const HalfEdge h : walk) {
        const std::uint32_t other = region_left_of(twin(h));
        if (other == region || other == kOutside) continue;
        out.push_back(
            {other, distance(graph_.nodes[origin(graph_, h)], graph_.nodes[target(graph_, h)])});
      }
    };
    collect(cell_faces_[cell].outer);
    for (const auto& island : cell_faces_[cell].islands) collect(island);
  }
  std::stable_sort(out.begin(), out.end(),
                   [](const Border& a, const Border& b) { return a.neighbour < b.neighbour; });
  std::vector<Border> summed;
  for (const Border& border : out) {
    if (!summed.empty() && summed.back().neighbour == border.neighbour) {
      summed.back().length_m += border.length_m;
    } else {
      summed.push_back(border);
    }
  }
  return summed;
}

std::optional<std::uint32_t> BlockPartition::longest_neighbour(std::uint32_t region) const {
  const std::vector<Border> all = borders(region);
  const auto longest =
      std::max_element(all.begin(), all.end(),
                       [](const Border& a, const Border& b) { return a.length_m < b.length_m; });
  if (longest == all.end()) return std::nullopt;
  return longest->neighbour;
}

double BlockPartition::frontage_m(std::uint32_t region) const {
  double sum = 0.0;
  for (const std::uint32_t cell : cells_of_region_[region]) {
    const auto collect = [&](const std::vector<HalfEdge>& walk) {
      for (const HalfEdge h : walk) {
        const auto edge = contour_edge(edge_of(h));
        if (!edge || !block_->edges[edge->ring][edge->index].is_street()) continue;
        sum += distance(graph_.nodes[origin(graph_, h)], graph_.nodes[target(graph_, h)]);
      }
    };
    collect(cell_faces_[cell].outer);
    for (const auto& island : cell_faces_[cell].islands) collect(island);
  }
  return sum;
}

/// The label of the contour edge that the half-edge lies on, if it faces a street.
const blocks::BlockEdge* BlockPartition::street_at(HalfEdge h) const {
  const auto edge = contour_edge(edge_of(h));
  if (!edge) return nullptr;
  const blocks::BlockEdge& label = block_->edges[edge->ring][edge->index];
  return label.is_street() ? &label : nullptr;
}

std::vector<BlockPartition::Frontage> BlockPartition::fronts(std::uint32_t region) const {
  std::vector<Frontage> out;
  for (const auto& walk : boundary_walks(region)) {
    const auto continues = [&](std::size_t i) {
      const auto* label = street_at(walk[i % walk.size()]);
      const auto* before = street_at(walk[(i + walk.size() - 1) % walk.size()]);
      return label != nullptr && before != nullptr &&
             label->logical_street == before->logical_street;
    };
    std::size_t start = 0;  // a half-edge that does not go on the front of the one before
    while (start < walk.size() && continues(start)) ++start;
    for (std::size_t i = start; i < start + walk.size(); ++i) {
      const HalfEdge h = walk[i % walk.size()];
      const blocks::BlockEdge* label = street_at(h);
      if (label == nullptr) continue;
      if (i == start || !continues(i)) {
        out.push_back({{graph_.nodes[origin(graph_, h)]}, *label->logical_street, 0.0});
      }
      out.back().line.push_back(graph_.nodes[target(graph_, h)]);
      out.back().street_width_m = std::max(out.back().street_width_m, label->street_width_m);
    }
  }
  return out;
}

std::vector<Segment> BlockPartition::inner_edges() const {
  std::vector<Segment> out;
  for (const PlanarGraph::Edge& e : graph_.edges) {
    const auto h = static_cast<HalfEdge>(2 * (&e - graph_.edges.data()));
    const bool is_between = cell_of_[h] != kOutside && cell_of_[twin(h)] != kOutside &&
                            region_left_of(h) != region_left_of(twin(h));
    if (is_between) out.push_back({graph_.nodes[e.from], graph_.nodes[e.to]});
  }
  return out;
}

bool BlockPartition::touches_contour(std::uint32_t region) const {
  for (const auto& walk : boundary_walks(region)) {
    for (const HalfEdge h : walk) {
      if (contour_edge(edge_of(h))) return true;
    }
  }
  return false;
}

void BlockPartition::join(std::uint32_t region, std::uint32_t other) {
  expects(region != other, "a region joins another one");
  for (const std::uint32_t cell : cells_of_region_[other]) region_of_cell_[cell] = region;
  auto& cells = cells_of_region_[region];
  cells.insert(cells.end(), cells_of_region_[other].begin(), cells_of_region_[other].end());
  cells_of_region_[other].clear();
  region_areas_[region] += region_areas_[other];
}

void BlockPartition::join_while(const IsRegion& must_join, const Heir& heir) {
  using Entry = std::pair<double, std::uint32_t>;
  std::set<Entry> open;
  const auto consider = [&](std::uint32_t region) {
    if (must_join(region)) open.emplace(region_areas_[region], region);
  };
  for (const std::uint32_t region : regions()) consider(region);
  while (!open.empty()) {
    const std::uint32_t region = open.begin()->second;
    open.erase(open.begin());
    const auto neighbour = heir ? heir(region) : longest_neighbour(region);
    if (!neighbour) continue;
    open.erase({region_areas_[*neighbour], *neighbour});
    join(*neighbour, region);
    consider(*neighbour);
  }
}

void BlockPartition::join_slivers(double area_m2) {
  join_while([&](std::uint32_t region) { return region_areas_[region] < area_m2; });
}

std::vector<Parcel> BlockPartition::parcels() const {
  // A node stays in the rings if three or more boundaries meet in it, if the two that meet there
  // bend, or if it is a vertex of the contour.
  struct Meeting {
    int count = 0;
    std::uint32_t ends[2] = {0, 0};
    std::uint32_t sources[2] = {0, 0};
  };
  std::vector<Meeting> meetings(graph_.nodes.size());
  for (std::uint32_t e = 0; e < graph_.edges.size(); ++e) {
    if (region_left_of(2 * e) == region_left_of(2 * e + 1)) continue;
    const auto meet = [&](std::uint32_t at, std::uint32_t other) {
      Meeting& m = meetings[at];
      if (m.count < 2) {
        m.ends[m.count] = other;
        m.sources[m.count] = graph_.edges[e].source;
      }
      ++m.count;
    };
    meet(graph_.edges[e].from, graph_.edges[e].to);
    meet(graph_.edges[e].to, graph_.edges[e].from);
  }
  const auto is_kept = [&](std::uint32_t node) {
    const Meeting& m = meetings[node];
    const bool is_contour_vertex =
        m.sources[0] != m.sources[1] && m.sources[0] < contour_edges_.size();
    return m.count != 2 || is_contour_vertex ||
           orientation(graph_.nodes[m.ends[0]], graph_.nodes[node], graph_.nodes[m.ends[1]]) != 0.0;
  };
  std::vector<Parcel> out;
  for (const std::uint32_t region : regions()) {
    Parcel parcel{ParcelId{static_cast<std::uint32_t>(out.size())}, {}};
    double outer_area = 0.0;
    for (const auto& walk : boundary_walks(region)) {
      for (const auto& part : split_at_repeated_nodes(graph_, walk)) {
        Ring ring;
        for (const HalfEdge h : part) {
          if (is_kept(origin(graph_, h))) ring.push_back(graph_.nodes[origin(graph_, h)]);
        }
        const double area = signed_area_m2(ring);
        if (area < 0.0) {
          parcel.shape.holes.push_back(std::move(ring));
        } else if (area > outer_area) {
          outer_area = area;
          parcel.shape.outer = std::move(ring);
        }
      }
    }
    out.push_back(std::move(parcel));
  }
  return out;
}

}  // namespace plat::parcels
