# Writes the commit that is being built into a header, and touches it only where that has changed.
# cmake -DSOURCE_DIR=... -DOUTPUT=... -P WriteBuildCommit.cmake
execute_process(COMMAND git rev-parse HEAD WORKING_DIRECTORY "${SOURCE_DIR}" OUTPUT_VARIABLE commit
                OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
execute_process(COMMAND git status --porcelain --untracked-files=no WORKING_DIRECTORY "${SOURCE_DIR}" OUTPUT_VARIABLE changes
                OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(NOT commit)
  set(commit "unknown")
endif()
set(dirty "false")
if(changes)
  set(dirty "true")
endif()
file(CONFIGURE OUTPUT "${OUTPUT}" @ONLY CONTENT "#pragma once

namespace plat::harness {

inline constexpr const char* kBuildCommit = \"@commit@\";
inline constexpr bool kBuildIsDirty = @dirty@;

}  // namespace plat::harness
")
