#pragma once
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace scantrove {

/// What may be typed for the value of an option or a positional argument.
enum class ValueKind {
  none,    ///< a flag has no value
  text,    ///< free text or numbers
  choice,  ///< one of ReferenceOption::choices
  file,
  folder,
  source,  ///< a recording, a saved scan or a camera
};

/// An option or a positional argument of a command, as its help shows it.
struct ReferenceOption {
  std::vector<std::string> names;  ///< with their dashes ("-h", "--help"); a positional has one without
  std::string value;               ///< "DIR", "auto|tracked|given"; empty: a flag
  ValueKind kind = ValueKind::none;
  std::vector<std::string> choices;
  std::string description;  ///< may have several lines
  bool is_required = false;
  bool is_repeatable = false;
};

/// A command with its options and commands, in the order of the help. Hidden ones are left out.
struct ReferenceCommand {
  std::string name, description;
  std::vector<ReferenceOption> options, positionals;
  std::vector<ReferenceCommand> commands;
};

/// Reads the tree of commands of the parser.
[[nodiscard]] ReferenceCommand readReference(const CLI::App& app);

}  // namespace scantrove
