# How a module, a test folder and an executable are declared.

add_library(scantrove_settings INTERFACE)
target_include_directories(scantrove_settings INTERFACE "${PROJECT_SOURCE_DIR}")
target_compile_options(scantrove_settings INTERFACE -Wall -Wextra -Wconversion -Wshadow)
if(SCANTROVE_WARNINGS_AS_ERRORS)
  target_compile_options(scantrove_settings INTERFACE -Werror)
endif()
if(SCANTROVE_SANITIZE)
  target_compile_options(scantrove_settings INTERFACE -fsanitize=${SCANTROVE_SANITIZE} -fno-omit-frame-pointer)
  target_link_options(scantrove_settings INTERFACE -fsanitize=${SCANTROVE_SANITIZE})
endif()

# scantrove_module(<name> SOURCES ... [KERNELS ...] [LINK ...])
# Declares the static library scantrove_<name>. Each kernel file verb_noun.cl is embedded and reachable as
# scantrove::kernels::verb_noun after #include "embedded/<name>_kernels.h".
function(scantrove_module name)
  cmake_parse_arguments(ARG "" "" "SOURCES;KERNELS;LINK" ${ARGN})
  add_library(scantrove_${name} STATIC ${ARG_SOURCES})
  target_link_libraries(scantrove_${name} PUBLIC scantrove_settings ${ARG_LINK})
  if(ARG_KERNELS)
    scantrove_embed_kernels(${name} ${ARG_KERNELS})
  endif()
endfunction()

function(scantrove_embed_kernels name)
  set(script "${PROJECT_SOURCE_DIR}/packaging/cmake/EmbedKernel.cmake")
  # Headers that kernels may include: any change rebuilds every embedded kernel (they are few and small).
  file(GLOB includable CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/core/*/kernels/*.clh"
                                         "${PROJECT_SOURCE_DIR}/core/*/kernels/*.h")
  set(generated "${CMAKE_CURRENT_BINARY_DIR}/generated/embedded")
  set(declarations "")
  foreach(kernel IN LISTS ARGN)
    get_filename_component(identifier "${kernel}" NAME_WE)
    get_property(taken GLOBAL PROPERTY "scantrove_kernel_${identifier}")
    if(taken)
      message(FATAL_ERROR "Two kernel files are called ${identifier}.cl: in ${taken} and in ${name}. Rename one.")
    endif()
    set_property(GLOBAL PROPERTY "scantrove_kernel_${identifier}" ${name})
    set(input "${CMAKE_CURRENT_SOURCE_DIR}/${kernel}")
    set(output "${generated}/${identifier}.cpp")
    add_custom_command(
      OUTPUT "${output}"
      COMMAND ${CMAKE_COMMAND} -DINPUT=${input} -DROOT=${PROJECT_SOURCE_DIR} -DIDENTIFIER=${identifier}
              -DOUTPUT=${output} -P ${script}
      DEPENDS "${input}" ${includable} "${script}"
      COMMENT "Embedding ${kernel}" VERBATIM)
    target_sources(scantrove_${name} PRIVATE "${output}")
    string(APPEND declarations "extern const KernelSource ${identifier};\n")
  endforeach()
  file(CONFIGURE OUTPUT "${generated}/${name}_kernels.h" CONTENT
"#pragma once
#include \"core/compute/kernel_source.h\"
namespace scantrove::kernels {
${declarations}}  // namespace scantrove::kernels
" @ONLY)
  target_include_directories(scantrove_${name} PUBLIC "${CMAKE_CURRENT_BINARY_DIR}/generated")
endfunction()
