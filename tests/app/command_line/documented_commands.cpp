#include "tests/app/command_line/documented_commands.h"

#include <algorithm>
#include <sstream>

namespace scantrove::test {
namespace {

constexpr std::size_t kCodeIndent = 4;
const std::string kProgram = "scantrove";

/// The words of a shell's line up to a comment, a redirection or a pipe.
std::vector<std::string> shellWords(const std::string& line) {
  std::vector<std::string> words;
  std::string word;
  bool is_word = false;
  char quote = 0;
  const auto end = [&] {
    if (is_word) words.push_back(word);
    word.clear();
    is_word = false;
  };
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (quote != 0) {
      c == quote ? void(quote = 0) : word.push_back(c);
      continue;
    }
    const bool is_number = !word.empty() && std::all_of(word.begin(), word.end(), [](char digit) {
      return digit >= '0' && digit <= '9';
    });
    const bool is_pipe = c == '|' && !is_word;
    if (c == '"' || c == '\'') {
      quote = c;
      is_word = true;
    } else if (c == ' ' || c == '\t') {
      end();
    } else if ((c == '#' && !is_word) || is_pipe || c == '>' || c == ';' || c == '&') {
      if (c == '>' && is_number) is_word = false;  // the number of a stream: 2>
      break;
    } else {
      word.push_back(c);
      is_word = true;
    }
  }
  end();
  return words;
}

/// `SCANTROVE_LOG=debug`
bool isVariable(const std::string& word) {
  const std::size_t equals = word.find('=');
  return equals != std::string::npos && equals > 0 &&
         std::all_of(word.begin(), word.begin() + static_cast<std::ptrdiff_t>(equals),
                     [](char c) { return (c >= 'A' && c <= 'Z') || c == '_'; });
}

/// The lines of a text that are code, in place of others an empty line.
std::vector<std::string> codeLines(std::string_view markdown) {
  std::istringstream text{std::string(markdown)};
  std::vector<std::string> lines;
  bool is_fenced = false;
  for (std::string line; std::getline(text, line);) {
    const std::size_t start = std::min(line.find_first_not_of(' '), line.size());
    const bool is_fence = line.compare(start, 3, "```") == 0;
    if (is_fence) is_fenced = !is_fenced;
    const bool is_code = !is_fence && (is_fenced || start >= kCodeIndent);
    lines.push_back(is_code ? line.substr(start) : std::string());
  }
  return lines;
}

std::vector<std::string> splitAtBars(const std::string& word) {
  std::vector<std::string> parts;
  std::istringstream text(word);
  for (std::string part; std::getline(text, part, '|');) parts.push_back(part);
  return parts;
}

}  // namespace

std::vector<DocumentedCommand> documentedCommands(std::string_view markdown) {
  std::vector<DocumentedCommand> commands;
  const std::vector<std::string> lines = codeLines(markdown);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const int line_number = static_cast<int>(i) + 1;
    std::string line = lines[i];
    while (line.ends_with('\\') && i + 1 < lines.size()) {
      line.pop_back();
      line += lines[++i];
    }
    std::vector<std::string> words = shellWords(line);
    const auto first = std::find_if_not(words.begin(), words.end(), isVariable);
    if (first == words.end() || *first != kProgram) continue;
    commands.push_back({line_number, {first + 1, words.end()}});
  }
  return commands;
}

std::vector<std::vector<std::string>> parsableForms(const DocumentedCommand& command) {
  std::vector<std::vector<std::string>> forms{{}};
  for (std::size_t i = 0; i < command.arguments.size(); ++i) {
    std::string word = command.arguments[i];
    const bool is_last = i + 1 == command.arguments.size();
    if (word == "..." && is_last) word = "--help";
    if (word.size() > 3 && word.ends_with("...")) word.resize(word.size() - 3);
    if (word.size() > 2 && word.front() == '[' && word.back() == ']') word = word.substr(1, word.size() - 2);
    std::vector<std::vector<std::string>> longer;
    for (const std::string& choice : word.empty() ? std::vector<std::string>{word} : splitAtBars(word)) {
      for (std::vector<std::string> form : forms) {
        form.push_back(choice);
        longer.push_back(std::move(form));
      }
    }
    forms = std::move(longer);
  }
  return forms;
}

}  // namespace scantrove::test
