#pragma once

#include <span>
#include <string>
#include <vector>

#include "blocks/block.h"
#include "geodata/layer.h"
#include "harness/subdivision.h"
#include "streets/street_network.h"

namespace plat::harness {

/// A parcel layer: block_id, parcel_id, repetition, strategy, then the measures
/// (parcels/parcel_measures.h).
class ParcelLayer {
 public:
  ParcelLayer(std::string name, const geodata::LocalFrame& frame);

  void add(BlockId block, const std::string& parcel_id, int repetition, const std::string& strategy,
           const Polygon& shape, const parcels::ParcelMeasures& measures);
  /// The parcels of every divided block.
  void add(std::span<const DividedBlock> blocks, int repetition, const std::string& strategy);

  [[nodiscard]] const geodata::Layer& layer() const { return layer_; }

 private:
  geodata::Layer layer_;
};

/// Blocks with block_id, source_id, area_m2, the number of street edges and the length along
/// streets.
geodata::Layer block_layer(std::span<const blocks::Block> blocks, const geodata::LocalFrame& frame);

/// Streets with what plat edit reads them from: street, source, name, class, structure, level,
/// from_node, to_node, width_m, width_source.
geodata::Layer street_layer(const streets::StreetNetwork& network,
                            const geodata::LocalFrame& frame);

/// Blocks that could not be divided: block_id, strategy, repetition, code, message. A row without a
/// shape has none.
class FailureLayer {
 public:
  explicit FailureLayer(const geodata::LocalFrame& frame);

  void add(std::string block_id, std::string strategy, int repetition, const Failure& failure,
           const Polygon& shape);
  [[nodiscard]] const geodata::Layer& layer() const { return layer_; }

 private:
  geodata::Layer layer_;
};

}  // namespace plat::harness
