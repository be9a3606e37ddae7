#include "app/shell_completion.h"

#include <algorithm>
#include <string_view>
#include <vector>

namespace scantrove {
namespace {

constexpr std::string_view kSourceWords = "demo camera freenect realsense record3d";

/// Calls `visit` with each command and its path ("scantrove session show"), parents first.
template <class Visit>
void forEachCommand(const ReferenceCommand& command, const std::string& path, const Visit& visit) {
  visit(command, path);
  for (const ReferenceCommand& sub : command.commands) forEachCommand(sub, path + " " + sub.name, visit);
}

std::string joined(const std::vector<std::string>& words, const std::string& separator) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : separator) + word;
  return text;
}

/// In single quotes for a shell.
std::string shellQuoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

// ---- bash

/// The statement that completes a value; empty: nothing can be proposed.
std::string bashValue(const ReferenceOption& option) {
  switch (option.kind) {
    case ValueKind::choice:
      return "words=" + shellQuoted(joined(option.choices, " "));
    case ValueKind::file:
      return "files=-f";
    case ValueKind::folder:
      return "files=-d";
    case ValueKind::source:
      return "files=-f words=" + shellQuoted(std::string(kSourceWords));
    case ValueKind::text:
    case ValueKind::none:
      break;
  }
  return {};
}

std::string bashPaths(const ReferenceCommand& program) {
  std::vector<std::string> paths;
  forEachCommand(program, program.name, [&](const ReferenceCommand& command, const std::string& path) {
    if (&command != &program) paths.push_back(shellQuoted(path));
  });
  return joined(paths, " | ");
}

/// The cases of "PATH OPTION", whose value is to be completed.
std::string bashOptionCases(const ReferenceCommand& program) {
  std::string cases;
  forEachCommand(program, program.name, [&](const ReferenceCommand& command, const std::string& path) {
    for (const ReferenceOption& option : command.options) {
      if (option.kind == ValueKind::none) continue;
      std::vector<std::string> patterns;
      for (const std::string& name : option.names) patterns.push_back(shellQuoted(path + " " + name));
      const std::string value = bashValue(option);
      cases += "    " + joined(patterns, " | ") + ") " + (value.empty() ? "return" : value) + " ;;\n";
    }
  });
  return cases;
}

/// The cases of "PATH": commands and options, and what its positional arguments are.
std::string bashCommandCases(const ReferenceCommand& program) {
  std::string cases;
  forEachCommand(program, program.name, [&](const ReferenceCommand& command, const std::string& path) {
    std::string words, files;
    for (const ReferenceCommand& sub : command.commands) words += (words.empty() ? "" : " ") + sub.name;
    for (const ReferenceOption& positional : command.positionals) {
      if (positional.kind == ValueKind::source) words += " " + std::string(kSourceWords);
      if (positional.kind == ValueKind::choice) words += " " + joined(positional.choices, " ");
      const bool is_path = positional.kind == ValueKind::source || positional.kind == ValueKind::file;
      if (is_path) files = "-f";
      if (positional.kind == ValueKind::folder && files.empty()) files = "-d";
    }
    std::vector<std::string> names;
    for (const ReferenceOption& option : command.options)
      names.insert(names.end(), option.names.begin(), option.names.end());
    cases += "    " + shellQuoted(path) + ")\n      words=" + shellQuoted(words) +
             " options=" + shellQuoted(joined(names, " ")) + (files.empty() ? "" : " files=" + files) +
             " ;;\n";
  });
  return cases;
}

// ---- zsh

/// A text within an option's specification, where brackets and colons have a meaning.
std::string zshText(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '[' || c == ']' || c == ':' || c == '\\') result += '\\';
    result += c == '\n' ? ' ' : c;
  }
  return result;
}

std::string zshAction(const ReferenceOption& option) {
  switch (option.kind) {
    case ValueKind::choice:
      return "(" + joined(option.choices, " ") + ")";
    case ValueKind::file:
      return "_files";
    case ValueKind::folder:
      return "_files -/";
    case ValueKind::source:
      return "_source_of_scan";
    case ValueKind::text:
    case ValueKind::none:
      break;
  }
  return " ";
}

std::string zshFunction(const std::string& path) {
  std::string name = "_";
  for (const char c : path) name += c == ' ' ? std::string("__") : std::string(1, c == '-' ? '_' : c);
  return name;
}

/// One specification for each name of the option; each excludes the others.
std::string zshOption(const ReferenceOption& option) {
  std::string lines;
  for (const std::string& name : option.names) {
    const std::string lead = option.is_repeatable ? "*" : "(" + joined(option.names, " ") + ")";
    // The sign allows --option=value beside --option value.
    const bool is_long = option.kind != ValueKind::none && name.starts_with("--");
    std::string spec = lead + name + (is_long ? "=" : "") + "[" + zshText(option.description) + "]";
    if (option.kind != ValueKind::none) spec += ":" + zshText(option.value) + ":" + zshAction(option);
    lines += "    " + shellQuoted(spec) + " \\\n";
  }
  return lines;
}

