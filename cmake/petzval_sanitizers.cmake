# Presets asan and tsan. petzval_sanitizer is empty, asan or tsan.
set(petzval_sanitizer "")
set(petzval_no_undefined -Wl,--no-undefined)
set(petzval_test_seconds 900)     # a test that hangs ends here; tests share their machine
set(petzval_host_environment "")  # more of an interpreter that loads libpetzval.so
if(CMAKE_CXX_FLAGS MATCHES "fsanitize=(address|thread)" AND PETZVAL_TESTS)
  string(SUBSTRING ${CMAKE_MATCH_1} 0 1 petzval_sanitizer)
  string(APPEND petzval_sanitizer san)
  set(petzval_test_seconds 9000)
  # asan's runtime is a shared library that an interpreter loads before our libraries. tsan's must start before
  # any library, so it is a part of our programs, our libraries find it there, and no interpreter runs them.
  if(petzval_sanitizer STREQUAL asan)
    execute_process(COMMAND ${CMAKE_CXX_COMPILER} -print-file-name=libclang_rt.asan-x86_64.so
                    OUTPUT_VARIABLE runtime OUTPUT_STRIP_TRAILING_WHITESPACE)
    if(NOT EXISTS "${runtime}")
      message(FATAL_ERROR "libclang_rt.asan-x86_64.so not found; libclang-rt-14-dev contains it")
    endif()
    get_filename_component(runtime_folder ${runtime} DIRECTORY)
    add_link_options(-shared-libsan -Wl,-rpath,${runtime_folder})
    # Memory that an interpreter holds to its end is no leak of ours.
    set(petzval_host_environment ";LD_PRELOAD=${runtime};ASAN_OPTIONS=exitcode=99:detect_leaks=0")
  else()
    set(petzval_no_undefined "")
  endif()
  # ctest sets these for every test. No exit code of the program is 99.
  file(WRITE ${PROJECT_BINARY_DIR}/sanitizer_environment.cmake
       "set(ENV{PETZVAL_SANITIZED} 1)\n"
       "set(ENV{ASAN_OPTIONS} exitcode=99)\n"
       "set(ENV{LSAN_OPTIONS} suppressions=${PROJECT_SOURCE_DIR}/tests/lsan.txt:print_suppressions=0)\n"
       "set(ENV{UBSAN_OPTIONS} exitcode=99:print_stacktrace=1)\n"
       "set(ENV{TSAN_OPTIONS} exitcode=99:suppressions=${PROJECT_SOURCE_DIR}/tests/tsan.txt)\n")
  set_property(DIRECTORY ${PROJECT_SOURCE_DIR} APPEND PROPERTY TEST_INCLUDE_FILES
               ${PROJECT_BINARY_DIR}/sanitizer_environment.cmake)
endif()

# petzval_keeps_libraries(TARGET): under a sanitizer the program unloads no library, such as a driver.
function(petzval_keeps_libraries target)
  if(petzval_sanitizer)
    target_sources(${target} PRIVATE ${PROJECT_SOURCE_DIR}/cmake/keep_libraries.cpp)
    target_link_options(${target} PRIVATE -Wl,--export-dynamic-symbol=dlclose)
  endif()
endfunction()
