# Sources of a target are compiled several at once: of a small one most time goes to what all of them include and
# instantiate, so that eight at once are done in half the time. What they keep to themselves (`namespace {`) has a name
# of its own among them. Each still includes what it uses; ./dev lint looks at it alone.
set(PETZVAL_BATCH 8 CACHE STRING "Sources compiled at once; 1: each alone, which is quicker where one changes")

# petzval_batches(TARGET ALONE patterns…): ALONE are the sources (regular expressions of their names) that are compiled by
# themselves, having names within that others have too. So are SIMD files: they include themselves.
function(petzval_batches target)
  cmake_parse_arguments(BATCH "" "" "ALONE" ${ARGN})
  if(PETZVAL_BATCH LESS 2)
    return()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${PETZVAL_BATCH})
  get_target_property(sources ${target} SOURCES)
  foreach(source ${sources})
    get_filename_component(file ${source} NAME)
    foreach(pattern .*_simd.cpp ${BATCH_ALONE})
      if(file MATCHES "^${pattern}$")
        set_source_files_properties(${source} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
      endif()
    endforeach()
  endforeach()
endfunction()
