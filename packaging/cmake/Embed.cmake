# Texts that become part of the program, byte for byte:
#  * scantrove_embed_kernels(<module> <file.cl>...): OpenCL sources, see core/compute/kernel_source.h;
#  * scantrove_embed_program(<module> <file.cl>...): several of them as one;
#  * scantrove_embed_migrations(<module> <NNN_name.sql>...): a schema, see core/database/migrations.h;
#  * scantrove_embed_model(<module> <name>): resources/models/<name>.json, see core/base/boosted_trees.h.
# Run as a script (cmake -P) with KIND, ROOT, INPUTS, OUTPUT and MODULE this file is also what writes the C++ source.
if(CMAKE_SCRIPT_MODE_FILE)
  # The bytes of a text as the elements of an array.
  function(bytes_of text out)
    file(WRITE "${OUTPUT}.text" "${text}")
    file(READ "${OUTPUT}.text" bytes HEX)
    file(REMOVE "${OUTPUT}.text")
    string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${bytes}")
    set(${out} "${bytes}0x00" PARENT_SCOPE)
  endfunction()

  # The text of an OpenCL file in which lines of the form  #include "core/..."  are replaced by that file the first time and
  # by nothing from then on, with #line directives that keep the compiler's messages pointing into the real files.
  function(expand_includes path out)
    file(READ "${ROOT}/${path}" text)
    set(result "#line 1 \"${path}\"\n")
    set(line_number 1)
    while(text MATCHES "#include \"(core/[^\"]*)\"[^\n]*\n")
      set(whole "${CMAKE_MATCH_0}")
      set(included "${CMAKE_MATCH_1}")
      string(FIND "${text}" "${whole}" position)
      string(SUBSTRING "${text}" 0 ${position} before)
      string(LENGTH "${whole}" length)
      math(EXPR rest "${position} + ${length}")
      string(SUBSTRING "${text}" ${rest} -1 text)
      string(REGEX REPLACE "[^\n]" "" newlines "${before}")
      string(LENGTH "${newlines}" count)
      math(EXPR line_number "${line_number} + ${count} + 1")
      get_property(has_been GLOBAL PROPERTY "included_${included}")
      set(inner "")
      if(NOT has_been)
        set_property(GLOBAL PROPERTY "included_${included}" TRUE)
        expand_includes("${included}" inner)
      endif()
      string(APPEND result "${before}${inner}\n#line ${line_number} \"${path}\"\n")
    endwhile()
    set(${out} "${result}${text}" PARENT_SCOPE)
  endfunction()

  if(KIND STREQUAL "kernel" OR KIND STREQUAL "program")
    set(text "")
    foreach(input IN LISTS INPUTS)
      file(RELATIVE_PATH path "${ROOT}" "${input}")
      get_filename_component(identifier "${input}" NAME_WE)
      expand_includes("${path}" expanded)
      string(APPEND text "${expanded}")
    endforeach()
    if(KIND STREQUAL "program")
      set(identifier ${MODULE})
      get_filename_component(path "${path}" DIRECTORY)
    endif()
    bytes_of("${text}" bytes)
    file(WRITE "${OUTPUT}" "// Made from ${path}; do not edit.
#include \"core/compute/kernel_source.h\"
namespace {
const unsigned char kText[] = {${bytes}};
}  // namespace
namespace scantrove::kernels {
extern const KernelSource ${identifier};
const KernelSource ${identifier}{\"${path}\", {reinterpret_cast<const char*>(kText), sizeof(kText) - 1}};
}  // namespace scantrove::kernels
")
    return()
  endif()

  if(KIND STREQUAL "model")
    file(RELATIVE_PATH path "${ROOT}" "${INPUTS}")
    get_filename_component(identifier "${INPUTS}" NAME_WE)
    file(READ "${INPUTS}" text)
    bytes_of("${text}" bytes)
    file(WRITE "${OUTPUT}" "// Made from ${path}; do not edit.
#include \"embedded/${identifier}_model.h\"
namespace {
const unsigned char kText[] = {${bytes}};
}  // namespace
namespace scantrove::models {
const ModelFile ${identifier}{\"${path}\", {reinterpret_cast<const char*>(kText), sizeof(kText) - 1}};
}  // namespace scantrove::models
")
    return()
  endif()

  set(texts "")
  set(rows "")
  foreach(input IN LISTS INPUTS)
    get_filename_component(name "${input}" NAME)
    string(REGEX MATCH "^([0-9][0-9][0-9])_" matched "${name}")
    if(NOT matched)
      message(FATAL_ERROR "${input}: a migration is called NNN_name.sql")
    endif()
    math(EXPR version "1${CMAKE_MATCH_1} - 1000")
    file(READ "${input}" text)
    bytes_of("${text}" bytes)
    string(APPEND texts "const unsigned char kText${version}[] = {${bytes}};\n")
    string(APPEND rows
      "    {${version}, \"${name}\", {reinterpret_cast<const char*>(kText${version}), sizeof(kText${version}) - 1}},\n")
  endforeach()
  file(WRITE "${OUTPUT}" "// Made from core/${MODULE}/schema; do not edit.
#include \"core/database/migrations.h\"
namespace scantrove::schema {
namespace {
${texts}const Migration kRows[] = {
${rows}};
}  // namespace
std::span<const Migration> ${MODULE}Steps();
std::span<const Migration> ${MODULE}Steps() { return kRows; }
}  // namespace scantrove::schema
")
  return()
endif()

set(SCANTROVE_EMBED_SCRIPT "${CMAKE_CURRENT_LIST_FILE}")

# Adds to `target` the source `output`, made from `inputs`; made anew when these, or one of ARGN, change.
function(scantrove_embed target kind output inputs)
  # A list inside one argument: the semicolons are kept by VERBATIM.
  add_custom_command(
    OUTPUT "${output}"
    COMMAND ${CMAKE_COMMAND} "-DKIND=${kind}" "-DROOT=${PROJECT_SOURCE_DIR}" "-DINPUTS=${inputs}"
            "-DOUTPUT=${output}" "-DMODULE=${SCANTROVE_EMBED_MODULE}" -P "${SCANTROVE_EMBED_SCRIPT}"
    DEPENDS ${inputs} ${ARGN} "${SCANTROVE_EMBED_SCRIPT}"
    COMMENT "Embedding into ${target}" VERBATIM)
  set_source_files_properties("${output}" PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON SKIP_PRECOMPILE_HEADERS ON)
  target_sources(${target} PRIVATE "${output}")
endfunction()

# Headers that kernels may include: any change rebuilds every embedded kernel (they are few and small).
macro(scantrove_includable_by_kernels)
  file(GLOB includable CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/core/*/kernels/*.clh"
                                         "${PROJECT_SOURCE_DIR}/core/*/kernels/*.h")
endmacro()

# The source `identifier` becomes reachable as scantrove::kernels::<identifier> after
# #include "embedded/<module>_kernels.h".
function(scantrove_declare_kernels module)
  set(generated "${CMAKE_CURRENT_BINARY_DIR}/generated/embedded")
  set_property(GLOBAL APPEND PROPERTY "scantrove_kernels_of_${module}" ${ARGN})
  get_property(identifiers GLOBAL PROPERTY "scantrove_kernels_of_${module}")
  set(declarations "")
  foreach(identifier IN LISTS identifiers)
    string(APPEND declarations "extern const KernelSource ${identifier};\n")
  endforeach()
  file(CONFIGURE OUTPUT "${generated}/${module}_kernels.h" CONTENT
"#pragma once
#include \"core/compute/kernel_source.h\"
namespace scantrove::kernels {
${declarations}}  // namespace scantrove::kernels
" @ONLY)
  target_include_directories(scantrove_${module} PUBLIC "${CMAKE_CURRENT_BINARY_DIR}/generated")
endfunction()

# Each kernel file verb_noun.cl is a source of its own, verb_noun.
function(scantrove_embed_kernels module)
  scantrove_includable_by_kernels()
  set(generated "${CMAKE_CURRENT_BINARY_DIR}/generated/embedded")
  foreach(kernel IN LISTS ARGN)
    get_filename_component(identifier "${kernel}" NAME_WE)
    get_property(taken GLOBAL PROPERTY "scantrove_kernel_${identifier}")
    if(taken)
      message(FATAL_ERROR "Two kernel files are called ${identifier}.cl: in ${taken} and in ${module}. Rename one.")
    endif()
    set_property(GLOBAL PROPERTY "scantrove_kernel_${identifier}" ${module})
    scantrove_embed(scantrove_${module} kernel "${generated}/${identifier}.cpp" "${CMAKE_CURRENT_SOURCE_DIR}/${kernel}"
                    ${includable})
    scantrove_declare_kernels(${module} ${identifier})
  endforeach()
endfunction()

# All the kernel files together are one source, called as the module: a driver's compiler reads its headers once for all of
# them, which takes longer than a kernel. What they define has one name in all of them.
function(scantrove_embed_program module)
  scantrove_includable_by_kernels()
  list(TRANSFORM ARGN PREPEND "${CMAKE_CURRENT_SOURCE_DIR}/" OUTPUT_VARIABLE inputs)
  set(SCANTROVE_EMBED_MODULE ${module})
  scantrove_embed(scantrove_${module} program "${CMAKE_CURRENT_BINARY_DIR}/generated/embedded/${module}.cpp" "${inputs}"
                  ${includable})
  scantrove_declare_kernels(${module} ${module})
endfunction()

# Reachable as scantrove::schema::<module>Steps().
function(scantrove_embed_migrations module)
  set(inputs ${ARGN})
  list(SORT inputs)
  set(SCANTROVE_EMBED_MODULE ${module})
  scantrove_embed(scantrove_${module} migrations "${CMAKE_CURRENT_BINARY_DIR}/generated/embedded/migrations.cpp" "${inputs}")
endfunction()

# Reachable as scantrove::models::<name> after #include "embedded/<name>_model.h".
function(scantrove_embed_model module name)
  set(generated "${CMAKE_CURRENT_BINARY_DIR}/generated/embedded")
  file(CONFIGURE OUTPUT "${generated}/${name}_model.h" CONTENT
"#pragma once
#include \"core/base/boosted_trees.h\"
namespace scantrove::models {
extern const ModelFile ${name};
}  // namespace scantrove::models
" @ONLY)
  scantrove_embed(scantrove_${module} model "${generated}/${name}.cpp" "${PROJECT_SOURCE_DIR}/resources/models/${name}.json")
  target_include_directories(scantrove_${module} PRIVATE "${CMAKE_CURRENT_BINARY_DIR}/generated")
endfunction()