std::string zshPositional(const ReferenceOption& positional) {
  const std::string lead = positional.is_repeatable ? "*:" : positional.is_required ? ":" : "::";
  return "    " + shellQuoted(lead + zshText(positional.names.front()) + ":" + zshAction(positional)) +
         " \\\n";
}

/// A command that has commands: the first word is one of them, the rest belongs to it.
std::string zshParent(const ReferenceCommand& command, const std::string& path) {
  std::string names, calls;
  for (const ReferenceCommand& sub : command.commands) {
    const std::string summary = sub.description.substr(0, sub.description.find('\n'));
    names += "        " + shellQuoted(zshText(sub.name) + ":" + zshText(summary)) + "\n";
    calls += "        " + sub.name + ") " + zshFunction(path + " " + sub.name) + " ;;\n";
  }
  std::string others;  // the program itself may also begin with a source
  for (const ReferenceOption& positional : command.positionals) {
    if (positional.kind == ValueKind::source) others = "      _source_of_scan\n";
  }
  return "    '1: :->command' '*:: :->rest'\n"
         "  case $state in\n"
         "    command)\n"
         "      local -a commands=(\n" +
         names +
         "      )\n"
         "      _describe -t commands command commands\n" +
         others +
         "      ;;\n"
         "    rest)\n"
         "      case $line[1] in\n" +
         calls +
         "      esac\n"
         "      ;;\n"
         "  esac\n";
}

}  // namespace

std::string bashCompletion(const ReferenceCommand& program) {
  const std::string function = "_" + program.name;
  return "# bash completion of " + program.name + ", made from its parser.\n" + function +
         "() {\n"
         "  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]}\n"
         "  local path=" +
         program.name +
         " words='' options='' files='' i line\n"
         "  COMPREPLY=()\n"
         "  # --option=value: bash makes three words of it.\n"
         "  if [ \"$word\" = = ]; then\n"
         "    word=''\n"
         "  elif [ \"$before\" = = ]; then\n"
         "    before=${COMP_WORDS[COMP_CWORD-2]}\n"
         "  fi\n"
         "  for ((i = 1; i < COMP_CWORD; ++i)); do\n"
         "    case \"$path ${COMP_WORDS[i]}\" in\n"
         "      " +
         bashPaths(program) +
         ") path+=\" ${COMP_WORDS[i]}\" ;;\n"
         "    esac\n"
         "  done\n"
         "  case \"$path $before\" in\n" +
         bashOptionCases(program) + "    *) case \"$path\" in\n" + bashCommandCases(program) +
         "    esac ;;\n"
         "  esac\n"
         "  if [[ $word == -* ]]; then words=$options; files=''; fi\n"
         "  while IFS= read -r line; do COMPREPLY+=(\"$line\"); done < <(compgen -W \"$words\" -- "
         "\"$word\")\n"
         "  if [ -n \"$files\" ]; then\n"
         "    compopt -o filenames 2>/dev/null\n"
         "    while IFS= read -r line; do COMPREPLY+=(\"$line\"); done < <(compgen \"$files\" -- \"$word\")\n"
         "  fi\n"
         "}\n"
         "complete -F " +
         function + " " + program.name + "\n";
}

std::string zshCompletion(const ReferenceCommand& program) {
  std::string text = "#compdef " + program.name + "\n# Made from the parser of " + program.name +
                     ".\n_source_of_scan() {\n  _alternative 'files:file:_files' 'sources:source:(" +
                     std::string(kSourceWords) + ")'\n}\n";
  forEachCommand(program, program.name, [&](const ReferenceCommand& command, const std::string& path) {
    text += zshFunction(path) +
            "() {\n"
            "  local curcontext=\"$curcontext\" state line\n"
            "  local -A opt_args\n"
            "  _arguments -C \\\n";
    for (const ReferenceOption& option : command.options) text += zshOption(option);
    if (!command.commands.empty()) {
      text += zshParent(command, path);
    } else {
      for (const ReferenceOption& positional : command.positionals) text += zshPositional(positional);
      text += "    && return 0\n";
    }
    text += "}\n";
  });
  // Loaded by its first use, the file is the body of the function; sourced, it registers it.
  return text + "if [ \"$funcstack[1]\" = _" + program.name + " ]; then\n  _" + program.name +
         " \"$@\"\nelse\n  compdef _" + program.name + " " + program.name + "\nfi\n";
}

}  // namespace scantrove
