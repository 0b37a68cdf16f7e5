#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "similarity/candidate_search.h"
#include "tiles/layout_defects.h"
#include "tiles/settling.h"
#include "tiles/tile_destination_internal.h"
#include "tiles/tile_outline_internal.h"
#include "tiles/tile_replacement_internal.h"
#include "tiles/tile_substitution_internal.h"

namespace plat::tiles::detail {
namespace {

/// While a replacement is tried, tiles farther than this from it stay where they are: what a lot
/// does to the next street but one is not worth a solve of the whole city.
constexpr double kTrialReach_m = 120.0;
/// A total error that falls by less than this share did not fall.
constexpr double kFalls_01 = 1e-6;

/// What may be put in the place of tiles: single tiles, or unions of tiles, of the observed city.
class Candidates {
 public:
  explicit Candidates(const ReconfigurationOptions& options) : measure_(measure_of(options)) {}

  void add(TileLayout piece, similarity::LabelledShape shape, std::vector<TileId> ids);
  /// After the last is added.
  void prepare();

  /// Those most similar to a shape, of its zone, nearest first.
  [[nodiscard]] std::vector<std::uint32_t> most_similar(const similarity::LabelledShape& place,
                                                        int count, TileId except) const;
  [[nodiscard]] const TileLayout& piece(std::uint32_t candidate) const {
    return pieces_[candidate];
  }
  [[nodiscard]] similarity::ShapeComparison compare(std::uint32_t candidate,
                                                    const similarity::LabelledShape& place) const;

 private:
  std::vector<TileLayout> pieces_;
  std::vector<similarity::LabelledShape> shapes_;
  std::vector<std::vector<TileId>> ids_;
  similarity::AnyShapeSimilarity measure_;
  std::optional<similarity::CandidateSearch> search_;
};

void Candidates::add(TileLayout piece, similarity::LabelledShape shape, std::vector<TileId> ids) {
  pieces_.push_back(std::move(piece));
  shapes_.push_back(std::move(shape));
  ids_.push_back(std::move(ids));
}

void Candidates::prepare() {
  if (shapes_.empty()) return;
  similarity::Clusters one{std::vector<std::uint32_t>(shapes_.size(), 0), {{}}};
  for (std::uint32_t i = 0; i < shapes_.size(); ++i) one.members.front().push_back(i);
  search_.emplace(shapes_, one, measure_);
}

std::vector<std::uint32_t> Candidates::most_similar(const similarity::LabelledShape& place,
                                                    int count, TileId except) const {
  if (!search_) return {};
  std::vector<std::uint32_t> excluded;
  for (std::uint32_t i = 0; i < ids_.size(); ++i) {
    if (std::ranges::find(ids_[i], except) != ids_[i].end()) excluded.push_back(i);
  }
  const auto found = search_->most_similar(place, {.count = count}, excluded);
  std::vector<std::uint32_t> out;
  if (!found) return out;
  for (const similarity::Candidate& candidate : *found) out.push_back(candidate.shape);
  return out;
}

similarity::ShapeComparison Candidates::compare(std::uint32_t candidate,
                                                const similarity::LabelledShape& place) const {
  const auto a = measure_.prepare(shapes_[candidate]);
  const auto b = measure_.prepare(place);
  if (!a || !b) return {};
  return measure_.compare(*a, *b);
}

bool may_replace(const Tile& tile) { return tile.rings.size() == 1 && tile.zone != kVacantZone; }

TileLayout at_rest(const Tile& tile) {
  TileLayout out;
  Tile copy = tile;
  copy.placement = {};
  copy.rings.resize(1);
  for (Corner& corner : copy.rings.front()) {
    out.vertices.push_back({corner.rest, true});
    corner.vertex = static_cast<std::uint32_t>(out.vertices.size() - 1);
  }
  out.tiles.push_back(std::move(copy));
  return out;
}

/// Tiles, each where it was observed.
Candidates single_tiles(const TileLayout& observed, const EdgeMap& edges,
                        const ReconfigurationOptions& options) {
  Candidates out(options);
  for (const Tile& tile : observed.tiles) {
    if (!may_replace(tile)) continue;
    similarity::LabelledShape shape{rest_shape_of(tile), {}, tile.zone};
    const auto& ring = tile.rings.front();
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const bool is_property = edges.contains({ring[(k + 1) % ring.size()].vertex, ring[k].vertex});
      shape.edges.push_back(is_property ? similarity::EdgeLabel::kProperty
                                        : similarity::EdgeLabel::kStreet);
    }
    out.add(at_rest(tile), std::move(shape), {tile.id});
  }
  out.prepare();
  return out;
}

/// Two tiles as they stand, with the vertices that they share.
TileLayout as_they_stand(const TileLayout& observed, std::pair<std::uint32_t, std::uint32_t> two) {
  TileLayout out;
  std::map<std::uint32_t, std::uint32_t> vertex_of;
  for (const std::uint32_t i : {two.first, two.second}) {
    Tile tile = observed.tiles[i];
    for (Corner& corner : tile.rings.front()) {
      const auto [found, is_new] =
          vertex_of.try_emplace(corner.vertex, static_cast<std::uint32_t>(out.vertices.size()));
      if (is_new) out.vertices.push_back(observed.vertices[corner.vertex]);
      corner.vertex = found->second;
    }
    out.tiles.push_back(std::move(tile));
  }
  return out;
}

/// Unions of two tiles of one zone that have an edge in common.
Candidates unions_of_two(const TileLayout& observed, const EdgeMap& edges,
                         const ReconfigurationOptions& options) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (const auto& [edge, place] : edges) {
    const auto beyond = edges.find({edge.second, edge.first});
    if (beyond == edges.end() || beyond->second.tile <= place.tile) continue;
    const Tile& a = observed.tiles[place.tile];
    const Tile& b = observed.tiles[beyond->second.tile];
    if (may_replace(a) && may_replace(b) && a.zone == b.zone)
      pairs.emplace(place.tile, beyond->second.tile);
  }
  Candidates out(options);
  for (const auto& two : pairs) {
    const auto outline = outline_of(observed, std::vector{two.first, two.second});
    if (!outline) continue;
    out.add(as_they_stand(observed, two), shape_of(observed, *outline, edges),
            {observed.tiles[two.first].id, observed.tiles[two.second].id});
  }
  out.prepare();
  return out;
}

