#pragma once

#include "blocks/block_extraction.h"
#include "core/parallel.h"
#include "streets/street_width.h"
#include "synthesis/layout.h"

namespace plat::synthesis {

/// The steps of LayoutSynthesizer that ask no strategy.

/// The layout of a grown network: no blocks yet. A street without a width gets one as observed
/// streets do (streets/street_width.h); others keep theirs.
Layout layout_of_streets(const LayoutSite& site, streets::Growth growth,
                         const streets::WidthOptions& widths, Jobs jobs);

/// Finds the blocks, the style that their parcels should have, and what failed on the way.
void add_blocks(Layout& layout, const LayoutSite& site, const blocks::ExtractionOptions& extraction,
                Jobs jobs);

/// Appends a row for every block that could not be divided.
void add_parcel_failures(Layout& layout);

}  // namespace plat::synthesis
