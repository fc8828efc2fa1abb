# libpetzval-files.so: files and scenes behind the C API, with a copy of the core in it. It shares nothing with
# libpetzval.so except the structs of the C headers, so each may be of another build.
if(NOT TARGET petzval_lib_files OR NOT TARGET petzval_lib_scenes)
  return()
endif()
file(GLOB files_door CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/c/files/*.cpp)
set(map ${PROJECT_SOURCE_DIR}/src/c/files/petzval_files_c.map)
add_library(petzval_files_shared SHARED ${files_door} ${PROJECT_SOURCE_DIR}/src/c/handles.cpp
            ${PROJECT_SOURCE_DIR}/src/c/lent.cpp)
add_library(petzval::files_shared ALIAS petzval_files_shared)
set_target_properties(petzval_files_shared PROPERTIES OUTPUT_NAME petzval-files VERSION ${PROJECT_VERSION} SOVERSION 0
                      EXPORT_NAME files_shared LINK_DEPENDS ${map} LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/lib)
target_compile_definitions(petzval_files_shared PRIVATE PETZVAL_BUILDS_C)
target_link_libraries(petzval_files_shared PRIVATE $<BUILD_INTERFACE:petzval_options>
                      $<BUILD_INTERFACE:nlohmann_json::nlohmann_json> petzval_lib_files petzval_lib_scenes petzval)
target_link_options(petzval_files_shared PRIVATE -Wl,--version-script=${map} ${petzval_no_undefined} -Wl,-z,nodelete
                    -Wl,--exclude-libs,ALL)
target_include_directories(petzval_files_shared INTERFACE
  $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
