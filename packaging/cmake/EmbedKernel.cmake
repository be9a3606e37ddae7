# Writes OUTPUT, a C++ source that defines scantrove::kernels::IDENTIFIER with the text of the OpenCL file INPUT.
# Lines of the form  #include "core/..."  are replaced by that file (from ROOT), and #line directives keep the
# compiler's messages pointing into the real files.
function(expand path out)
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
    expand("${included}" inner)
    string(APPEND result "${before}${inner}\n#line ${line_number} \"${path}\"\n")
  endwhile()
  set(${out} "${result}${text}" PARENT_SCOPE)
endfunction()

file(RELATIVE_PATH path "${ROOT}" "${INPUT}")
expand("${path}" text)
set(temporary "${OUTPUT}.cl")
file(WRITE "${temporary}" "${text}")
file(READ "${temporary}" bytes HEX)
file(REMOVE "${temporary}")
string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${bytes}")
file(WRITE "${OUTPUT}" "// Made from ${path}; do not edit.
#include \"core/compute/kernel_source.h\"
namespace {
const unsigned char kText[] = {${bytes}0x00};
}  // namespace
namespace scantrove::kernels {
extern const KernelSource ${IDENTIFIER};
const KernelSource ${IDENTIFIER}{\"${path}\", {reinterpret_cast<const char*>(kText), sizeof(kText) - 1}};
}  // namespace scantrove::kernels
")
