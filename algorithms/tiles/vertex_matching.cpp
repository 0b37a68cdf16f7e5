#include "tiles/vertex_matching.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include "core/working_grid.h"
#include "tiles/cell_index_internal.h"

namespace plat::tiles {
namespace {

/// Smallest cell of an index, where the tolerance is zero.
constexpr double kCellMin_m = 1.0;

/// A place that corners have exactly in common.
struct Site {
  Point at;
  std::vector<std::uint32_t> tiles;  ///< ascending
};

/// Sites that become one vertex.
struct Cluster {
  std::vector<std::uint32_t> sites;
  std::vector<std::uint32_t> tiles;  ///< ascending, each once
};

std::vector<Site> sites_of(std::span<const Polygon> shapes) {
  std::vector<std::pair<Point, std::uint32_t>> corners;
  for (std::uint32_t t = 0; t < shapes.size(); ++t)
    for_each_edge(shapes[t], [&](const Segment& s) { corners.emplace_back(s.a, t); });
  std::ranges::sort(corners);
  std::vector<Site> sites;
  for (const auto& [at, tile] : corners) {
    if (sites.empty() || sites.back().at != at) sites.push_back({at, {}});
    sites.back().tiles.push_back(tile);
  }
  return sites;
}

CellIndex index_of(const std::vector<Site>& sites, double tolerance_m) {
  std::vector<Box> boxes;
  boxes.reserve(sites.size());
  for (const Site& site : sites) boxes.push_back({site.at, site.at});
  return {std::move(boxes), std::max(kCellMin_m, tolerance_m)};
}

bool share_a_tile(const Cluster& a, const Cluster& b) {
  std::vector<std::uint32_t> both;
  std::ranges::set_intersection(a.tiles, b.tiles, std::back_inserter(both));
  return !both.empty();
}

/// Sites united nearest first; a union keeps all its sites within the tolerance of each other.
class Clustering {
 public:
  Clustering(const std::vector<Site>& sites, double tolerance_m)
      : sites_(sites), tolerance_m_(tolerance_m) {
    clusters_.reserve(sites.size());
    for (std::uint32_t s = 0; s < sites.size(); ++s) {
      clusters_.push_back({{s}, sites[s].tiles});
      cluster_of_.push_back(s);
    }
    for (const auto& [squared, a, b] : near_pairs()) unite(cluster_of_[a], cluster_of_[b]);
  }

  /// Per site, its vertex; vertices are numbered by their first site.
  [[nodiscard]] std::vector<std::uint32_t> vertices() const {
    constexpr std::uint32_t kNone = ~0U;
    std::vector<std::uint32_t> number(clusters_.size(), kNone);
    std::vector<std::uint32_t> out;
    std::uint32_t next = 0;
    for (const std::uint32_t cluster : cluster_of_) {
      if (number[cluster] == kNone) number[cluster] = next++;
      out.push_back(number[cluster]);
    }
    return out;
  }

 private:
  [[nodiscard]] std::vector<std::tuple<double, std::uint32_t, std::uint32_t>> near_pairs() const {
    std::vector<std::tuple<double, std::uint32_t, std::uint32_t>> pairs;
    const CellIndex index = index_of(sites_, tolerance_m_);
    for (std::uint32_t a = 0; a < sites_.size(); ++a) {
      const Box box = Box{sites_[a].at, sites_[a].at}.expanded(tolerance_m_);
      for (const std::uint32_t b : index.near(box)) {
        const double squared = squared_length(sites_[a].at - sites_[b].at);
        if (b > a && squared <= tolerance_m_ * tolerance_m_) pairs.emplace_back(squared, a, b);
      }
    }
    std::ranges::sort(pairs);
    return pairs;
  }

  void unite(std::uint32_t a, std::uint32_t b) {
    if (a == b || share_a_tile(clusters_[a], clusters_[b])) return;
    for (const std::uint32_t s : clusters_[a].sites) {
      for (const std::uint32_t t : clusters_[b].sites) {
        if (distance(sites_[s].at, sites_[t].at) > tolerance_m_) return;
      }
    }
    for (const std::uint32_t s : clusters_[b].sites) {
      clusters_[a].sites.push_back(s);
      cluster_of_[s] = a;
    }
    std::vector<std::uint32_t> tiles;
    std::ranges::set_union(clusters_[a].tiles, clusters_[b].tiles, std::back_inserter(tiles));
    clusters_[a].tiles = std::move(tiles);
    clusters_[b] = {};
  }

