# How a module, a test folder and an executable are declared.
include(Embed)

add_library(scantrove_settings INTERFACE)
target_include_directories(scantrove_settings INTERFACE "${PROJECT_SOURCE_DIR}")
# -fpch-preprocess: for ccache.
target_compile_options(scantrove_settings INTERFACE $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess> -Wall -Wextra -Wconversion -Wshadow)
if(SCANTROVE_WARNINGS_AS_ERRORS)
  target_compile_options(scantrove_settings INTERFACE -Werror)
endif()
if(SCANTROVE_SANITIZE)
  # g++ 12 then takes what <regex> holds for uninitialized. A look at every pointer before each access nearly doubles the
  # time to compile, and what it finds the address sanitizer finds at the access.
  target_compile_options(scantrove_settings INTERFACE -fsanitize=${SCANTROVE_SANITIZE} -fno-omit-frame-pointer
    -fno-sanitize=null,alignment,object-size
    $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
  target_link_options(scantrove_settings INTERFACE -fsanitize=${SCANTROVE_SANITIZE})
endif()

# scantrove_module(<name> SOURCES ... [PROGRAM ...] [KERNELS ...] [LINK ...] [PRECOMPILED core|window])
# Declares the static library scantrove_<name>; kernels are embedded (Embed.cmake), those of PROGRAM as one source, those of
# KERNELS each as its own; heavy foreign headers are precompiled
# (ScantrovePrecompiled.cmake).
function(scantrove_module name)
  cmake_parse_arguments(ARG "" "PRECOMPILED" "SOURCES;PROGRAM;KERNELS;LINK" ${ARGN})
  add_library(scantrove_${name} STATIC ${ARG_SOURCES})
  target_link_libraries(scantrove_${name} PUBLIC scantrove_settings ${ARG_LINK})
  scantrove_compile_together(scantrove_${name})
  if(ARG_PRECOMPILED)
    scantrove_precompile(scantrove_${name} ${ARG_PRECOMPILED})
  endif()
  if(ARG_PROGRAM)
    scantrove_embed_program(${name} ${ARG_PROGRAM})
  endif()
  if(ARG_KERNELS)
    scantrove_embed_kernels(${name} ${ARG_KERNELS})
  endif()
endfunction()
