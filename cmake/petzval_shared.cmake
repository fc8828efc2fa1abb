# libpetzval.so: the core behind its C door (include/petzval/petzval_c.h), and nothing else to be seen. A program that
# links it needs no C++ of ours, and two hosts' versions of anything inside cannot meet.
file(GLOB c_door CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/c/*.cpp)
if(NOT vulkan)
  list(FILTER c_door EXCLUDE REGEX "/vulkan_pass\\.cpp$")
endif()
get_property(core_objects GLOBAL PROPERTY PETZVAL_CORE_OBJECTS)
get_property(core_links GLOBAL PROPERTY PETZVAL_CORE_LINKS)
set(map ${PROJECT_SOURCE_DIR}/src/c/petzval_c.map)
add_library(petzval_shared SHARED ${c_door} ${core_objects})
add_library(petzval::shared ALIAS petzval_shared)
set_target_properties(petzval_shared PROPERTIES OUTPUT_NAME petzval VERSION ${PROJECT_VERSION} SOVERSION 0
                      EXPORT_NAME shared LINK_DEPENDS ${map} LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/lib)
target_compile_definitions(petzval_shared PRIVATE PETZVAL_BUILDS_C)
# Types of the door are read from its debugging information by tools/check_abi.py; the rest of the core has none.
set_source_files_properties(${c_door} PROPERTIES COMPILE_OPTIONS -g)
target_link_libraries(petzval_shared PRIVATE $<BUILD_INTERFACE:petzval_options> $<BUILD_INTERFACE:nlohmann_json::nlohmann_json>
                      ${core_links})
# nodelete: TBB's workers outlive the sessions, and run in code that dlclose would unmap.
target_link_options(petzval_shared PRIVATE -Wl,--version-script=${map} ${petzval_no_undefined} -Wl,-z,nodelete)
if(PETZVAL_PORTABLE)
  target_link_options(petzval_shared PRIVATE -static-libstdc++ -static-libgcc -s)
  set_target_properties(petzval_shared PROPERTIES BUILD_RPATH "$ORIGIN" INSTALL_RPATH "$ORIGIN")
endif()
target_include_directories(petzval_shared INTERFACE
  $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
