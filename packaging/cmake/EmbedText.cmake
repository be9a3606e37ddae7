# scantrove_embed_migrations(<target> <file>...): embeds the numbered SQL files NNN_name.sql, byte for byte and in
# order, as scantrove::schema::migrations() (see core/catalog/migrations.h).
# Run as a script (cmake -P) with INPUTS and OUTPUT this file is also the one that writes the source.
if(CMAKE_SCRIPT_MODE_FILE)
  set(texts "")
  set(rows "")
  foreach(input IN LISTS INPUTS)
    get_filename_component(name "${input}" NAME)
    string(REGEX MATCH "^([0-9][0-9][0-9])_" matched "${name}")
    if(NOT matched)
      message(FATAL_ERROR "${input}: a migration is called NNN_name.sql")
    endif()
    math(EXPR version "1${CMAKE_MATCH_1} - 1000")
    file(READ "${input}" bytes HEX)
    string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${bytes}")
    string(APPEND texts "const unsigned char kText${version}[] = {${bytes}0x00};\n")
    string(APPEND rows
      "    {${version}, \"${name}\", {reinterpret_cast<const char*>(kText${version}), sizeof(kText${version}) - 1}},\n")
  endforeach()
  file(WRITE "${OUTPUT}" "// Made from core/catalog/schema; do not edit.
#include \"core/catalog/migrations.h\"
namespace scantrove::schema {
namespace {
${texts}const Migration kRows[] = {
${rows}};
}  // namespace
std::span<const Migration> migrations() { return kRows; }
}  // namespace scantrove::schema
")
  return()
endif()

set(SCANTROVE_EMBED_TEXT_SCRIPT "${CMAKE_CURRENT_LIST_FILE}")

function(scantrove_embed_migrations target)
  set(inputs ${ARGN})
  list(SORT inputs)
  set(output "${CMAKE_CURRENT_BINARY_DIR}/generated/embedded/migrations.cpp")
  # A list inside one argument: the semicolons are kept by VERBATIM.
  add_custom_command(
    OUTPUT "${output}"
    COMMAND ${CMAKE_COMMAND} "-DINPUTS=${inputs}" "-DOUTPUT=${output}" -P "${SCANTROVE_EMBED_TEXT_SCRIPT}"
    DEPENDS ${inputs} "${SCANTROVE_EMBED_TEXT_SCRIPT}"
    COMMENT "Embedding the catalogue's schema" VERBATIM)
  target_sources(${target} PRIVATE "${output}")
endfunction()
