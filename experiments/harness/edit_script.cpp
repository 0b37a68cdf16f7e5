#include "harness/edit_script.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>

#include "harness/config_reader_internal.h"
#include "harness/json_file.h"
#include "parcels/block_subdivider.h"

namespace plat::harness {
namespace {

using editing::City;
using editing::CityBlock;
using editing::CityNode;
using editing::CityStreet;
using editing::Edit;
using editing::NodeId;
using geodata::LocalFrame;
using nlohmann::json;

using Resolve = std::function<Edit(const City&, const LocalFrame&)>;

/// An id, or the place of what is meant, in the city's CRS.
struct Reference {
  std::optional<std::uint32_t> id;
  Point place;
};

Point point_of(const json& value, const std::string& where, std::string_view key) {
  if (!value.is_array() || value.size() != 2 || !value[0].is_number() || !value[1].is_number()) {
    throw InputError(
        fmt::format("{}: \"{}\" must be [x, y] in metres of the city's CRS", where, key));
  }
  return {value[0].get<double>(), value[1].get<double>()};
}

/// Reads the keys of one edit, each needed unless it has a fallback.
class EditReader {
 public:
  EditReader(const json& object, std::string where)
      : reader_(object, where), where_(std::move(where)) {}

  [[nodiscard]] const std::string& where() const { return where_; }
  void expect_nothing_else() const { reader_.expect_nothing_else(); }
  const json* find(std::string_view key) { return reader_.find(key); }

  const json& needed(std::string_view key) {
    const json* value = reader_.find(key);
    if (value == nullptr) throw InputError(fmt::format("{}: \"{}\" is missing", where_, key));
    return *value;
  }
  Point point(std::string_view key) { return point_of(needed(key), where_, key); }
  double number(std::string_view key, std::optional<double> fallback, double low, double high) {
    const json* value = fallback ? reader_.find(key) : &needed(key);
    if (value == nullptr) return *fallback;
    if (!value->is_number())
      throw InputError(fmt::format("{}: \"{}\" must be a number", where_, key));
    const auto number = value->get<double>();
    if (!(number >= low && number <= high))
      throw InputError(fmt::format("{}: {} = {}, allowed {}..{}", where_, key, number, low, high));
    return number;
  }
  std::string text(std::string_view key, const std::string& fallback) {
    return reader_.text(key, fallback);
  }
  Reference reference(std::string_view key) { return reference_of(needed(key), key); }
  std::vector<Reference> references(std::string_view key) {
    std::vector<Reference> out;
    const json* list = reader_.find(key);
    if (list == nullptr) return out;
    if (!list->is_array() || list->empty())
      throw InputError(fmt::format("{}: \"{}\" must be a list; leave it out for all", where_, key));
    for (const json& each : *list) out.push_back(reference_of(each, key));
    return out;
  }

 private:
  Reference reference_of(const json& value, std::string_view key) {
    if (value.is_number_integer()) {
      const auto id = value.get<std::int64_t>();
      if (id >= 0 && id < std::numeric_limits<std::uint32_t>::max())
        return {static_cast<std::uint32_t>(id), {}};
    }
    if (value.is_object()) {
      ObjectReader place(value, fmt::format("{}: {}", where_, key));
      const json* at = place.find("at");
      place.expect_nothing_else();
      if (at != nullptr) return {std::nullopt, point_of(*at, where_, "at")};
    }
    throw InputError(
        fmt::format("{}: \"{}\" must be an id (0, 1, ...) or {{\"at\": [x, y]}}", where_, key));
  }

  ObjectReader reader_;
  std::string where_;
};

constexpr std::uint32_t kNothing = std::numeric_limits<std::uint32_t>::max();

/// The id whose record has the least distance; an id that nothing has where there is none.
template <class Key, class Record, class DistanceOf>
Key nearest(const editing::Table<Key, Record>& table, DistanceOf distance_of) {
  Key best{kNothing};
  double least = std::numeric_limits<double>::infinity();
  table.for_each([&](Key key, const Record& record) {
    const double d = distance_of(record);
    if (d >= least) return;
    least = d;
    best = key;
  });
  return best;
}

NodeId node_of(const Reference& reference, const City& city, const LocalFrame& frame) {
  if (reference.id) return {*reference.id};
  const Point p = reference.place - frame.origin;
  return nearest(city.nodes(), [&](const CityNode& node) { return distance(node.position, p); });
}

StreetId street_of(const Reference& reference, const City& city, const LocalFrame& frame) {
  if (reference.id) return {*reference.id};
  const Point p = reference.place - frame.origin;
  return nearest(city.streets(), [&](const CityStreet& street) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 1; i < street.line.size(); ++i)
      least = std::min(least, distance(Segment{street.line[i - 1], street.line[i]}, p));
    return least;
  });
}

