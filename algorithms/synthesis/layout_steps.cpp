#include "synthesis/layout_steps.h"

#include <fmt/format.h>

#include <algorithm>

#include "synthesis/block_points.h"

namespace plat::synthesis {
namespace {

void give_missing_widths(streets::StreetNetwork& network, const streets::WidthOptions& options,
                         Jobs jobs) {
  const auto lacks_width = [](const streets::Street& street) { return !(street.width_m > 0.0); };
  if (std::none_of(network.streets.begin(), network.streets.end(), lacks_width)) return;
  streets::StreetNetwork assumed = network;
  streets::assign_widths(assumed, {}, options, jobs);
  for (std::size_t s = 0; s < network.streets.size(); ++s) {
    if (!lacks_width(network.streets[s])) continue;
    network.streets[s].width_m = assumed.streets[s].width_m;
    network.streets[s].width_source = assumed.streets[s].width_source;
  }
}

/// Whether the block faces existing streets and no grown one.
bool is_existing(const blocks::Block& block, std::size_t existing_count) {
  bool has_existing = false;
  for (const auto& ring : block.edges) {
    for (const blocks::BlockEdge& edge : ring) {
      if (!edge.street) continue;
      if (edge.street->value >= existing_count) return false;
      has_existing = true;
    }
  }
  return has_existing;
}

Point place_of(const Polygon& shape) {
  if (shape.outer.size() >= 3 && area_m2(shape) > 0.0) return interior_point(shape);
  return shape.outer.empty() ? Point{} : centroid(shape);
}

/// The street on whose left the face of a refused shape began: extract_blocks() names streets by
/// their source, which grown ones do not have.
std::string face_name(const std::string& source_id) {
  return source_id.empty() ? "face of grown streets" : "face at street " + source_id;
}

}  // namespace

std::string_view style_source_name(StyleSource source) {
  switch (source) {
    case StyleSource::kPoints:
      return "points";
    case StyleSource::kLayout:
      return "layout";
    case StyleSource::kNone:
      return "none";
  }
  throw LogicError("a style source without a name");
}

std::string_view stage_name(SynthesisStage stage) {
  switch (stage) {
    case SynthesisStage::kStreets:
      return "streets";
    case SynthesisStage::kBlocks:
      return "blocks";
    case SynthesisStage::kParcels:
      return "parcels";
  }
  throw LogicError("a stage without a name");
}

std::size_t parcel_count(const Layout& layout) {
  std::size_t count = 0;
  for (const LayoutBlock& block : layout.blocks) count += block.parcels ? block.parcels->size() : 0;
  return count;
}

Layout layout_of_streets(const LayoutSite& site, streets::Growth growth,
                         const streets::WidthOptions& widths, Jobs jobs) {
  const std::size_t existing_count = site.growth.existing.streets.size();
  expects(site.existing_segments.empty() || site.existing_segments.size() == existing_count,
          "one segment per existing street");
  expects(growth.network.streets.size() == existing_count + growth.segments.size(),
          "one segment per grown street");
  Layout layout;
  layout.points = site.growth.points;
  layout.existing_count = existing_count;
  layout.left_alone = std::move(growth.left_alone);
  layout.network = std::move(growth.network);
  give_missing_widths(layout.network, widths, jobs);
  std::uint32_t first_grown = 0;
  layout.segments.resize(existing_count);
  for (std::size_t s = 0; s < site.existing_segments.size(); ++s) {
    layout.segments[s] = site.existing_segments[s];
    first_grown = std::max(first_grown, site.existing_segments[s].street + 1);
  }
  for (streets::GrownSegment segment : growth.segments) {
    segment.street += first_grown;
    layout.segments.emplace_back(segment);
  }
  return layout;
}

void add_blocks(Layout& layout, const LayoutSite& site, const blocks::ExtractionOptions& extraction,
                Jobs jobs) {
  blocks::BlocksOfNetwork found = blocks::extract_blocks(layout.network, extraction, jobs);
  layout.dual = std::move(found.dual);
  for (blocks::BlockFailure& row : found.failures) {
    const Point place = place_of(row.shape);
    layout.failures.push_back({SynthesisStage::kBlocks, face_name(row.feature_id),
                               std::move(row.failure), std::move(row.shape), place});
  }
  const PointAreas areas(layout.network, layout.points, site.existing_points);
  const std::optional<ParcelAreas> everywhere = areas.everywhere();
  layout.blocks = parallel_map<LayoutBlock>(found.blocks.size(), jobs, [&](std::size_t b) {
    LayoutBlock out;
    out.block = std::move(found.blocks[b]);
    out.is_existing = is_existing(out.block, layout.existing_count);
    if (const auto around = areas.around(out.block)) {
      out.style = style_for(out.block, *around);
      out.style_source = StyleSource::kPoints;
    } else if (everywhere) {
      out.style = style_for(out.block, *everywhere);
      out.style_source = StyleSource::kLayout;
    }
    return out;
  });
}

void add_parcel_failures(Layout& layout) {
  for (const LayoutBlock& block : layout.blocks) {
    if (block.parcels) continue;
    layout.failures.push_back({SynthesisStage::kParcels,
                               fmt::format("block {}", block.block.id.value), block.parcels.error(),
                               block.block.contour, place_of(block.block.contour)});
  }
}

}  // namespace plat::synthesis
