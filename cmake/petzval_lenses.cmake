# lenses/*.json compiled into the library: one generated file with every text as a string, so that an installed
# program finds its lenses without looking for files. PETZVAL_LENSES_WITHOUT: members of a lens file that a build which goes
# over the wire leaves out; spaces at line starts go, too.

file(GLOB lens_names CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR}/lenses ${PROJECT_SOURCE_DIR}/lenses/*.json)
list(TRANSFORM lens_names REPLACE "\\.json$" "")
list(SORT lens_names)
set(shelf_source "// Generated from lenses/*.json by cmake/petzval_lenses.cmake.
#include \"lens_files/shelf.h\"

namespace petzval::lens_files {
namespace {
")
set(shelf_items "")
foreach(name ${lens_names})
  set(path ${PROJECT_SOURCE_DIR}/lenses/${name}.json)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${path})
  file(READ ${path} text)
  foreach(member ${PETZVAL_LENSES_WITHOUT})
    string(REGEX REPLACE ",\n \"${member}\": (\\[\n[^]]*\n \\]|\\[[^\n]*\\]|\"[^\n]*\")" "" text "${text}")
  endforeach()
  if(PETZVAL_LENSES_WITHOUT)
    string(REGEX REPLACE "\n *" "" text "${text}")
  endif()
  string(MAKE_C_IDENTIFIER text_${name} variable)
  string(APPEND shelf_source "constexpr std::string_view ${variable} = R\"lens(${text})lens\";\n")
  if(NOT name STREQUAL glasses)
    string(APPEND shelf_items "    {\"${name}\", ${variable}},\n")
  endif()
endforeach()
string(APPEND shelf_source "constexpr ShelfItem kShelf[] = {\n${shelf_items}};
}  // namespace

std::span<const ShelfItem> shelf() { return kShelf; }
std::string_view glasses_text() { return text_glasses; }

}  // namespace petzval::lens_files
")
set(shelf_path ${PROJECT_BINARY_DIR}/generated/lens_shelf.cpp)
# Written only when it changed, so that a new configure does not compile it again.
file(CONFIGURE OUTPUT ${shelf_path} CONTENT "@shelf_source@" @ONLY)
target_sources(petzval_lens_files PRIVATE ${shelf_path})
