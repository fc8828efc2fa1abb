# Programs of the device (src/device/vulkan/shaders) as words to be compiled in. Sets petzval_vulkan_words, or leaves
# it empty and says what is missing. The loader is found at run time.
set(petzval_vulkan_words)
find_path(PETZVAL_VULKAN_HEADERS vulkan/vulkan.h)
find_program(PETZVAL_GLSLC glslc)
if(NOT PETZVAL_VULKAN_HEADERS OR NOT PETZVAL_GLSLC)
  message(STATUS "Headers of Vulkan and glslc not found: no device but the CPU is built")
  return()
endif()
file(GLOB_RECURSE shaders CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/device/vulkan/shaders/*.comp)
file(GLOB_RECURSE shared CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/device/vulkan/shaders/*.glsl
     ${PROJECT_SOURCE_DIR}/src/laws/*.h ${PROJECT_SOURCE_DIR}/src/laws/*.inc)
foreach(shader ${shaders})
  get_filename_component(name ${shader} NAME)
  set(words ${PROJECT_BINARY_DIR}/shaders/${name}.inc)
  add_custom_command(OUTPUT ${words} DEPENDS ${shader} ${shared} COMMENT "SPIR-V of ${name}" VERBATIM
                     COMMAND ${PETZVAL_GLSLC} --target-env=vulkan1.2 -O -Werror -mfmt=c
                             -I ${PROJECT_SOURCE_DIR}/src ${shader} -o ${words})
  list(APPEND petzval_vulkan_words ${words})
endforeach()