/// The block that the place lies in.
BlockId block_of(const Reference& reference, const City& city, const LocalFrame& frame) {
  if (reference.id) return {*reference.id};
  const Point p = reference.place - frame.origin;
  BlockId found{kNothing};
  city.blocks().for_each([&](BlockId id, const CityBlock& block) {
    if (locate(block.block.contour, p) == Side::kInside) found = id;
  });
  return found;
}

ParcelId parcel_of(const Reference& reference, const City& city, const LocalFrame& frame) {
  if (reference.id) return {*reference.id};
  const CityBlock* home = city.blocks().find(block_of(reference, city, frame));
  if (home == nullptr) return {kNothing};
  const Point p = reference.place - frame.origin;
  for (const parcels::Parcel& parcel : home->parcels) {
    if (locate(parcel.shape, p) != Side::kOutside) return parcel.id;
  }
  return {kNothing};
}

std::vector<NodeId> nodes_of(const std::vector<Reference>& references, const City& city,
                             const LocalFrame& frame) {
  std::vector<NodeId> out;
  for (const Reference& each : references) out.push_back(node_of(each, city, frame));
  return out;
}

Resolve parse_move_node(EditReader& edit) {
  return
      [node = edit.reference("node"), to = edit.point("to"),
       snap = edit.number("snap_m", 0.0, 0.0, 100.0)](const City& city, const LocalFrame& frame) {
        return editing::MoveNode{node_of(node, city, frame), to - frame.origin, snap};
      };
}

Resolve parse_move_street(EditReader& edit) {
  return [street = edit.reference("street"), by = edit.point("by")](const City& city,
                                                                    const LocalFrame& frame) {
    return editing::MoveStreet{street_of(street, city, frame), by};
  };
}

Resolve parse_bend_street(EditReader& edit) {
  const Reference street = edit.reference("street");
  const json* controls = edit.find("controls");
  std::optional<editing::Curve> curve;
  if (controls != nullptr) {
    if (!controls->is_array() || controls->size() != 2)
      throw InputError(edit.where() +
                       ": \"controls\" must be two points; leave it out to straighten");
    curve = editing::Curve{point_of((*controls)[0], edit.where(), "controls"),
                           point_of((*controls)[1], edit.where(), "controls")};
  }
  return [street, curve](const City& city, const LocalFrame& frame) {
    editing::BendStreet out{street_of(street, city, frame), std::nullopt};
    if (curve)
      out.curve = editing::Curve{curve->first - frame.origin, curve->second - frame.origin};
    return out;
  };
}

Resolve parse_add_street(EditReader& edit) {
  editing::AddStreet out;
  out.from = edit.point("from");
  out.to = edit.point("to");
  out.width_m =
      edit.number("width_m", out.width_m, editing::kMinStreetWidth_m, editing::kMaxStreetWidth_m);
  out.name = edit.text("name", out.name);
  out.street_class = edit.text("class", out.street_class);
  out.snap_m = edit.number("snap_m", out.snap_m, 0.0, 100.0);
  return [out](const City&, const LocalFrame& frame) {
    editing::AddStreet placed = out;
    placed.from = out.from - frame.origin;
    placed.to = out.to - frame.origin;
    return placed;
  };
}

Resolve parse_remove_street(EditReader& edit) {
  return [street = edit.reference("street")](const City& city, const LocalFrame& frame) {
    return editing::RemoveStreet{street_of(street, city, frame)};
  };
}

Resolve parse_set_street_width(EditReader& edit) {
  return
      [street = edit.reference("street"),
       width = edit.number("width_m", std::nullopt, editing::kMinStreetWidth_m,
                           editing::kMaxStreetWidth_m)](const City& city, const LocalFrame& frame) {
        return editing::SetStreetWidth{street_of(street, city, frame), width};
      };
}

