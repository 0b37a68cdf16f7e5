#include "editing/editor.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <span>

#include "core/working_grid.h"
#include "editing/block_update_internal.h"
#include "editing/network_edit_internal.h"
#include "editing/street_following.h"
#include "parcels/block_subdivider.h"

namespace plat::editing {
namespace {

/// Farther from the frame's origin than any city reaches, metres.
constexpr double kMaxCoordinate_m = 1e6;
constexpr double kMinFactor = 0.01;
constexpr double kMaxFactor = 100.0;

tl::unexpected<Failure> unknown(std::string_view what, std::uint32_t id) {
  return fail(FailureCode::kUnknownEntity, fmt::format("there is no {} {}", what, id));
}

tl::unexpected<Failure> out_of_range(std::string_view what, double value, double low, double high) {
  return fail(FailureCode::kOutOfRange,
              fmt::format("{} = {}, allowed {} to {}", what, value, low, high));
}

bool is_usable(Point p) {
  return std::abs(p.x) <= kMaxCoordinate_m && std::abs(p.y) <= kMaxCoordinate_m;  // not for NaN
}

/// Applies one kind of edit after the other to a change.
class Application {
 public:
  explicit Application(Change& change) : change_(change), network_(change), blocks_(change) {}

  Expected<EditReport> operator()(const MoveNode& edit) {
    if (!has(edit.node)) return unknown("node", edit.node.value);
    if (!is_usable(edit.to)) return bad_point(edit.to);
    if (!(edit.snap_m >= 0.0 && edit.snap_m <= kMaxSnap_m))
      return out_of_range("snap_m", edit.snap_m, 0.0, kMaxSnap_m);
    if (edit.snap_m > 0.0 && network_.join_near(edit.node, edit.to, edit.snap_m)) return settled();
    const Point by = edit.to - city().nodes().at(edit.node).position;
    network_.move_nodes(std::array{edit.node}, [by](Point p) { return p + by; });
    return settled();
  }

  Expected<EditReport> operator()(const MoveStreet& edit) {
    if (!has(edit.street)) return unknown("street", edit.street.value);
    if (!is_usable(edit.by)) return bad_point(edit.by);
    const CityStreet& street = city().streets().at(edit.street);
    network_.move_nodes(std::array{street.from, street.to},
                        [by = edit.by](Point p) { return p + by; });
    return settled();
  }

  Expected<EditReport> operator()(const BendStreet& edit) {
    if (!has(edit.street)) return unknown("street", edit.street.value);
    if (edit.curve) {
      for (const Point p : {edit.curve->first, edit.curve->second}) {
        if (!is_usable(p)) return bad_point(p);
      }
    }
    network_.bend(edit.street, edit.curve);
    return settled();
  }

  Expected<EditReport> operator()(const AddStreet& edit) {
    for (const Point p : {edit.from, edit.to}) {
      if (!is_usable(p)) return bad_point(p);
    }
    if (!is_width(edit.width_m)) return bad_width(edit.width_m);
    if (!(edit.snap_m >= 0.0 && edit.snap_m <= kMaxSnap_m))
      return out_of_range("snap_m", edit.snap_m, 0.0, kMaxSnap_m);
    if (auto added = network_.add(edit); !added) return tl::unexpected<Failure>(added.error());
    return settled();
  }

  Expected<EditReport> operator()(const RemoveStreet& edit) {
    if (!has(edit.street)) return unknown("street", edit.street.value);
    network_.remove(edit.street);
    return settled();
  }

  Expected<EditReport> operator()(const SetStreetWidth& edit) {
    if (!has(edit.street)) return unknown("street", edit.street.value);
    if (!is_width(edit.width_m)) return bad_width(edit.width_m);
    network_.resize(edit.street, edit.width_m);
    return settled();
  }

  Expected<EditReport> operator()(const SetBlockStyle& edit) {
    static_cast<void>(parcels::block_subdividers().make(edit.style.strategy, edit.style.options));
    std::vector<BlockId> ids = edit.blocks;
    for (const BlockId id : ids) {
      if (!city().blocks().contains(id)) return unknown("block", id.value);
    }
    if (ids.empty())
      city().blocks().for_each([&](BlockId id, const CityBlock&) { ids.push_back(id); });
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
    blocks_.set_style(ids, edit.style);
    return blocks_.finish();
  }

