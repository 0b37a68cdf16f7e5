#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "blocks/block.h"
#include "blocks/face_blocks.h"
#include "core/box.h"
#include "core/ids.h"
#include "core/options.h"
#include "core/parallel.h"
#include "core/planar_graph.h"
#include "editing/curve.h"
#include "editing/street_grid.h"
#include "editing/table.h"
#include "parcels/parcel.h"
#include "parcels/parcel_matching.h"
#include "streets/street_classes.h"
#include "streets/street_network.h"
#include "tiles/tile_layout.h"

namespace plat::editing {

using NodeId = Id<struct NodeTag>;
using WalkId = Id<struct WalkTag>;

/// Half-edge 2s runs along street s, 2s + 1 against it (core/planar_graph.h).
inline StreetId street_of(HalfEdge h) { return {edge_of(h)}; }

struct CityNode {
  Point position;                ///< on the working grid
  std::vector<HalfEdge> around;  ///< those that leave the node, counter-clockwise from east

  friend bool operator==(const CityNode&, const CityNode&) = default;
};

/// A street between two nodes: straight, or a cubic Bezier curve.
struct CityStreet {
  NodeId from;
  NodeId to;
  std::optional<Curve> curve;  ///< straight if none
  Polyline line;               ///< what the contours follow, node to node, on the working grid
  double width_m = 0.0;        ///< full width
  streets::WidthSource width_source = streets::WidthSource::kAttribute;
  std::string name;
  std::string street_class;
  std::string source_id;

  friend bool operator==(const CityStreet&, const CityStreet&) = default;
};

/// How a block is divided: a strategy of the registry by name, and its options.
struct Style {
  std::string strategy = "skeleton";
  OptionMap options;

  friend bool operator==(const Style&, const Style&) = default;
};

using TextAttributes = std::map<std::string, std::string, std::less<>>;

/// What a parcel has besides its shape.
struct ParcelRecord {
  std::optional<ParcelId> predecessor;  ///< the parcel of the step before whose place it takes
  TextAttributes attributes;

  friend bool operator==(const ParcelRecord&, const ParcelRecord&) = default;
};

/// A block with how it is divided, and what came of it. Its edges name streets of the city.
struct CityBlock {
  blocks::Block block;
  Style style;
  std::uint64_t seed = 0;
  std::vector<parcels::Parcel> parcels;  ///< ids unique in the city
  std::vector<ParcelRecord> records;     ///< one per parcel
  std::optional<Failure> failure;        ///< why there are no parcels
};

/// A closed walk around a face (its area on the left), or around a component (the rest on the
/// left). A dead end is walked on both sides.
struct Walk {
  std::vector<HalfEdge> half_edges;
  double area_m2 = 0.0;  ///< positive for the outer walk of a face
  Box box;
  std::optional<WalkId> container;  ///< of a component: the face it lies in, if any
  std::vector<WalkId> islands;      ///< of a face: the components in it, sorted
  std::vector<BlockId> blocks;      ///< of a face, sorted
  std::vector<blocks::RefusedRegion> refused;

  [[nodiscard]] bool is_face() const { return area_m2 > 0.0; }
};

/// The walks on both sides of a street.
struct StreetSides {
  WalkId left;
  WalkId right;
};

struct CityOptions {
  Style style;             ///< of blocks that inherit none
  std::uint64_t seed = 1;  ///< of the city; a block's own comes from this and its id
  parcels::ParcelMatching matching = parcels::ParcelMatching::kRelativeDistances;
  blocks::FaceOptions face{.dead_ends = blocks::DeadEndCut::kDeadEnds};
  Jobs jobs;
};

/// The next free ids. They go back with undo: ids of what it took away are given again.
struct IdCounters {
  std::uint32_t node = 0;
  std::uint32_t street = 0;
  std::uint32_t walk = 0;
  std::uint32_t block = 0;
  std::uint32_t parcel = 0;

