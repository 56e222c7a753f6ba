# target_glsl(TARGET file...): compiles each GLSL entry point to a header of SPIR-V words that C++ includes as
# "spirv/<folder>_<name>_<stage>.h", defining `const uint32_t <folder>_<name>_<stage>_spv[]`.
# Paths are relative to the glsl/ folder; the stage is the last extension but one (shade/shade_points.comp.glsl).
# The .spv file beside it is what the shared-layout test reads.
function(target_glsl target)
  set(glsl_root "${CMAKE_SOURCE_DIR}/glsl")
  set(out_root "${CMAKE_BINARY_DIR}/spirv")
  file(MAKE_DIRECTORY "${out_root}/spirv")
  foreach(source IN LISTS ARGN)
    string(REGEX REPLACE "\\.glsl$" "" stem "${source}")
    string(REGEX REPLACE "[/.]" "_" symbol "${stem}")
    string(REGEX MATCH "[a-z]+$" stage "${stem}")
    set(header "${out_root}/spirv/${symbol}.h")
    set(binary "${out_root}/spirv/${symbol}.spv")
    add_custom_command(
      OUTPUT "${header}" "${binary}"
      COMMAND ${GLSLANG_VALIDATOR} -V --quiet --target-env vulkan1.3 -S ${stage} "-I${glsl_root}" --vn ${symbol}_spv
              --depfile "${header}.d" -o "${header}" "${glsl_root}/${source}"
      COMMAND ${GLSLANG_VALIDATOR} -V --quiet --target-env vulkan1.3 -S ${stage} "-I${glsl_root}" -o "${binary}" "${glsl_root}/${source}"
      DEPENDS "${glsl_root}/${source}"
      DEPFILE "${header}.d"
      COMMENT "GLSL ${source}"
      VERBATIM)
    target_sources(${target} PRIVATE "${header}")
  endforeach()
  target_include_directories(${target} PRIVATE "${out_root}")
endfunction()