  const std::vector<Site>& sites_;
  double tolerance_m_;
  std::vector<Cluster> clusters_;
  std::vector<std::uint32_t> cluster_of_;
};

using Edge = std::pair<std::uint32_t, std::uint32_t>;

template <class Visit>
void for_each_edge(const std::vector<std::vector<Corner>>& rings, Visit visit) {
  for (std::size_t r = 0; r < rings.size(); ++r) {
    for (std::size_t i = 0; i < rings[r].size(); ++i)
      visit(r, i, rings[r][i], rings[r][(i + 1) % rings[r].size()]);
  }
}

/// Puts vertices into the edges that they are near to.
class Insertion {
 public:
  Insertion(MatchedRings& matched, double tolerance_m)
      : matched_(matched), tolerance_m_(tolerance_m), means_(matched.vertex_count) {
    std::vector<double> count(matched.vertex_count, 0.0);
    for (const auto& tile : matched.tiles) {
      for_each_edge(tile, [&](std::size_t, std::size_t, const Corner& a, const Corner& b) {
        means_[a.vertex] = means_[a.vertex] + a.rest;
        count[a.vertex] += 1.0;
        edges_.emplace_back(a.vertex, b.vertex);
      });
    }
    for (std::size_t v = 0; v < means_.size(); ++v) means_[v] = means_[v] / count[v];
    std::ranges::sort(edges_);
  }

  void run() {
    std::vector<Box> boxes;
    boxes.reserve(means_.size());
    for (const Point mean : means_) boxes.push_back({mean, mean});
    const CellIndex index(std::move(boxes), std::max(kCellMin_m, 4.0 * tolerance_m_));
    for (auto& tile : matched_.tiles) insert(tile, index);
  }

 private:
  struct Candidate {
    double off_m = 0.0;
    std::size_t ring = 0;
    std::size_t edge = 0;
    double along_01 = 0.0;
  };

  void insert(std::vector<std::vector<Corner>>& tile, const CellIndex& index) const {
    std::vector<std::uint32_t> own;
    for_each_edge(tile, [&](std::size_t, std::size_t, const Corner& a, const Corner&) {
      own.push_back(a.vertex);
    });
    std::ranges::sort(own);
    std::map<std::uint32_t, Candidate> nearest;  // by vertex
    for_each_edge(tile, [&](std::size_t r, std::size_t i, const Corner& a, const Corner& b) {
      if (std::ranges::binary_search(edges_, Edge{b.vertex, a.vertex})) return;
      const Segment edge{means_[a.vertex], means_[b.vertex]};
      Box box;
      box.add(edge.a);
      box.add(edge.b);
      for (const std::uint32_t v : index.near(box.expanded(tolerance_m_))) {
        if (std::ranges::binary_search(own, v)) continue;
        const double along = nearest_parameter(edge, means_[v]);
        const double off = distance(edge, means_[v]);
        if (off > tolerance_m_ || along <= 0.0 || along >= 1.0) continue;
        const auto [it, is_new] = nearest.try_emplace(v, Candidate{off, r, i, along});
        if (!is_new && off < it->second.off_m) it->second = {off, r, i, along};
      }
    });
    if (!nearest.empty()) tile = with_inserted(tile, nearest);
  }

  static std::vector<std::vector<Corner>> with_inserted(
      const std::vector<std::vector<Corner>>& tile,
      const std::map<std::uint32_t, Candidate>& nearest) {
    std::vector<std::tuple<std::size_t, std::size_t, double, std::uint32_t>> places;
    for (const auto& [v, candidate] : nearest)
      places.emplace_back(candidate.ring, candidate.edge, candidate.along_01, v);
    std::ranges::sort(places);
    std::vector<std::vector<Corner>> out(tile.size());
    auto next = places.begin();
    for_each_edge(tile, [&](std::size_t r, std::size_t i, const Corner& a, const Corner& b) {
      out[r].push_back(a);
      for (; next != places.end() && std::get<0>(*next) == r && std::get<1>(*next) == i; ++next) {
        const auto& [ring, edge, along, v] = *next;
        out[r].push_back({v, snap(lerp(a.rest, b.rest, along))});
      }
    });
    return out;
  }

  MatchedRings& matched_;
  double tolerance_m_;
  std::vector<Point> means_;
  std::vector<Edge> edges_;  ///< directed, of all tiles, before insertion
};

}  // namespace

MatchedRings match_vertices(std::span<const Polygon> shapes, double tolerance_m) {
  const std::vector<Site> sites = sites_of(shapes);
  const std::vector<std::uint32_t> vertices = Clustering(sites, tolerance_m).vertices();
  const auto corners_of = [&](const Ring& ring) {
    std::vector<Corner> corners;
    for (const Point p : ring) {
      const auto site = std::ranges::lower_bound(sites, p, {}, &Site::at);
      corners.push_back({vertices[static_cast<std::size_t>(site - sites.begin())], p});
    }
    return corners;
  };
  MatchedRings out;
  for (const std::uint32_t v : vertices) out.vertex_count = std::max(out.vertex_count, v + 1);
  for (const Polygon& shape : shapes) {
    auto& rings = out.tiles.emplace_back();
    rings.push_back(corners_of(shape.outer));
    for (const Ring& hole : shape.holes) rings.push_back(corners_of(hole));
  }
  Insertion(out, tolerance_m).run();
  return out;
}

}  // namespace plat::tiles