EdgeMap all_edges(const TileLayout& layout) {
  std::vector<std::uint32_t> all(layout.tiles.size());
  for (std::uint32_t i = 0; i < all.size(); ++i) all[i] = i;
  return edges_of(layout, all);
}

/// Tiles turned inside out, with nothing, and pairs that overlap, by ids.
using Defects = std::set<std::pair<TileId, std::optional<TileId>>>;

Defects defects_of(const TileLayout& layout) {
  Defects out;
  for (const TileDefect& defect : find_tile_defects(layout)) {
    TileId first = layout.tiles[defect.tile].id;
    std::optional<TileId> second;
    if (defect.other) {
      second = std::max(first, layout.tiles[*defect.other].id);
      first = std::min(first, layout.tiles[*defect.other].id);
    }
    out.emplace(first, second);
  }
  return out;
}

using HeldById = std::map<TileId, Affine>;

Targets by_index(const TileLayout& layout, const HeldById& held) {
  Targets out;
  for (std::uint32_t i = 0; i < layout.tiles.size(); ++i) {
    if (const auto found = held.find(layout.tiles[i].id); found != held.end())
      out.emplace(i, found->second);
  }
  return out;
}

/// Tiles to be replaced, as they stand.
struct Hole {
  std::vector<std::uint32_t> replaced;  ///< ascending
  similarity::LabelledShape place;      ///< their outline
  double error_within = 0.0;            ///< that vanishes with them
};

/// What became of a candidate.
enum class Trial {
  kReplaced,
  kRefused,  ///< the total error did not fall, or something new overlaps
  kNoPlace,  ///< it could not be laid there, or not solved
};

class Rounds {
 public:
  Rounds(const TileLayout& observed, SolvedLayout start, const Targets& held,
         const ReplacementOptions& replacement, const ReconfigurationOptions& options,
         ReconfigurationReport& report)
      : now_(std::move(start)),
        replacement_(replacement),
        options_(options),
        tiles_(options),
        unions_(options),
        report_(report) {
    const EdgeMap edges = all_edges(observed);
    tiles_ = single_tiles(observed, edges, options);
    if (replacement.unions > 0) unions_ = unions_of_two(observed, edges, options);
    for (const auto& [tile, target] : held) held_.emplace(now_.layout.tiles[tile].id, target);
    now_.layout = settled(std::move(now_.layout));
    defects_ = defects_of(now_.layout);
  }

