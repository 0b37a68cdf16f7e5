#include "streets/street_network.h"

namespace plat::streets {

std::string_view width_source_name(WidthSource source) {
  switch (source) {
    case WidthSource::kNone:
      return "none";
    case WidthSource::kAttribute:
      return "attribute";
    case WidthSource::kLanes:
      return "lanes";
    case WidthSource::kGap:
      return "gap";
    case WidthSource::kClass:
      return "class";
    case WidthSource::kAssumed:
      return "assumed";
    case WidthSource::kExample:
      return "example";
  }
  return "none";
}

std::string_view structure_name(Structure structure) {
  switch (structure) {
    case Structure::kGround:
      return "ground";
    case Structure::kBridge:
      return "bridge";
    case Structure::kTunnel:
      return "tunnel";
  }
  return "ground";
}

std::vector<std::uint32_t> node_degrees(const StreetNetwork& network) {
  std::vector<std::uint32_t> degrees(network.nodes.size(), 0);
  for (const Street& street : network.streets) {
    ++degrees[street.from];
    ++degrees[street.to];
  }
  return degrees;
}

}  // namespace plat::streets
