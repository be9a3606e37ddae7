#include "app/command_reference.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <string_view>

namespace scantrove {
namespace {

std::vector<std::string> splitAt(std::string_view text, char separator) {
  std::vector<std::string> parts;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(separator), text.size());
    parts.emplace_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return parts;
}

/// CLI11 appends what validators say: "auto|given:{auto,given}".
std::string valueWord(const std::string& type_name) { return type_name.substr(0, type_name.find(':')); }

/// The list of CLI::IsMember, "{auto,given}" at the end of the name of the type.
std::vector<std::string> choicesOf(const std::string& type_name) {
  const std::size_t open = type_name.rfind(":{");
  if (open == std::string::npos || type_name.back() != '}') return {};
  return splitAt(std::string_view(type_name).substr(open + 2, type_name.size() - open - 3), ',');
}

/// The word of the help says what a value is: "DIR2", "FILE".
ValueKind kindOf(const std::string& word) {
  std::string kind = word;
  while (!kind.empty() && std::isdigit(static_cast<unsigned char>(kind.back())) != 0) kind.pop_back();
  if (kind == "SOURCE") return ValueKind::source;
  if (kind == "DIR" || kind == "FOLDER" || kind == "PROJECT") return ValueKind::folder;
  if (kind == "FILE" || kind == "PATH" || kind == "DB" || kind == "MASK" || kind == "LIST")
    return ValueKind::file;
  return ValueKind::text;
}

ReferenceOption readOption(const CLI::Option& option) {
  ReferenceOption read;
  read.description = option.get_description();
  read.is_required = option.get_required();
  const bool is_flag = option.get_items_expected_max() == 0;
  read.is_repeatable = !is_flag && (option.get_items_expected_max() > 1 ||
                                    option.get_multi_option_policy() == CLI::MultiOptionPolicy::TakeAll);
  if (option.get_positional()) {
    read.names = {option.get_name(true)};
  } else {
    for (const std::string& name : option.get_snames()) read.names.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) read.names.push_back("--" + name);
  }
  if (is_flag) return read;
  const std::string type_name = option.get_type_name();
  read.value = option.get_positional() ? read.names.front() : valueWord(type_name);
  read.choices = choicesOf(type_name);
  read.kind = read.choices.empty() ? kindOf(read.value) : ValueKind::choice;
  return read;
}

}  // namespace

ReferenceCommand readReference(const CLI::App& app) {
  ReferenceCommand command;
  command.name = app.get_name();
  command.description = app.get_description();
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_group().empty()) continue;
    (option->get_positional() ? command.positionals : command.options).push_back(readOption(*option));
  }
  for (const CLI::App* sub : app.get_subcommands(nullptr)) {
    if (!sub->get_group().empty()) command.commands.push_back(readReference(*sub));
  }
  return command;
}

}  // namespace scantrove
