#include "synthesis/network_cut.h"

#include <algorithm>
#include <utility>

#include "core/working_grid.h"

namespace plat::synthesis {
namespace {

using streets::Street;
using streets::StreetNetwork;

/// Where `edge` meets `segment`, as parameters along the segment; both ends where they overlap.
void add_meetings(const Segment& segment, const Segment& edge, std::vector<double>& parameters) {
  const Point d = segment.b - segment.a;
  const Point e = edge.b - edge.a;
  const double denominator = cross(d, e);
  if (denominator == 0.0) {
    for (const Point end : {edge.a, edge.b}) {
      if (orientation(segment.a, segment.b, end) != 0.0) continue;
      const double t = dot(end - segment.a, d) / squared_length(d);
      if (t > 0.0 && t < 1.0) parameters.push_back(t);
    }
    return;
  }
  const Point w = edge.a - segment.a;
  const double along_segment = cross(w, e) / denominator;
  const double along_edge = cross(w, d) / denominator;
  if (along_segment < 0.0 || along_segment > 1.0 || along_edge < 0.0 || along_edge > 1.0) return;
  parameters.push_back(along_segment);
}

/// A run of a street's line between two meetings with the boundary.
struct Run {
  Polyline line;
  bool is_inside = false;
};

class Cutter {
 public:
  explicit Cutter(const Polygon& region) : region_(region), box_(box_of(region)) {
    for_each_edge(region, [&](const Segment& edge) { edges_.push_back(edge); });
  }

  [[nodiscard]] std::vector<Run> runs_of(const Polyline& line) const {
    std::vector<Run> runs;
    Run run{{line.front()}, false};
    const auto close = [&](Point middle) {
      run.is_inside = locate(region_, middle) == Side::kInside;
      const Point last = run.line.back();
      if (run.line.size() > 1) runs.push_back(std::move(run));
      run = Run{{last}, false};
    };
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      const Segment segment{line[i], line[i + 1]};
      double from = 0.0;
      for (const double t : meetings_of(segment)) {
        const Point at = snap(lerp(segment.a, segment.b, t));
        if (at != run.line.back()) run.line.push_back(at);
        const bool is_start = t == 0.0;
        // At the start of a segment the run that ends lies on the segment before.
        close(is_start && i > 0 ? midpoint(line[i - 1], line[i])
                                : lerp(segment.a, segment.b, 0.5 * (from + t)));
        from = t;
      }
      if (segment.b != run.line.back()) run.line.push_back(segment.b);
      if (i + 2 == line.size()) close(lerp(segment.a, segment.b, 0.5 * (from + 1.0)));
    }
    return runs;
  }

  [[nodiscard]] bool is_near(const Polyline& line) const {
    return box_of(std::span<const Point>(line)).intersects(box_);
  }

 private:
  [[nodiscard]] std::vector<double> meetings_of(const Segment& segment) const {
    std::vector<double> out;
    Box box;
    box.add(segment.a);
    box.add(segment.b);
    if (!box.intersects(box_)) return out;
    for (const Segment& edge : edges_) add_meetings(segment, edge, out);
    std::ranges::sort(out);
    const auto repeated = std::ranges::unique(out);
    out.erase(repeated.begin(), repeated.end());
    return out;
  }

  const Polygon& region_;
  Box box_;
  std::vector<Segment> edges_;
};

/// The ring with those places as vertices that lie within a grid step of an edge.
Ring with_vertices(const Ring& ring, std::span<const Point> places) {
  Ring out;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Segment edge{ring[i], ring[i + 1 == ring.size() ? 0 : i + 1]};
    std::vector<std::pair<double, Point>> on_edge;
    for (const Point p : places) {
      if (p != edge.a && p != edge.b && distance(edge, p) < kGridStep_m) {
        on_edge.emplace_back(nearest_parameter(edge, p), p);
      }
    }
    std::ranges::sort(on_edge);
    out.push_back(edge.a);
    for (const auto& [t, p] : on_edge) {
      if (out.back() != p) out.push_back(p);
    }
  }
  return out;
}

struct Piece {
  std::size_t street = 0;  ///< of the network that is cut
  Polyline line;
};

std::uint32_t number_of(const std::vector<Point>& nodes, Point place) {
  return static_cast<std::uint32_t>(std::ranges::lower_bound(nodes, place) - nodes.begin());
}

StreetNetwork network_of(const StreetNetwork& network, std::vector<Piece> pieces) {
  StreetNetwork out;
  for (const Piece& piece : pieces) {
    out.nodes.push_back(piece.line.front());
    out.nodes.push_back(piece.line.back());
  }
  std::ranges::sort(out.nodes);
  const auto repeated = std::ranges::unique(out.nodes);
  out.nodes.erase(repeated.begin(), repeated.end());
  for (Piece& piece : pieces) {
    Street street = network.streets[piece.street];
    street.id = StreetId{static_cast<std::uint32_t>(out.streets.size())};
    street.from = number_of(out.nodes, piece.line.front());
    street.to = number_of(out.nodes, piece.line.back());
    street.line = std::move(piece.line);
    out.streets.push_back(std::move(street));
  }
  return out;
}

}  // namespace

NetworkCut cut_out(const StreetNetwork& network, const Polygon& region) {
  const Cutter cutter(region);
  NetworkCut out;
  std::vector<Piece> pieces;
  std::vector<Point> cuts;
  for (std::size_t s = 0; s < network.streets.size(); ++s) {
    const Polyline& line = network.streets[s].line;
    std::vector<Run> runs;
    if (cutter.is_near(line)) runs = cutter.runs_of(line);
    if (std::ranges::none_of(runs, &Run::is_inside)) {
      pieces.push_back({s, line});
      continue;
    }
    ++out.cut_streets;
    for (std::size_t r = 0; r < runs.size(); ++r) {
      if (runs[r].is_inside) continue;
      const bool goes_on = r > 0 && !runs[r - 1].is_inside;
      if (goes_on) {
        Polyline& whole = pieces.back().line;
        whole.insert(whole.end(), runs[r].line.begin() + 1, runs[r].line.end());
      } else {
        pieces.push_back({s, runs[r].line});
        if (r > 0) cuts.push_back(runs[r].line.front());
      }
      if (r + 1 < runs.size() && runs[r + 1].is_inside) cuts.push_back(runs[r].line.back());
    }
  }
  out.network = network_of(network, std::move(pieces));
  std::ranges::sort(cuts);
  const auto repeated = std::ranges::unique(cuts);
  cuts.erase(repeated.begin(), repeated.end());
  out.region.outer = with_vertices(region.outer, cuts);
  for (const Ring& hole : region.holes) out.region.holes.push_back(with_vertices(hole, cuts));
  for (const Point cut : cuts) out.cut_nodes.push_back(number_of(out.network.nodes, cut));
  return out;
}

}  // namespace plat::synthesis
