# Sources of a target are compiled several at once: of a small one most time goes to what all of them include and
# instantiate, so that eight at once are done in half the time. What they keep to themselves (`namespace {`) has a name
# of its own among them. Each still includes what it uses; ./dev lint looks at it alone.
set(PETZVAL_BATCH 8 CACHE STRING "Sources compiled at once; 1: each alone, which is quicker where one changes")

# Regular expressions of paths of sources that are compiled by themselves, having names within that others have too.
# (SIMD files are, too: they include themselves.)
set(petzval_alone
    "src/optics/ray_trace"
    "src/lens_files/(read.*|text|expected_values|lens_file_test|saved_files_test|table_test)"
    "src/kernel/draw/(ray_map|sector_kernel_test|transmission)"
    "src/kernel/lenses/(third_order.*|traced_model|lens_test|ideal_lens_test|disc_character_test|make_lens)"
    "src/kernel/keep/kernel_store.*"
    "src/engine/samples/((outlines|behind|silhouettes)/.*|.*_test)"
    "src/engine/lights/(pupil_masks|.*_test)"
    "src/device/cpu/.*"
    "src/glare/streaks"
    "src/device/vulkan/.*"
    "src/lens_facts/lens_section"
    "src/session/(take_test|session|add_glare_test)"
    "src/files/(raster/tiff|channels/(depth_choice|motion_choice_test|layer_choice.*)|exr/hostile_exr_test|exr_write/deep_write|read_frame.*)"
    "src/lens_sheet/(control_ring|disc_strip|drawn_section|field_curves|field_discs|image_formation|spot_figures|sum_of_discs|texture_figures)"
    "src/shot/(shot_camera|shot_test|seen_elsewhere_test|other_lamps_test)"
    "src/scene/((built_in/|gltf/)?[^_/]+|points/[^_]+)"
    "apps/view/(state/fields|make/maker|lens/section_panel|panels/(menu|timeline_panel))"
    "tests/conformance/(edges_test|layers_test)"
)

function(petzval_batches target)
  if(PETZVAL_BATCH LESS 2)
    return()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${PETZVAL_BATCH})
  get_target_property(sources ${target} SOURCES)
  foreach(source ${sources})
    get_filename_component(path ${source} ABSOLUTE)
    file(RELATIVE_PATH path ${PROJECT_SOURCE_DIR} ${path})
    foreach(pattern ".*_simd" ${petzval_alone})
      if(path MATCHES "^${pattern}[.]cpp$")
        set_source_files_properties(${source} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
      endif()
    endforeach()
  endforeach()
endfunction()
