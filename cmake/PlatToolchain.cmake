# Compiler, warnings, sanitizers, caches: what every target of ours is built with.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_VERIFY_INTERFACE_HEADER_SETS ON)
set(CMAKE_CXX_FLAGS_RELWITHDEBINFO "-O2 -g1")
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}")
set(CMAKE_CXX_SCAN_FOR_MODULES OFF)

find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM)
  set(CMAKE_CXX_COMPILER_LAUNCHER "${CCACHE_PROGRAM}")
endif()

# A header in a precompiled header only hits ccache with these two told off.
set(ENV{CCACHE_SLOPPINESS} "pch_defines,time_macros,include_file_mtime,include_file_ctime")

find_program(MOLD_PROGRAM mold)
if(MOLD_PROGRAM)
  add_link_options(-fuse-ld=mold)
endif()

# Same seed, same bytes: no fused multiply-add, whatever the compiler's default is (DESIGN, decision 5).
add_compile_options(-ffp-contract=off)

if(PLAT_SANITIZE)
  add_compile_options(-fsanitize=${PLAT_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${PLAT_SANITIZE})
endif()
if(PLAT_FUZZ)
  add_compile_options(-fsanitize=fuzzer-no-link)
endif()

# CGAL 5.5's half-edge iterators name a member that does not exist, in a function that is never called: g++ does not
# look, clang 19 does unless it parses templates late.
if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
  add_compile_options(-fdelayed-template-parsing -Wno-delayed-template-parsing-in-cxx20)
endif()

# Warnings are errors on our targets only; third parties come in as SYSTEM.
add_library(plat_warnings INTERFACE)
# libstdc++ 12's stable_sort uses a function that it deprecates, and clang 19 reports that at our calls.
target_compile_options(
  plat_warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror
                          $<$<CXX_COMPILER_ID:Clang>:-Wno-deprecated-declarations>)

if(PLAT_TIDY)
  find_program(CLANG_TIDY_PROGRAM clang-tidy-19 REQUIRED)
  set(CMAKE_CXX_CLANG_TIDY "${CLANG_TIDY_PROGRAM}")
endif()
