#include "editing/city_support.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <map>

#include "blocks/block_extraction.h"
#include "editing/tiled_city.h"
#include "parcels/block_subdivider.h"
#include "parcels/coverage.h"
#include "streets/network_cleaning.h"
#include "tiles/layout_defects.h"

namespace plat::testing {

using editing::City;
using editing::CityBlock;
using editing::CityNode;
using editing::CityStreet;
using editing::NodeId;

namespace {

/// Points to the last bit.
class Bytes {
 public:
  void add(Point p) {
    fmt::format_to(std::back_inserter(text_), "{:x},{:x} ", std::bit_cast<std::uint64_t>(p.x),
                   std::bit_cast<std::uint64_t>(p.y));
  }
  void add(double v) {
    fmt::format_to(std::back_inserter(text_), "{:x} ", std::bit_cast<std::uint64_t>(v));
  }
  void add(std::uint64_t v) { fmt::format_to(std::back_inserter(text_), "{} ", v); }
  void add(std::string_view v) { text_ += v, text_ += '|'; }
  void add(const Polygon& polygon) {
    for_each_edge(polygon, [&](const Segment& s) { add(s.a); });
    text_ += ';';
  }
  void add(const blocks::Block& block) {
    add(block.contour);
    for (const auto& ring : block.edges) {
      for (const blocks::BlockEdge& edge : ring) {
        add(std::uint64_t{edge.logical_street ? *edge.logical_street + 1U : 0U});
        add(std::uint64_t{edge.street ? edge.street->value + 1U : 0U});
        add(edge.street_width_m);
        add(static_cast<std::uint64_t>(edge.width_source));
      }
    }
  }
  void add(const CityBlock& block) {
    add(block.block);
    add(block.style.strategy);
    add(to_string(block.style.options));
    add(block.seed);
    for (std::size_t i = 0; i < block.parcels.size(); ++i) {
      add(std::uint64_t{block.parcels[i].id.value});
      add(block.parcels[i].shape);
      const editing::ParcelRecord& record = block.records[i];
      add(std::uint64_t{record.predecessor ? record.predecessor->value + 1U : 0U});
      for (const auto& [key, value] : record.attributes) {
        add(key);
        add(value);
      }
    }
    if (block.failure) add(block.failure->message);
    text_ += '\n';
  }
  std::string text_;
};

}  // namespace

std::string bytes_of(const City& city) {
  Bytes out;
  city.nodes().for_each([&](NodeId id, const CityNode& node) {
    out.add(std::uint64_t{id.value});
    out.add(node.position);
    for (const HalfEdge h : node.around) out.add(std::uint64_t{h});
  });
  city.streets().for_each([&](StreetId id, const CityStreet& street) {
    out.add(std::uint64_t{id.value});
    out.add(std::uint64_t{street.from.value});
    out.add(std::uint64_t{street.to.value});
    for (const Point p : street.line) out.add(p);
    out.add(street.width_m);
    out.add(street.name);
    out.add(street.street_class);
    out.add(std::uint64_t{city.walk_of(2 * id.value).value});
    out.add(std::uint64_t{city.walk_of(2 * id.value + 1).value});
  });
  city.walks().for_each([&](editing::WalkId id, const editing::Walk& walk) {
    out.add(std::uint64_t{id.value});
    out.add(walk.area_m2);
    for (const HalfEdge h : walk.half_edges) out.add(std::uint64_t{h});
    for (const editing::WalkId island : walk.islands) out.add(std::uint64_t{island.value});
    for (const BlockId block : walk.blocks) out.add(std::uint64_t{block.value});
    out.add(std::uint64_t{walk.container ? walk.container->value + 1U : 0U});
  });
  city.blocks().for_each([&](BlockId id, const CityBlock& block) {
    out.add(std::uint64_t{id.value});
    out.add(block);
  });
  const editing::IdCounters& ids = city.counters();
  for (const std::uint32_t next : {ids.node, ids.street, ids.walk, ids.block, ids.parcel})
    out.add(std::uint64_t{next});
  if (city.tiles()) out.text_ += bytes_of(*city.tiles());
  return std::move(out.text_);
}

streets::StreetNetwork grid_network(int columns, int rows) {
  std::vector<streets::RawStreet> raw;
  const auto add = [&](std::string name, Polyline line) {
    streets::RawStreet street;
    street.source_id = name;
    street.attributes.name = std::move(name);
    street.attributes.street_class = "residential";
    street.attributes.given_width_m = 12.0;
    street.line = std::move(line);
    raw.push_back(std::move(street));
  };
  for (int c = 0; c < columns; ++c)
    add(fmt::format("avenue {}", c), {{100.0 * c, 0.0}, {100.0 * c, 80.0 * (rows - 1)}});
  for (int r = 0; r < rows; ++r)
    add(fmt::format("street {}", r), {{0.0, 80.0 * r}, {100.0 * (columns - 1), 80.0 * r}});
  streets::StreetNetwork network = streets::build_network(raw).network;
  for (streets::Street& street : network.streets) {
    street.width_m = 12.0;
    street.width_source = streets::WidthSource::kAttribute;
  }
  return network;
}

City grid_city(int columns, int rows, const editing::CityOptions& options) {
  return editing::make_city(grid_network(columns, rows), options);
}

streets::StreetNetwork town_network() {
  streets::StreetNetwork network = grid_network(5, 5);
  const auto add = [&](Polyline line, double width_m, std::string name) {
    streets::Street street;
    street.id = StreetId{static_cast<std::uint32_t>(network.streets.size())};
    street.line = std::move(line);
    street.width_m = width_m;
    street.attributes.street_class = "residential";
    street.attributes.name = std::move(name);
    network.streets.push_back(std::move(street));
  };
  add({{130, 100}, {170, 100}, {170, 140}, {130, 140}, {130, 100}}, 4.0, "yard");
  add({{250, 80}, {250, 120}}, 6.0, "close");
  add({{250, 120}, {270, 130}}, 6.0, "close");
  add({{0, 160}, {100, 240}}, 20.0, "diagonal");
  add({{300, 160}, {320, 170}, {340, 200}, {350, 240}}, 9.0, "bend");
  add({{500, 0}, {600, 20}, {560, 120}, {500, 0}}, 8.0, "");
  return network;
}

NodeId node_near(const City& city, Point p) {
  std::optional<std::pair<double, NodeId>> best;
  city.nodes().for_each([&](NodeId id, const CityNode& node) {
    const std::pair candidate(distance(node.position, p), id);
    if (!best || candidate < *best) best = candidate;
  });
  return best->second;
}

StreetId street_near(const City& city, Point p) {
  std::optional<std::pair<double, StreetId>> best;
  city.streets().for_each([&](StreetId id, const CityStreet& street) {
    for (std::size_t i = 1; i < street.line.size(); ++i) {
      const std::pair candidate(distance(Segment{street.line[i - 1], street.line[i]}, p), id);
      if (!best || candidate < *best) best = candidate;
    }
  });
  return best->second;
}

BlockId block_at(const City& city, Point p) {
  std::optional<BlockId> found;
  city.blocks().for_each([&](BlockId id, const CityBlock& block) {
    if (locate(block.block.contour, p) == Side::kInside) found = id;
  });
  EXPECT_TRUE(found) << p.x << ' ' << p.y;
  return found.value_or(BlockId{});
}

void expect_as_from_scratch(const City& city) {
  if (city.tiles()) {
    const auto defect = tiles::find_layout_defect(*city.tiles());
    EXPECT_FALSE(defect) << defect->message;
  }
  std::vector<StreetId> ids;
  const streets::StreetNetwork network = editing::network_of(city, &ids);
  blocks::ExtractionOptions options;
  options.bounding = streets::BoundingClasses::kAll;
  options.face = city.options().face;
  blocks::BlocksOfNetwork scratch = blocks::extract_blocks(network, options);
  std::map<std::string, const CityBlock*> known;
  city.blocks().for_each([&](BlockId id, const CityBlock& block) {
    EXPECT_EQ(block.block.id, id);
    Bytes key;
    key.add(block.block);
    known.emplace(std::move(key.text_), &block);
  });
  EXPECT_EQ(known.size(), city.blocks().size());
  EXPECT_EQ(scratch.blocks.size(), city.blocks().size());
  for (blocks::Block& block : scratch.blocks) {
    for (auto& ring : block.edges) {
      for (blocks::BlockEdge& edge : ring) edge.street = ids[edge.street->value];
    }
    Bytes key;
    key.add(block);
    const auto it = known.find(key.text_);
    if (it == known.end()) {
      ADD_FAILURE() << "no block of the city is that around " << centroid(block.contour).x << ' '
                    << centroid(block.contour).y;
      continue;
    }
    const CityBlock& own = *it->second;
    if (city.tiles()) {
      EXPECT_TRUE(own.parcels.empty() && !own.failure) << "tiles are the land";
      continue;
    }
    Rng rng(own.seed);
    const auto parcels = parcels::block_subdividers()
                             .make(own.style.strategy, own.style.options)
                             .subdivide(block, rng);
    ASSERT_EQ(parcels.has_value(), !own.failure);
    if (!parcels) continue;
    ASSERT_EQ(parcels->size(), own.parcels.size());
    for (std::size_t i = 0; i < parcels->size(); ++i)
      EXPECT_EQ((*parcels)[i].shape, own.parcels[i].shape);
    const auto defect =
        parcels::find_coverage_defect(own.block.contour, own.parcels, parcels::kContourTolerance_m);
    EXPECT_FALSE(defect) << defect->message;
    EXPECT_EQ(own.parcels.size(), own.records.size());
  }
}

void expect_exactly_changed(const City& before, const City& after,
                            const editing::EditReport& report) {
  std::vector<BlockId> changed;
  std::vector<BlockId> appeared;
  std::vector<BlockId> vanished;
  before.blocks().for_each([&](BlockId id, const CityBlock& block) {
    const CityBlock* now = after.blocks().find(id);
    if (now == nullptr) {
      vanished.push_back(id);
      return;
    }
    Bytes old_bytes;
    Bytes new_bytes;
    old_bytes.add(block);
    new_bytes.add(*now);
    if (old_bytes.text_ != new_bytes.text_) changed.push_back(id);
  });
  after.blocks().for_each([&](BlockId id, const CityBlock&) {
    if (!before.blocks().contains(id)) appeared.push_back(id);
  });
  EXPECT_EQ(report.changed, changed);
  EXPECT_EQ(report.appeared, appeared);
  EXPECT_EQ(report.vanished, vanished);
}

}  // namespace plat::testing
