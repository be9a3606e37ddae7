#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace scantrove::test {

/// A command line of the program in a document.
struct DocumentedCommand {
  int line_number = 0;                 ///< from 1
  std::vector<std::string> arguments;  ///< without the name of the program
};

/// The command lines of the program in the code blocks of a Markdown text: indented by four spaces or more,
/// or fenced. Lines that end in a backslash go on in the next one.
[[nodiscard]] std::vector<DocumentedCommand> documentedCommands(std::string_view markdown);

/// Forms that the documents write for readers, as forms that the parser knows: `[DIR]` is DIR, `SOURCE...` is
/// SOURCE, `a|b` as a command is both. A command that ends in `...` stands for any options: only its help is
/// asked for.
[[nodiscard]] std::vector<std::vector<std::string>> parsableForms(const DocumentedCommand& command);

}  // namespace scantrove::test