  Expected<EditReport> operator()(const ScaleNodes& edit) {
    if (!is_usable(edit.center)) return bad_point(edit.center);
    if (!(edit.factor >= kMinFactor && edit.factor <= kMaxFactor))
      return out_of_range("factor", edit.factor, kMinFactor, kMaxFactor);
    return transform(edit.nodes,
                     [&](Point p) { return edit.center + edit.factor * (p - edit.center); });
  }

  Expected<EditReport> operator()(const RotateNodes& edit) {
    if (!is_usable(edit.center)) return bad_point(edit.center);
    if (!(std::abs(edit.angle_rad) <= kMaxTurn_rad))
      return out_of_range("angle_rad", edit.angle_rad, -kMaxTurn_rad, kMaxTurn_rad);
    const Point east{std::cos(edit.angle_rad), std::sin(edit.angle_rad)};
    return transform(edit.nodes, [&](Point p) {
      const Point d = p - edit.center;
      return edit.center + d.x * east + d.y * perpendicular(east);
    });
  }

  Expected<EditReport> operator()(const SetParcelAttribute& edit) {
    std::optional<CityBlock> home;
    city().blocks().for_each([&](BlockId, const CityBlock& block) {
      for (std::size_t i = 0; i < block.parcels.size() && !home; ++i) {
        if (block.parcels[i].id != edit.parcel) continue;
        home = block;
        TextAttributes& attributes = home->records[i].attributes;
        if (edit.value) {
          attributes.insert_or_assign(edit.key, *edit.value);
        } else {
          attributes.erase(edit.key);
        }
      }
    });
    if (!home) return unknown("parcel", edit.parcel.value);
    EditReport report;
    const BlockId id = home->block.id;
    if (home->records == city().blocks().at(id).records) return report;
    report.changed.push_back(id);
    report.parcels_kept = home->parcels.size();
    change_.set(id, *std::move(home));
    return report;
  }

  Expected<EditReport> operator()(const MoveTiles& edit) {
    return reconfigured([&](const tiles::TileLayout& layout) {
      return tiles::move_tiles(layout, edit.tiles, edit.motion, edit.options);
    });
  }

  Expected<EditReport> operator()(const PasteTiles& edit) {
    expects(edit.group != nullptr, "there are tiles to paste");
    return reconfigured([&](const tiles::TileLayout& layout) {
      return tiles::paste_tiles(layout, *edit.group, edit.to, edit.options);
    });
  }

  Expected<EditReport> operator()(const CutTiles& edit) {
    return reconfigured([&](const tiles::TileLayout& layout) {
      return tiles::cut_tiles(layout, edit.tiles, edit.land, edit.options);
    });
  }

  Expected<EditReport> operator()(const PinTiles& edit) {
    const std::shared_ptr<const tiles::TileLayout> before = city().tiles();
    if (!before) return without_tiles();
    auto layout = edit.pinning == Pinning::kFree ? tiles::unpin_tiles(*before, edit.tiles)
                                                 : pinned(*before, edit.tiles);
    if (!layout) return tl::unexpected<Failure>(std::move(layout.error()));
    change_.set(std::make_shared<const tiles::TileLayout>(*std::move(layout)));
    return EditReport{};
  }

  Expected<EditReport> operator()(const ReplaceTiles& edit) {
    return reconfigured([&](const tiles::TileLayout& layout) {
      return tiles::replace_deformed_tiles(layout, edit.replacement, edit.options);
    });
  }

  Expected<EditReport> operator()(const RelaxTiles& edit) {
    return reconfigured(
        [&](const tiles::TileLayout& layout) { return tiles::relax(layout, edit.options); });
  }

 private:
  static constexpr double kMaxSnap_m = 100.0;
  static constexpr double kMaxTurn_rad = 10.0;

  [[nodiscard]] const City& city() const { return change_.city(); }
  [[nodiscard]] bool has(NodeId id) const { return city().nodes().contains(id); }
  [[nodiscard]] bool has(StreetId id) const { return city().streets().contains(id); }
  static bool is_width(double width_m) {
    return width_m >= kMinStreetWidth_m && width_m <= kMaxStreetWidth_m;
  }
  static tl::unexpected<Failure> bad_width(double width_m) {
    return out_of_range("width_m", width_m, kMinStreetWidth_m, kMaxStreetWidth_m);
  }
  static tl::unexpected<Failure> bad_point(Point p) {
    return fail(FailureCode::kOutOfRange,
                fmt::format("a point at ({}, {}) m, allowed {} to {}", p.x, p.y, -kMaxCoordinate_m,
                            kMaxCoordinate_m));
  }

