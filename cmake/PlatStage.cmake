# One folder of algorithms/ is one stage, one library, one line of dependencies: these lines are the
# data-flow diagram, and tests/house/layers_test.py holds every #include against them.

# plat_stage([DEPENDS stage...] [LINK target...] [LINK_PRIVATE target...])
#   Declares the stage of the current folder. Every .cpp in it is compiled; every .h is public and must
#   compile alone, but for *_internal.h, which may hold CGAL and is only included by .cpp files. What only .cpp files
#   include is linked privately: CGAL::CGAL would put -frounding-math on every consumer.
function(plat_stage)
  cmake_parse_arguments(ARG "" "" "DEPENDS;LINK;LINK_PRIVATE" ${ARGN})
  get_filename_component(stage "${CMAKE_CURRENT_SOURCE_DIR}" NAME)
  file(GLOB sources CONFIGURE_DEPENDS "*.cpp")
  file(GLOB headers CONFIGURE_DEPENDS "*.h")
  list(FILTER headers EXCLUDE REGEX "_internal\\.h$")
  set(target plat_${stage})
  add_library(${target} STATIC ${sources})
  add_library(plat::${stage} ALIAS ${target})
  target_sources(${target} PUBLIC FILE_SET HEADERS BASE_DIRS "${PROJECT_SOURCE_DIR}/algorithms" FILES ${headers})
  target_include_directories(${target} PUBLIC "${PROJECT_SOURCE_DIR}/algorithms")
  target_link_libraries(${target} PRIVATE plat_warnings)
  foreach(dependency IN LISTS ARG_DEPENDS)
    target_link_libraries(${target} PUBLIC plat::${dependency})
  endforeach()
  target_link_libraries(${target} PUBLIC ${ARG_LINK} PRIVATE ${ARG_LINK_PRIVATE})
  set_property(GLOBAL APPEND PROPERTY PLAT_STAGES ${stage})
  set_property(GLOBAL PROPERTY PLAT_STAGE_${stage}_DEPENDS "${ARG_DEPENDS}")
endfunction()

# plat_test(NAME [LINK target...])
#   One test program from every *_test.cpp of the current folder.
function(plat_test name)
  cmake_parse_arguments(ARG "" "LABEL" "LINK" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS "*_test.cpp")
  add_executable(${name} ${sources})
  target_include_directories(${name} PRIVATE "${PROJECT_SOURCE_DIR}/tests")
  target_link_libraries(${name} PRIVATE plat_warnings plat_test_support ${ARG_LINK})
  if(TARGET plat_test_pch)
    target_precompile_headers(${name} REUSE_FROM plat_test_pch)
  endif()
  # An empty label would shift the properties behind it.
  set(properties TIMEOUT 900)
  if(ARG_LABEL)
    list(APPEND properties LABELS "${ARG_LABEL}")
  endif()
  gtest_discover_tests(${name} DISCOVERY_TIMEOUT 60 PROPERTIES ${properties})
endfunction()

# plat_benchmark(NAME [LINK target...])
#   One Google Benchmark program from every *_benchmark.cpp of the current folder.
function(plat_benchmark name)
  cmake_parse_arguments(ARG "" "" "LINK" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS "*_benchmark.cpp")
  add_executable(${name} ${sources})
  target_include_directories(${name} PRIVATE "${PROJECT_SOURCE_DIR}/benchmarks" "${PROJECT_SOURCE_DIR}/tests")
  target_link_libraries(${name} PRIVATE plat_warnings benchmark::benchmark_main ${ARG_LINK})
endfunction()
