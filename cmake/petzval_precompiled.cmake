# Headers of others that most sources include are parsed once for all targets of a kind, whose compile options are the
# same: parsing them was three fifths of a clean build. Each source still includes what it uses; ./dev lint compiles it
# without these. Headers whose inline functions instantiate much (CLI11's, nlohmann's) are no gain here: every source that
# takes them compiles all of that once more.
set(petzval_usual_headers <algorithm> <array> <atomic> <cmath> <cstdint> <cstdio> <cstring> <fstream>
    <functional> <limits> <map> <memory> <mutex> <numbers> <optional> <set> <span> <sstream> <string> <utility> <vector>)
set(petzval_empty_source ${PROJECT_BINARY_DIR}/generated/empty.cpp)
file(CONFIGURE OUTPUT ${petzval_empty_source} CONTENT "")

# petzval_precompiled(KIND LINKS libraries… OPTIONS… HEADERS…): what targets of this kind take by petzval_precompile(TARGET KIND).
function(petzval_precompiled kind)
  cmake_parse_arguments(KIND "" "" "LINKS;OPTIONS;HEADERS" ${ARGN})
  add_library(petzval_precompiled_${kind} OBJECT ${petzval_empty_source})
  target_link_libraries(petzval_precompiled_${kind} PRIVATE ${KIND_LINKS})
  target_compile_options(petzval_precompiled_${kind} PRIVATE ${KIND_OPTIONS})
  target_precompile_headers(petzval_precompiled_${kind} PRIVATE ${petzval_usual_headers} ${KIND_HEADERS})
endfunction()

function(petzval_precompile target kind)
  target_precompile_headers(${target} REUSE_FROM petzval_precompiled_${kind})
endfunction()
