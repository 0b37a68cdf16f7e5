// Bytes -> polygons with labels and options -> every registered block subdivider. A block may be
// refused; what is returned must be a coverage, and nothing may throw, crash or hang.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "blocks/block_assignment.h"
#include "blocks/blocks_from_parcels.h"
#include "blocks/edge_labels.h"
#include "core/validity.h"
#include "fuzz_case.h"
#include "parcels/block_subdivider.h"
#include "parcels/coverage.h"
#include "parcels/parcel_measures.h"
#include "parcels/parcel_style.h"

namespace plat::fuzz {
namespace {

constexpr std::size_t kMaxVertices = 1000;
/// Measuring thousands of slivers takes most of an input's time, and shows nothing new.
constexpr std::size_t kMaxMeasured = 500;

[[noreturn]] void report(std::string_view what, std::string_view detail) {
  fmt::print(stderr, "{}: {}\n", what, detail);
  std::abort();
}

void check_strategy(const std::string& name, const blocks::Block& block, const OptionMap& options,
                    std::uint64_t seed) {
  const auto subdivider = parcels::block_subdividers().make(name, options);
  Rng rng(seed);
  const auto found = subdivider.subdivide(block, rng);
  if (!found) {
    if (found.error().message.empty()) report(name, "a failure without a message");
    return;
  }
  if (auto defect =
          parcels::find_coverage_defect(block.contour, *found, parcels::kContourTolerance_m))
    report(name, defect->message);
  std::vector<Polygon> shapes;
  for (std::size_t i = 0; i < found->size(); ++i) {
    if ((*found)[i].id.value != i) report(name, "ids are not 0 .. n-1");
    shapes.push_back((*found)[i].shape);
  }
  if (shapes.empty()) report(name, "no parcel and no failure");
  if (shapes.size() > kMaxMeasured) shapes.resize(kMaxMeasured);
  for (const parcels::ParcelMeasures& m : parcels::measure_parcels(block, shapes)) {
    for (const parcels::MeasureColumn& column : parcels::measure_columns()) {
      if (!std::isfinite(column.value(m))) report(name, column.name);
    }
  }
  // What is fitted to these parcels must be options that may run.
  static_cast<void>(parcels::block_subdividers().make(
      name, subdivider.fitted(parcels::style_of(block, shapes)).options()));
}

/// What `plat run` and `plat compare` do with parcels that were read.
void check_read_path(const std::vector<Polygon>& polygons) {
  std::vector<blocks::ObservedParcel> observed;
  for (const Polygon& p : polygons) observed.push_back({std::to_string(observed.size()), p});
  blocks::BlocksFromParcels found = blocks::blocks_from_parcels(observed, {}, Jobs{1});
  for (const blocks::Block& block : found.blocks) {
    if (auto defect = find_defect(block.contour)) report("blocks_from_parcels", defect->message);
  }
  blocks::label_edges(found.blocks, {}, {}, Jobs{1});
  static_cast<void>(blocks::assign_to_blocks(found.blocks, polygons));
}

void run(ByteReader in) {
  const std::uint8_t head = in.byte();
  const auto seed = in.take<std::uint16_t>();
  std::vector<Polygon> polygons;
  const int count = 1 + head % 3;
  for (int i = 0; i < count; ++i) polygons.push_back(take_polygon(in));
  std::vector<OptionMap> options;
  const std::vector<std::string> names = parcels::block_subdividers().names();
  for (const std::string& name : names)
    options.push_back(take_options(parcels::block_subdividers().at(name).fields, in));

  if (head >= 192) check_read_path(polygons);
  std::vector<blocks::Block> blocks;
  for (const Polygon& polygon : polygons) {
    auto admitted = admit_polygon(polygon, kMaxVertices);
    if (!admitted) continue;
    blocks::Block block;
    block.id = {static_cast<std::uint32_t>(blocks.size())};
    block.contour = *std::move(admitted);
    block.edges.emplace_back(block.contour.outer.size());
    for (const Ring& hole : block.contour.holes) block.edges.emplace_back(hole.size());
    blocks.push_back(std::move(block));
  }
  if (head % 2 == 0) {
    blocks::label_edges(blocks, {}, {}, Jobs{1});
  } else {
    for (blocks::Block& block : blocks) label_from_bytes(block, in);
  }
  for (const blocks::Block& block : blocks) {
    for (std::size_t k = 0; k < names.size(); ++k)
      check_strategy(names[k], block, options[k], seed);
  }
}

}  // namespace
}  // namespace plat::fuzz

// libFuzzer's name. An exception that leaves it is a crash, LogicError included.
// NOLINTNEXTLINE(readability-identifier-naming)
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  plat::fuzz::run(plat::fuzz::ByteReader({data, size}));
  return 0;
}
