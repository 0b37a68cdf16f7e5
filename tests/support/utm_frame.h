#pragma once

#include <string>

#include "geodata/layer.h"

namespace plat::testing {

/// A local frame in San Francisco.
inline geodata::LocalFrame utm_frame() {
  constexpr std::string_view kUtm10 =
      R"w(PROJCRS["WGS 84 / UTM zone 10N",BASEGEOGCRS["WGS 84",DATUM["World Geodetic System 1984",)w"
      R"w(ELLIPSOID["WGS 84",6378137,298.257223563,LENGTHUNIT["metre",1]]],)w"
      R"w(PRIMEM["Greenwich",0,ANGLEUNIT["degree",0.0174532925199433]],ID["EPSG",4326]],)w"
      R"w(CONVERSION["UTM zone 10N",METHOD["Transverse Mercator",ID["EPSG",9807]],)w"
      R"w(PARAMETER["Latitude of natural origin",0,ANGLEUNIT["degree",0.0174532925199433]],)w"
      R"w(PARAMETER["Longitude of natural origin",-123,ANGLEUNIT["degree",0.0174532925199433]],)w"
      R"w(PARAMETER["Scale factor at natural origin",0.9996,SCALEUNIT["unity",1]],)w"
      R"w(PARAMETER["False easting",500000,LENGTHUNIT["metre",1]],)w"
      R"w(PARAMETER["False northing",0,LENGTHUNIT["metre",1]]],CS[Cartesian,2],)w"
      R"w(AXIS["(E)",east,ORDER[1],LENGTHUNIT["metre",1]],)w"
      R"w(AXIS["(N)",north,ORDER[2],LENGTHUNIT["metre",1]],ID["EPSG",32610]])w";
  return {std::string(kUtm10), {548000.0, 4180000.0}};
}

}  // namespace plat::testing