  void run();
  SolvedLayout take() { return std::move(now_); }

 private:
  [[nodiscard]] std::vector<TileId> over_thresholds() const;
  bool replace(TileId id);
  bool put_in_place(const Candidates& candidates, int count,
                    const std::vector<std::uint32_t>& replaced);
  Trial try_candidate(const Candidates& candidates, std::uint32_t candidate, const Hole& hole);
  [[nodiscard]] double error_within(const std::vector<std::uint32_t>& tiles) const;
  bool solve_all();
  /// The outcome, settled, is the layout from now on, unless it has a defect that it had not.
  bool accept(SolvedLayout outcome);

  SolvedLayout now_;
  const ReplacementOptions& replacement_;
  const ReconfigurationOptions& options_;
  Candidates tiles_;
  Candidates unions_;
  HeldById held_;
  Defects defects_;
  ReconfigurationReport& report_;
};

/// Deformed tiles, the most deformed first.
std::vector<TileId> Rounds::over_thresholds() const {
  const TileLayout& layout = now_.layout;
  const TileGraph graph = graph_of(layout);
  std::vector<double> gap(layout.tiles.size(), 0.0);
  std::vector<int> joints(layout.tiles.size(), 0);
  for (std::size_t k = 0; k < graph.joints.size(); ++k) {
    if (graph.joints[k].kind != JointKind::kProperty) continue;
    for (const std::uint32_t tile : {graph.joints[k].a, graph.joints[k].b}) {
      gap[tile] += now_.solution.gaps_m[k];
      ++joints[tile];
    }
  }
  std::vector<std::pair<double, TileId>> over;
  for (std::uint32_t i = 0; i < layout.tiles.size(); ++i) {
    const Tile& tile = layout.tiles[i];
    if (held_.contains(tile.id) || tile.rings.size() != 1) continue;
    const double deformation = now_.solution.deformations[i];
    const double mean_gap = joints[i] > 0 ? gap[i] / joints[i] : 0.0;
    if (deformation > replacement_.deformation_threshold || mean_gap > replacement_.gap_threshold_m)
      over.emplace_back(-deformation, tile.id);
  }
  std::ranges::sort(over);
  std::vector<TileId> out;
  for (const auto& [deformation, id] : over) out.push_back(id);
  return out;
}

/// What joints between the tiles, and deformations of all but the most deformed of them, add to the
/// objective: it vanishes with them and is no gain.
double Rounds::error_within(const std::vector<std::uint32_t>& tiles) const {
  if (tiles.size() < 2) return 0.0;
  const TileGraph graph = graph_of(now_.layout);
  TileGraph part;
  std::vector<Affine> placements;
  std::map<std::uint32_t, std::uint32_t> index;
  for (const std::uint32_t tile : tiles) {
    index.emplace(tile, static_cast<std::uint32_t>(part.tiles.size()));
    part.tiles.push_back(graph.tiles[tile]);
    placements.push_back(now_.layout.tiles[tile].placement);
  }
  for (Joint joint : graph.joints) {
    const auto a = index.find(joint.a);
    const auto b = index.find(joint.b);
    if (a == index.end() || b == index.end()) continue;
    joint.a = a->second;
    joint.b = b->second;
    part.joints.push_back(joint);
  }
  double largest = 0.0;
  for (std::size_t k = 0; k < part.tiles.size(); ++k) {
    const TileGraph alone{{part.tiles[k]}, {}};
    largest =
        std::max(largest, measure_placements(alone, {placements[k]}, options_.solver).objective);
  }
  return measure_placements(part, std::move(placements), options_.solver).objective - largest;
}

bool Rounds::accept(SolvedLayout outcome) {
  outcome.layout = settled(std::move(outcome.layout));
  Defects defects = defects_of(outcome.layout);
  if (!std::ranges::includes(defects_, defects)) return false;
  defects_ = std::move(defects);
  now_ = std::move(outcome);
  return true;
}