  Expected<EditReport> transform(std::vector<NodeId> nodes, const std::function<Point(Point)>& to) {
    for (const NodeId id : nodes) {
      if (!has(id)) return unknown("node", id.value);
    }
    if (nodes.empty())
      city().nodes().for_each([&](NodeId id, const CityNode&) { nodes.push_back(id); });
    for (const NodeId id : nodes) {
      const Point p = to(city().nodes().at(id).position);
      if (!is_usable(p)) return bad_point(p);
    }
    network_.move_nodes(nodes, to);
    return settled();
  }

  static tl::unexpected<Failure> without_tiles() {
    return fail(FailureCode::kUnknownEntity, "the city has no tiles");
  }

  static Expected<tiles::TileLayout> pinned(const tiles::TileLayout& layout,
                                            std::span<const tiles::TileId> tiles) {
    return tiles::move_tiles(layout, tiles, Affine{}, {}).map([](tiles::Reconfiguration done) {
      return std::move(done.layout);
    });
  }

  /// An operation on the tiles; the streets beside those that move go along.
  template <class Operation>
  Expected<EditReport> reconfigured(Operation operation) {
    const std::shared_ptr<const tiles::TileLayout> before = city().tiles();
    if (!before) return without_tiles();
    Expected<tiles::Reconfiguration> done = operation(*before);
    if (!done) return tl::unexpected<Failure>(std::move(done.error()));
    const StreetFollowing following(*before, done->layout);
    change_.set(std::make_shared<const tiles::TileLayout>(std::move(done->layout)));
    const std::map<StreetId, double> wider = width_changes(city(), *before, following);
    std::size_t too_narrow = 0;
    for (const auto& [street, change_m] : wider) {
      const double width_m = city().streets().at(street).width_m + change_m;
      if (width_m < kMinStreetWidth_m) ++too_narrow;
      network_.resize(street, std::clamp(width_m, kMinStreetWidth_m, kMaxStreetWidth_m),
                      streets::WidthSource::kGap);
    }
    std::vector<NodeId> moving;
    city().nodes().for_each([&](NodeId id, const CityNode& node) {
      if (snap(following(node.position)) != node.position) moving.push_back(id);
    });
    network_.move_nodes(moving, [&](Point p) { return following(p); });
    Expected<EditReport> report = settled();
    if (!report) return report;
    report->tiles = std::move(done->report);
    report->nodes_moved = moving.size();
    report->streets_resized = wider.size();
    report->streets_too_narrow = too_narrow;
    return report;
  }

  Expected<EditReport> settled() {
    auto outcome = network_.settle();
    if (!outcome) return tl::unexpected<Failure>(std::move(outcome.error()));
    blocks_.update_faces(*outcome);
    return blocks_.finish(outcome->split_from);
  }

  Change& change_;
  detail::NetworkEdit network_;
  detail::BlockUpdate blocks_;
};

}  // namespace

std::string_view edit_name(const Edit& edit) {
  constexpr std::array<std::string_view, std::variant_size_v<Edit>> kNames{
      "move_node",        "move_street",     "bend_street", "add_street",   "remove_street",
      "set_street_width", "set_block_style", "scale_nodes", "rotate_nodes", "set_parcel_attribute",
      "move_tiles",       "paste_tiles",     "cut_tiles",   "pin_tiles",    "replace_tiles",
      "relax_tiles"};
  return kNames[edit.index()];
}

Expected<EditReport> Editor::apply(const Edit& edit) {
  Change change(city_);
  Expected<EditReport> report = std::visit(Application(change), edit);
  if (!report) return report;  // the change goes out of scope and takes everything back
  done_.push_back(change.keep());
  undone_.clear();
  return report;
}

void Editor::undo() {
  expects(!done_.empty(), "there is an edit to undo");
  Change::revert(city_, done_.back());
  undone_.push_back(std::move(done_.back()));
  done_.pop_back();
}

void Editor::redo() {
  expects(!undone_.empty(), "there is an edit to redo");
  Change::replay(city_, undone_.back());
  done_.push_back(std::move(undone_.back()));
  undone_.pop_back();
}

}  // namespace plat::editing
