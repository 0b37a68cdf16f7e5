#include "harness/build_info.h"

#include <CGAL/version.h>
#include <fmt/format.h>
#include <gdal.h>
#include <geos_c.h>
#include <tbb/version.h>
#include <boost/version.hpp>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "harness/build_commit.h"  // generated at each build

namespace plat::harness {

nlohmann::json build_info() {
  return {{"plat_version", PLAT_VERSION},
          {"commit", kBuildCommit},
          {"dirty", kBuildIsDirty},
          {"compiler", PLAT_COMPILER},
          {"compiler_flags", PLAT_COMPILER_FLAGS},
          {"libraries",
           {{"boost", fmt::format("{}.{}.{}", BOOST_VERSION / 100000, BOOST_VERSION / 100 % 1000,
                                  BOOST_VERSION % 100)},
            {"cgal", CGAL_VERSION_STR},
            {"fmt", fmt::format("{}.{}.{}", FMT_VERSION / 10000, FMT_VERSION / 100 % 100,
                                FMT_VERSION % 100)},
            {"gdal", GDALVersionInfo("RELEASE_NAME")},
            {"geos", GEOSversion()},
            {"onetbb", TBB_runtime_version()}}}};
}

std::filesystem::path experiments_folder() {
  const char* folder = std::getenv("PLAT_EXPERIMENTS_DIR");
  return folder != nullptr ? folder : PLAT_SOURCE_EXPERIMENTS_DIR;
}

}  // namespace plat::harness
