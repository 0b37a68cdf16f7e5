#include "harness/reconfigure_session.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "tiles/tile_graph.h"

namespace plat::harness {
namespace {

using tiles::TileId;
using tiles::TileLayout;

bool holds_one(const Polygon& shape, const std::vector<Point>& points, Point origin) {
  return std::ranges::any_of(points,
                             [&](Point p) { return locate(shape, p - origin) != Side::kOutside; });
}

/// Ids and source ids that a selection gives and no tile has.
std::optional<std::string> missing_name(const ScriptTiles& selection, const TileLayout& layout) {
  for (const TileId id : selection.ids) {
    if (!tiles::find_tile(layout, id)) return fmt::format("there is no tile {}", id.value);
  }
  for (const std::string& source : selection.source_ids) {
    if (std::ranges::find(layout.tiles, source, &tiles::Tile::source_id) == layout.tiles.end())
      return fmt::format("there is no tile of source id \"{}\"", source);
  }
  return std::nullopt;
}

bool is_selected(const ScriptTiles& selection, const TileLayout& layout, const tiles::Tile& tile,
                 Point origin) {
  const auto names = [](const auto& list, const auto& value) {
    return list.empty() || std::ranges::find(list, value) != list.end();
  };
  if (!names(selection.ids, tile.id) || !names(selection.source_ids, tile.source_id)) return false;
  if (selection.zone && tile.zone != *selection.zone) return false;
  if (selection.points.empty() && !selection.area && !selection.circle) return true;
  const Polygon shape = tiles::shape_of(layout, tile);
  if (!selection.points.empty() && !holds_one(shape, selection.points, origin)) return false;
  const Point center = origin + centroid(shape);
  if (selection.area && locate(*selection.area, center) == Side::kOutside) return false;
  return !selection.circle ||
         distance(selection.circle->center, center) <= selection.circle->radius_m;
}

/// The centre of mass of tiles as they are now.
Point center_of(const TileLayout& layout, const std::vector<TileId>& ids) {
  Point sum{};
  double area = 0.0;
  for (const TileId id : ids) {
    const Polygon shape = tiles::shape_of(layout, layout.tiles[*tiles::find_tile(layout, id)]);
    const double weight = area_m2(shape);
    sum = sum + weight * centroid(shape);
    area += weight;
  }
  return area > 0.0 ? sum / area : sum;
}

Affine map_of(const ScriptMotion& motion, Point center, Point origin) {
  const Point about = motion.about ? *motion.about - origin : center;
  const Affine turn = Affine::rotation(motion.angle_rad, about);
  if (!motion.to) return Affine::translation(motion.by) * turn;
  return Affine::translation(*motion.to - origin - turn(center)) * turn;
}

std::vector<TileId> ids_of(const TileLayout& layout) {
  std::vector<TileId> out;
  for (const tiles::Tile& tile : layout.tiles) out.push_back(tile.id);
  return out;
}

}  // namespace

Expected<std::vector<TileId>> selected_tiles(const ScriptTiles& selection, const TileLayout& layout,
                                             const geodata::LocalFrame& frame) {
  if (const auto missing = missing_name(selection, layout))
    return fail(FailureCode::kUnknownEntity, *missing);
  std::vector<TileId> out;
  for (const tiles::Tile& tile : layout.tiles) {
    if (is_selected(selection, layout, tile, frame.origin)) out.push_back(tile.id);
  }
  if (out.empty())
    return fail(FailureCode::kUnknownEntity,
                fmt::format("{}: no tile is selected", selection.path));
  std::ranges::sort(out);
  return out;
}

/// Carries out one step after the other.
class ReconfigureSession::Runner {
 public:
  Runner(ReconfigureSession& session, const ReconfigureStep& step)
      : session_(session), step_(step) {}

  Expected<StepReport> operator()(const MoveStep& move) {
    return selected(move.tiles, [&](const std::vector<TileId>& ids) {
      const Affine motion = map_of(move.motion, center_of(layout(), ids), session_.frame_.origin);
      return apply(editing::MoveTiles{ids, motion, step_.options}, ids.size());
    });
  }