/// Puts a candidate there if the total error then falls and nothing new overlaps.
Trial Rounds::try_candidate(const Candidates& candidates, std::uint32_t candidate,
                            const Hole& hole) {
  auto trial = substituted(now_.layout, {.piece = &candidates.piece(candidate),
                                         .replaced = hole.replaced,
                                         .comparison = candidates.compare(candidate, hole.place),
                                         .as_placed = {},
                                         .unmet = UnmetVertices::kKept});
  if (!trial) return Trial::kNoPlace;
  const auto around = boxes_of(now_.layout, hole.replaced, {});
  const Targets held = held_or_farthest(
      trial->layout,
      held_tiles(trial->layout, by_index(trial->layout, held_), around, kTrialReach_m), around);
  auto outcome = solved(std::move(trial->layout), held, options_.solver);
  if (!outcome) return Trial::kNoPlace;
  const double before = now_.solution.objective - hole.error_within;
  if (outcome->solution.objective >= before * (1.0 - kFalls_01)) return Trial::kRefused;
  return accept(*std::move(outcome)) ? Trial::kReplaced : Trial::kRefused;
}

bool Rounds::put_in_place(const Candidates& candidates, int count,
                          const std::vector<std::uint32_t>& replaced) {
  const auto outline = outline_of(now_.layout, replaced);
  if (!outline) return false;
  const Tile& first = now_.layout.tiles[replaced.front()];
  const Hole hole{replaced,
                  shape_of(now_.layout, *outline, edges_of_block(now_.layout, first.block)),
                  error_within(replaced)};
  for (const std::uint32_t candidate : candidates.most_similar(hole.place, count, first.id)) {
    switch (try_candidate(candidates, candidate, hole)) {
      case Trial::kReplaced:
        ++report_.replacements;
        return true;
      case Trial::kRefused:
        ++report_.replacements_refused;
        break;
      case Trial::kNoPlace:
        ++report_.replacements_without_place;
        break;
    }
  }
  return false;
}

/// One for one, else one for the tile and a neighbour, else two for one.
bool Rounds::replace(TileId id) {
  const auto tile = find_tile(now_.layout, id);
  if (!tile) return false;  // replaced together with a neighbour
  if (put_in_place(tiles_, replacement_.candidates, {*tile})) return true;
  const EdgeMap edges = edges_of_block(now_.layout, now_.layout.tiles[*tile].block);
  std::set<std::uint32_t> neighbours;
  for (const auto& [edge, place] : edges) {
    if (place.tile != *tile) continue;
    const auto beyond = edges.find({edge.second, edge.first});
    if (beyond == edges.end()) continue;
    const Tile& other = now_.layout.tiles[beyond->second.tile];
    if (!held_.contains(other.id) && other.zone == now_.layout.tiles[*tile].zone)
      neighbours.insert(beyond->second.tile);
  }
  for (const std::uint32_t other : neighbours) {
    if (put_in_place(tiles_, replacement_.candidates,
                     {std::min(*tile, other), std::max(*tile, other)}))
      return true;
  }
  return replacement_.unions > 0 && put_in_place(unions_, replacement_.unions, {*tile});
}

/// Solves for all tiles that the operation leaves free; kept if the total error does not rise.
bool Rounds::solve_all() {
  auto outcome = solved(now_.layout, by_index(now_.layout, held_), options_.solver);
  if (!outcome || outcome->solution.objective > now_.solution.objective) return false;
  return accept(*std::move(outcome));
}

void Rounds::run() {
  for (int round = 0; round < replacement_.max_rounds; ++round) {
    bool is_changed = false;
    for (const TileId id : over_thresholds()) is_changed = replace(id) || is_changed;
    if (!is_changed) return;
    solve_all();
    ++report_.rounds;
  }
}

}  // namespace

SolvedLayout with_replacements(const TileLayout& observed, SolvedLayout solution,
                               const Targets& held, const ReplacementOptions& replacement,
                               const ReconfigurationOptions& options,
                               ReconfigurationReport& report) {
  Rounds rounds(observed, std::move(solution), held, replacement, options, report);
  rounds.run();
  return rounds.take();
}

}  // namespace plat::tiles::detail

namespace plat::tiles {

Expected<Reconfiguration> replace_deformed_tiles(const TileLayout& layout,
                                                 const ReplacementOptions& replacement,
                                                 const ReconfigurationOptions& options) {
  ReconfigurationOptions with = options;
  with.replacement = replacement;
  return detail::reconfigured(layout, layout, detail::held_tiles(layout, {}, {}, std::nullopt),
                              with);
}

}  // namespace plat::tiles
