# What `cmake --install` leaves: the program, the archives, their headers, and how others find them, by
# find_package(petzval CONFIG COMPONENTS files scenes c) and by pkg-config (petzval, petzval-files,
# petzval-scenes, petzval-c).
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/petzval)
set(headers include/petzval)
file(RELATIVE_PATH PREFIX_FROM_PC /prefix/${CMAKE_INSTALL_LIBDIR}/pkgconfig /prefix)

# petzval_component(TARGET HEADERS names… PACKAGE name REQUIRES pkg-config modules… LIBS flags DESCRIPTION text)
# LIBS and REQUIRES are public: the archives are static, whoever links them links what they use.
function(petzval_component target)
  cmake_parse_arguments(PC "" "PACKAGE;LIBS;DESCRIPTION" "REQUIRES;HEADERS" ${ARGN})
  if(NOT TARGET ${target})
    return()
  endif()
  install(TARGETS ${target} EXPORT ${PC_PACKAGE} DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(EXPORT ${PC_PACKAGE} NAMESPACE petzval:: FILE ${PC_PACKAGE}-targets.cmake DESTINATION ${package_dir})
  if(PC_HEADERS)
    install(FILES ${PC_HEADERS} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/petzval)
  endif()
  list(JOIN PC_REQUIRES " " PC_REQUIRES)
  get_target_property(PC_ARCHIVE ${target} OUTPUT_NAME)
  if(NOT PC_ARCHIVE)
    set(PC_ARCHIVE ${target})
  endif()
  configure_file(${PROJECT_SOURCE_DIR}/cmake/petzval.pc.in ${PROJECT_BINARY_DIR}/${PC_PACKAGE}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/${PC_PACKAGE}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endfunction()

file(GLOB core_headers CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/include/petzval/*.h)
list(FILTER core_headers EXCLUDE REGEX "/(files|focus_track|frames|lens_report|look_file|ocio|output|scene|shot|track)\\.h$")
list(FILTER core_headers EXCLUDE REGEX "/(petzval_c|petzval_lens_c|petzval_frame_c|petzval_files_c|petzval_run_c|vulkan)\\.h$")
set(c_headers ${headers}/petzval_c.h ${headers}/petzval_lens_c.h ${headers}/petzval_frame_c.h)
if(vulkan)
  list(APPEND c_headers ${headers}/vulkan.h)
endif()
if(PETZVAL_TBB)
  set(tbb_module tbb)
endif()
petzval_component(petzval PACKAGE petzval HEADERS ${core_headers} REQUIRES ${tbb_module} libhwy
                  DESCRIPTION "The depth of field of a real lens, for rendered pictures")
foreach(raster ${rasters})
  string(REGEX REPLACE "JPEG::JPEG" "libjpeg" raster ${raster})
  string(REGEX REPLACE "TIFF::TIFF" "libtiff-4" raster ${raster})
  list(APPEND raster_modules ${raster})
endforeach()
petzval_component(petzval_lib_files PACKAGE petzval-files HEADERS ${headers}/files.h ${headers}/lens_report.h
                  ${headers}/look_file.h ${headers}/output.h ${headers}/shot.h ${headers}/frames.h ${headers}/track.h
                  ${headers}/focus_track.h
                  REQUIRES petzval OpenEXR libpng libdeflate ${raster_modules}
                  DESCRIPTION "EXR, PNG, JPEG and TIFF for petzval")
foreach(folder farm reports shots)
  file(GLOB folder_headers CONFIGURE_DEPENDS ${headers}/${folder}/*.h)
  install(FILES ${folder_headers} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/petzval/${folder})
endforeach()
petzval_component(petzval_lib_scenes PACKAGE petzval-scenes HEADERS ${headers}/scene.h
                  REQUIRES petzval LIBS "-lembree3 ${petzval_gltf_links}" DESCRIPTION "Built-in scenes of petzval")
petzval_component(petzval_lib_scene-files PACKAGE petzval-scene-files
                  REQUIRES petzval-files petzval-scenes DESCRIPTION "Scenes of petzval written to files")
petzval_component(petzval_lib_ocio PACKAGE petzval-ocio HEADERS ${headers}/ocio.h
                  REQUIRES petzval OpenColorIO DESCRIPTION "OpenColorIO displays for petzval")
petzval_component(petzval_shared PACKAGE petzval-c HEADERS ${c_headers}
                  DESCRIPTION "petzval for C: libpetzval.so")
petzval_component(petzval_files_shared PACKAGE petzval-files-c HEADERS ${headers}/petzval_files_c.h ${headers}/petzval_run_c.h REQUIRES petzval-c
                  DESCRIPTION "Files and scenes of petzval for C: libpetzval-files.so")
if(TARGET petzval_cli)
  install(TARGETS petzval_cli RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  set(made ${PROJECT_BINARY_DIR}/apps/cli/help)  # by the program itself, see apps/cli/CMakeLists.txt
  if(NOT CMAKE_CROSSCOMPILING)
    install(FILES ${made}/petzval.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
    install(FILES ${made}/petzval.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME petzval)
    install(FILES ${made}/_petzval DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions)
    install(FILES ${made}/petzval.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)
  endif()
  if(TARGET petzval_view)
    set(desktop ${PROJECT_SOURCE_DIR}/apps/view/desktop)
    install(FILES ${desktop}/petzval.desktop DESTINATION ${CMAKE_INSTALL_DATADIR}/applications)
    install(FILES ${desktop}/petzval.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/mime/packages)
    install(FILES ${PROJECT_SOURCE_DIR}/web/lab/icon.svg RENAME petzval.svg
            DESTINATION ${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/apps)
  endif()
endif()

configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/petzval-config.cmake.in
                              ${PROJECT_BINARY_DIR}/petzval-config.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/petzval-config-version.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/petzval-config.cmake ${PROJECT_BINARY_DIR}/petzval-config-version.cmake
        DESTINATION ${package_dir})