  Expected<StepReport> operator()(const CopyStep& copy) {
    return selected(copy.tiles, [&](const std::vector<TileId>& ids) -> Expected<StepReport> {
      return keep_group(copy.name, ids).map([&] { return StepReport{ids.size(), {}, {}}; });
    });
  }

  Expected<StepReport> operator()(const CutStep& cut) {
    return selected(cut.tiles, [&](const std::vector<TileId>& ids) -> Expected<StepReport> {
      const auto groups = session_.groups_;
      if (cut.name) {
        if (auto kept = keep_group(*cut.name, ids); !kept)
          return tl::unexpected<Failure>(std::move(kept.error()));
      }
      auto report = apply(editing::CutTiles{ids, cut.land, step_.options}, ids.size());
      if (!report) session_.groups_ = groups;
      return report;
    });
  }

  Expected<StepReport> operator()(const PasteStep& paste) {
    const auto it = session_.groups_.find(paste.name);
    if (it == session_.groups_.end()) {
      return fail(FailureCode::kUnknownEntity,
                  fmt::format("there is no \"{}\": what was to copy it was refused", paste.name));
    }
    const TileLayout& group = it->second->tiles;
    const Affine to = map_of(paste.motion, center_of(group, ids_of(group)), session_.frame_.origin);
    return apply(editing::PasteTiles{it->second, to, step_.options}, group.tiles.size());
  }

  Expected<StepReport> operator()(const PinStep& pin) {
    return selected(pin.tiles, [&](const std::vector<TileId>& ids) {
      return apply(editing::PinTiles{ids, editing::Pinning::kPinned}, ids.size());
    });
  }

  Expected<StepReport> operator()(const UnpinStep& unpin) {
    return selected(unpin.tiles, [&](const std::vector<TileId>& ids) {
      return apply(editing::PinTiles{ids, editing::Pinning::kFree}, ids.size());
    });
  }

  Expected<StepReport> operator()(const ReplaceStep& replace) {
    return apply(editing::ReplaceTiles{replace.replacement, step_.options}, 0);
  }

  Expected<StepReport> operator()(const RelaxStep&) {
    return apply(editing::RelaxTiles{step_.options}, 0);
  }

  Expected<StepReport> operator()(const UndoStep&) {
    if (session_.editor_.undo_count() == 0)
      return fail(FailureCode::kUnknownEntity, "there is nothing to undo");
    session_.editor_.undo();
    return StepReport{};
  }

  Expected<StepReport> operator()(const RedoStep&) {
    if (session_.editor_.redo_count() == 0)
      return fail(FailureCode::kUnknownEntity, "there is nothing to redo");
    session_.editor_.redo();
    return StepReport{};
  }

 private:
  [[nodiscard]] const TileLayout& layout() const { return *session_.city().tiles(); }

  template <class Use>
  Expected<StepReport> selected(const ScriptTiles& selection, Use use) {
    return selected_tiles(selection, layout(), session_.frame_).and_then(use);
  }

  Expected<void> keep_group(const std::string& name, const std::vector<TileId>& ids) {
    auto group = tiles::copy_tiles(layout(), ids);
    if (!group) return tl::unexpected<Failure>(std::move(group.error()));
    session_.groups_[name] = std::make_shared<const tiles::TileGroup>(*std::move(group));
    return {};
  }

  Expected<StepReport> apply(const editing::Edit& edit, std::size_t named) {
    const auto before = session_.city().tiles();
    auto report = session_.editor_.apply(edit);
    if (!report) return tl::unexpected<Failure>(std::move(report.error()));
    StepReport out{named, *std::move(report), {}};
    if (out.edit.tiles) {
      std::vector<Affine> placements;
      for (const tiles::Tile& tile : before->tiles) placements.push_back(tile.placement);
      out.before = tiles::measure_placements(tiles::graph_of(*before), std::move(placements),
                                             step_.options.solver);
    }
    return out;
  }

  ReconfigureSession& session_;
  const ReconfigureStep& step_;
};

Expected<StepReport> ReconfigureSession::run(const ReconfigureStep& step) {
  expects(city().tiles() != nullptr, "the city has tiles");
  return std::visit(Runner(*this, step), step.what);
}

}  // namespace plat::harness