  friend bool operator==(const IdCounters&, const IdCounters&) = default;
};

/// A city under edit: streets as a planar graph, the blocks that its bounded faces enclose, the
/// parcels of each block [VKW12, Sec. 3.1]. It is changed through an Editor only (editor.h).
///
/// Invariants: 1. streets meet at nodes only, and noding them (node_segments) leaves them as they
/// are;  2. the blocks are those of blocks::extract_blocks() on network_of(), bit for bit;  3. the
/// parcels of a block are a coverage of it, or it has a failure, or the city has tiles and its
/// blocks no parcels;  4. ids of nodes, streets, blocks, parcels and tiles are kept by edits, and
/// those of what an edit took away are not used again; undo gives back the ids of what it undoes.
///
/// Deviation: faces and dual are kept, not recomputed each time (ADR 0012).
class City {
 public:
  explicit City(CityOptions options) : options_(std::move(options)) {}

  [[nodiscard]] const Table<NodeId, CityNode>& nodes() const { return nodes_; }
  [[nodiscard]] const Table<StreetId, CityStreet>& streets() const { return streets_; }
  [[nodiscard]] const Table<BlockId, CityBlock>& blocks() const { return blocks_; }
  [[nodiscard]] const Table<WalkId, Walk>& walks() const { return walks_; }
  [[nodiscard]] const CityOptions& options() const { return options_; }
  [[nodiscard]] const IdCounters& counters() const { return counters_; }
  [[nodiscard]] const StreetGrid& grid() const { return grid_; }
  /// The land of a city whose blocks are not divided by rule (ADR 0040); null where they are.
  [[nodiscard]] const std::shared_ptr<const tiles::TileLayout>& tiles() const { return tiles_; }

  [[nodiscard]] NodeId origin_of(HalfEdge h) const {
    const CityStreet& street = streets_.at(street_of(h));
    return (h & 1U) == 0U ? street.from : street.to;
  }
  [[nodiscard]] WalkId walk_of(HalfEdge h) const {
    const StreetSides& sides = sides_.at(street_of(h));
    return (h & 1U) == 0U ? sides.left : sides.right;
  }

 private:
  friend class Change;
  friend City with_options(City city, const CityOptions& options);

  CityOptions options_;
  IdCounters counters_;
  Table<NodeId, CityNode> nodes_;
  Table<StreetId, CityStreet> streets_;
  Table<StreetId, StreetSides> sides_;
  Table<WalkId, Walk> walks_;
  Table<BlockId, CityBlock> blocks_;
  StreetGrid grid_;  ///< of the lines of streets_
  std::shared_ptr<const tiles::TileLayout> tiles_;
};

/// The style of each block when a city is made; the city's own where it returns none.
using StyleOf = std::function<std::optional<Style>(const blocks::Block&)>;

/// A city of the streets that bound blocks, noded; every point of a street's line becomes a node.
/// Streets that bound none (tunnels, paths) are left out.
/// @throws InputError where the style names no strategy, or options it does not have
City make_city(const streets::StreetNetwork& network, const CityOptions& options,
               streets::BoundingClasses bounding = streets::BoundingClasses::kStreets,
               const StyleOf& style_of = {});

/// The same city with tiles as its land: its blocks lose their parcels, and are not divided by rule
/// any more. A city of tiles may have no street at all.
City with_tiles(City city, tiles::TileLayout layout);

/// A city with tiles as its land; nothing is divided.
City make_city_of_tiles(const streets::StreetNetwork& network, tiles::TileLayout layout,
                        const CityOptions& options,
                        streets::BoundingClasses bounding = streets::BoundingClasses::kStreets);

/// The same city, divided and matched by other options from now on.
City with_options(City city, const CityOptions& options);

/// The streets as a network, in the order of their ids; `ids` gets the id of each where not null.
streets::StreetNetwork network_of(const City& city, std::vector<StreetId>* ids = nullptr);

}  // namespace plat::editing
