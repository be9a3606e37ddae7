#include "app/manual_page.h"

#include <algorithm>
#include <cctype>

namespace scantrove {
namespace {

/// Text for roff: a hyphen becomes a minus, which can be copied; no line begins a request.
std::string roff(const std::string& text) {
  std::string escaped;
  bool begins_line = true;
  for (const char c : text) {
    if (begins_line && (c == '.' || c == '\'')) escaped += "\\&";
    if (c == '\\') {
      escaped += "\\e";
    } else if (c == '-') {
      escaped += "\\-";
    } else {
      escaped += c;
    }
    begins_line = c == '\n';
  }
  return escaped;
}

std::string bold(const std::string& text) { return "\\fB" + roff(text) + "\\fR"; }
std::string italic(const std::string& text) { return "\\fI" + roff(text) + "\\fR"; }

std::string shownName(const ReferenceOption& positional) {
  const std::string name = italic(positional.names.front()) + (positional.is_repeatable ? "..." : "");
  return positional.is_required ? name : "[" + name + "]";
}

/// "scantrove export [OPTION...] [DIR]" with the options that must be given.
std::string synopsis(const std::string& path, const ReferenceCommand& command) {
  std::string line = bold(path);
  if (!command.commands.empty()) line += " " + italic("COMMAND");
  for (const ReferenceOption& option : command.options) {
    if (option.is_required) line += " " + bold(option.names.back()) + " " + italic(option.value);
  }
  line += " [" + italic("OPTION") + "...]";
  for (const ReferenceOption& positional : command.positionals) line += " " + shownName(positional);
  return line + "\n";
}

void addOption(std::string& page, const ReferenceOption& option) {
  page += ".TP\n";
  for (std::size_t i = 0; i < option.names.size(); ++i) page += (i > 0 ? ", " : "") + bold(option.names[i]);
  if (!option.value.empty()) page += " " + italic(option.value);
  page += "\n" + roff(option.description) + "\n";
}

void addArguments(std::string& page, const ReferenceCommand& command) {
  for (const ReferenceOption& positional : command.positionals) {
    page += ".TP\n" + italic(positional.names.front()) + "\n" + roff(positional.description) + "\n";
  }
  for (const ReferenceOption& option : command.options) addOption(page, option);
}

void addCommand(std::string& page, const std::string& path, const ReferenceCommand& command) {
  page += ".SS \"" + roff(path) + "\"\n" + roff(command.description) + "\n";
  if (command.commands.empty()) {
    page += ".PP\n" + synopsis(path, command);
    addArguments(page, command);
  }
  for (const ReferenceCommand& sub : command.commands) addCommand(page, path + " " + sub.name, sub);
}

std::string inCapitals(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::toupper(c); });
  return text;
}

}  // namespace

std::string manualPage(const ReferenceCommand& program, const std::string& version) {
  const std::string summary = program.description.substr(0, program.description.find('\n'));
  std::string page = ".TH " + inCapitals(program.name) + " 1 \"\" \"" + program.name + " " + version +
                     "\" \"User Commands\"\n.SH NAME\n" + roff(program.name) + " \\- " + roff(summary) +
                     "\n.SH SYNOPSIS\n" + bold(program.name) + " [" + italic("OPTION") + "...]";
  for (const ReferenceOption& positional : program.positionals) page += " " + shownName(positional);
  page += "\n.br\n" + bold(program.name) + " " + italic("COMMAND") + " [" + italic("ARGUMENT") +
          "...]\n.SH DESCRIPTION\n" + roff(program.description) +
          "\n.SH OPTIONS\nThese options are for the window, and stand without a command.\n";
  addArguments(page, program);
  page += ".SH COMMANDS\n";
  for (const ReferenceCommand& command : program.commands)
    addCommand(page, program.name + " " + command.name, command);
  page +=
      ".SH EXIT STATUS\n"
      ".TP\n0\nThe command is done.\n"
      ".TP\n1\nThe command failed; one message on the standard error says why.\n"
      ".TP\n2\nThe command line is wrong.\n";
  return page;
}

}  // namespace scantrove