Resolve parse_set_block_style(EditReader& edit) {
  const std::vector<Reference> blocks = edit.references("blocks");
  editing::Style style;
  const json& name = edit.needed("strategy");
  if (!name.is_string()) throw InputError(edit.where() + ": \"strategy\" must be a text");
  style.strategy = name.get<std::string>();
  if (const json* options = edit.find("options"))
    style.options = read_options(*options, edit.where());
  naming(edit.where(), [&] {
    static_cast<void>(parcels::block_subdividers().make(style.strategy, style.options));
  });
  return [blocks, style](const City& city, const LocalFrame& frame) {
    editing::SetBlockStyle out{{}, style};
    for (const Reference& each : blocks) out.blocks.push_back(block_of(each, city, frame));
    return out;
  };
}

Resolve parse_scale_nodes(EditReader& edit) {
  return [nodes = edit.references("nodes"), center = edit.point("center"),
          factor = edit.number("factor", std::nullopt, 0.01, 100.0)](const City& city,
                                                                     const LocalFrame& frame) {
    return editing::ScaleNodes{nodes_of(nodes, city, frame), center - frame.origin, factor};
  };
}

Resolve parse_rotate_nodes(EditReader& edit) {
  constexpr double kRadPerDegree = std::numbers::pi / 180.0;
  return [nodes = edit.references("nodes"), center = edit.point("center"),
          angle = edit.number("angle_deg", std::nullopt, -360.0, 360.0)](const City& city,
                                                                         const LocalFrame& frame) {
    return editing::RotateNodes{nodes_of(nodes, city, frame), center - frame.origin,
                                kRadPerDegree * angle};
  };
}

Resolve parse_set_parcel_attribute(EditReader& edit) {
  const Reference parcel = edit.reference("parcel");
  const std::string key = edit.text("key", "");
  if (key.empty()) throw InputError(edit.where() + ": \"key\" is missing");
  std::optional<std::string> value;
  if (const json* given = edit.find("value"); given != nullptr && !given->is_null()) {
    if (!given->is_string())
      throw InputError(edit.where() + ": \"value\" must be a text; leave it out to take it away");
    value = given->get<std::string>();
  }
  return [parcel, key, value](const City& city, const LocalFrame& frame) {
    return editing::SetParcelAttribute{parcel_of(parcel, city, frame), key, value};
  };
}

struct Kind {
  std::string_view name;
  Resolve (*parse)(EditReader&);
};
constexpr std::array<Kind, std::variant_size_v<Edit>> kKinds{{
    {"move_node", parse_move_node},
    {"move_street", parse_move_street},
    {"bend_street", parse_bend_street},
    {"add_street", parse_add_street},
    {"remove_street", parse_remove_street},
    {"set_street_width", parse_set_street_width},
    {"set_block_style", parse_set_block_style},
    {"scale_nodes", parse_scale_nodes},
    {"rotate_nodes", parse_rotate_nodes},
    {"set_parcel_attribute", parse_set_parcel_attribute},
}};

const Kind& kind_named(const std::string& name, const std::string& where) {
  std::vector<std::string_view> known;
  std::string list;
  for (const Kind& kind : kKinds) {
    if (kind.name == name) return kind;
    known.push_back(kind.name);
    list += (list.empty() ? "" : ", ") + std::string(kind.name);
  }
  throw InputError(fmt::format("{}: no edit \"{}\"{} (allowed: {})", where, name,
                               did_you_mean(name, known), list));
}

}  // namespace

std::vector<ScriptedEdit> parse_edit_script(const json& script, const std::string& source) {
  ObjectReader reader(script, source);
  const json* edits = reader.find("edits");
  reader.expect_nothing_else();
  if (edits == nullptr || !edits->is_array())
    throw InputError(source + ": \"edits\" must be a list");
  std::vector<ScriptedEdit> out;
  for (std::size_t i = 0; i < edits->size(); ++i) {
    const std::string where = fmt::format("{}: edit {}", source, i + 1);
    EditReader edit((*edits)[i], where);
    const std::string name = edit.text("edit", "");
    if (name.empty()) throw InputError(where + ": \"edit\" must name what to do");
    const Kind& kind = kind_named(name, where);
    EditReader named((*edits)[i], fmt::format("{} ({})", where, name));
    named.text("edit", "");
    out.push_back({name, kind.parse(named)});
    named.expect_nothing_else();
  }
  return out;
}

std::vector<ScriptedEdit> read_edit_script(const std::string& file) {
  return parse_edit_script(read_json(file), file);
}

}  // namespace plat::harness
