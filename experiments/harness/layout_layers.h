#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/options.h"
#include "core/parallel.h"
#include "geodata/layer.h"
#include "synthesis/layout.h"

namespace plat::harness {

/// What a layout was made by, to make it again.
struct LayoutOrigin {
  std::uint64_t seed = 1;
  std::string grower;
  OptionMap grower_options;
  std::string subdivider;
  OptionMap subdivider_options;  ///< as given; blocks have those that ran
  std::string script;            ///< its text
};

/// The layers of a layout (docs/synthesis_script.md): points, streets, blocks, parcels, failures,
/// and `synthesis`, which says what it was made by. Streets and parcels have the columns of plat
/// blocks and plat subdivide, so that plat edit, compare and blocks read them.
std::vector<geodata::Layer> layout_layers(const synthesis::Layout& layout,
                                          const geodata::LocalFrame& frame,
                                          const LayoutOrigin& origin, Jobs jobs = {});

}  // namespace plat::harness
