// The command lines in README and docs are parsed as the program would: unknown commands, options and values
// show.
#include "tests/app/command_line/documented_commands.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "app/command_line.h"
#include "tests/support/source_tree.h"
#include "tests/support/temporary_folder.h"

namespace scantrove::test {
namespace {

using testing::ElementsAre;

/// Replaces what the parser looks up outside of the command line, and what only the reader's computer has:
/// the window's PATH, a list of recordings, the job of a Slurm array.
void replaceWhatIsElsewhere(std::vector<std::string>& arguments, const std::string& list) {
  if (!arguments.empty() && arguments[0] == "PATH") arguments[0] = "demo";
  for (std::size_t i = 1; i < arguments.size(); ++i) {
    const std::string& option = arguments[i - 1];
    if (option == "--list" && !arguments[i].starts_with('-')) arguments[i] = list;
    if (option == "--task" && arguments[i] == "slurm") arguments[i] = "1/8";
  }
}

/// What the parser says against a command line; empty: nothing.
std::string objectionTo(std::vector<std::string> arguments) {
  const TemporaryFolder folder;
  const std::string list = folder / "list.txt";
  std::ofstream(list) << "demo\n";
  replaceWhatIsElsewhere(arguments, list);
  std::vector<const char*> argv{"scantrove"};
  for (const std::string& argument : arguments) argv.push_back(argument.c_str());
  const CommandLine line = parseCommandLine(static_cast<int>(argv.size()), argv.data());
  return line.exit_code.value_or(kDone) == kDone ? std::string() : line.err;
}

/// What the parser says against the command lines of a text.
std::vector<std::string> objectionsTo(const std::string& markdown, const std::string& name) {
  std::vector<std::string> objections;
  for (const DocumentedCommand& command : documentedCommands(markdown)) {
    for (const std::vector<std::string>& form : parsableForms(command)) {
      const std::string objection = objectionTo(form);
      if (!objection.empty())
        objections.push_back(name + ":" + std::to_string(command.line_number) + ": " + objection);
    }
  }
  return objections;
}

std::string textOf(const std::filesystem::path& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

TEST(DocumentedCommands, AreFoundInCodeOnly) {
  const std::vector<DocumentedCommand> found = documentedCommands(
      "scantrove in prose\n"
      "\n"
      "    scantrove scan SOURCE --out DIR      # a comment\n"
      "    SCANTROVE_LOG=debug scantrove params 2> log.txt\n"
      "    packaging/run\n"
      "```bash\n"
      "scantrove session name DIR \\\n"
      "  --name \"blue mug\" | less\n"
      "```\n"
      "scantrove again in prose\n");
  ASSERT_EQ(found.size(), 3U);
  EXPECT_EQ(found[0].line_number, 3);
  EXPECT_THAT(found[0].arguments, ElementsAre("scan", "SOURCE", "--out", "DIR"));
  EXPECT_THAT(found[1].arguments, ElementsAre("params"));
  EXPECT_EQ(found[2].line_number, 7);
  EXPECT_THAT(found[2].arguments, ElementsAre("session", "name", "DIR", "--name", "blue mug"));
}

TEST(DocumentedCommands, StandForWhatTheParserKnows) {
  EXPECT_THAT(parsableForms({1, {"list", "[DIR]", "SOURCE..."}}),
              ElementsAre(ElementsAre("list", "DIR", "SOURCE")));
  EXPECT_THAT(
      parsableForms({1, {"evaluate", "one|two", "..."}}),
      ElementsAre(ElementsAre("evaluate", "one", "--help"), ElementsAre("evaluate", "two", "--help")));
}

TEST(DocumentedCommands, AreReported_WhenWrong) {
  const std::vector<std::string> objections = objectionsTo(
      "    scantrove scan demo --out DIR\n"
      "    scantrove fold-laundry DIR\n"
      "    scantrove scan demo --out DIR --fast\n"
      "    scantrove export DIR --format paper --out DATA\n"
      "    scantrove scan demo\n"
      "    scantrove project scan LAB --list recordings.txt --task slurm\n"
      "    scantrove project scan LAB --task slurm\n",
      "page");
  ASSERT_EQ(objections.size(), 5U);
  EXPECT_THAT(objections[0],
              testing::AllOf(testing::StartsWith("page:2: "), testing::HasSubstr("fold-laundry")));
  EXPECT_THAT(objections[1], testing::AllOf(testing::StartsWith("page:3: "), testing::HasSubstr("--fast")));
  EXPECT_THAT(objections[2], testing::AllOf(testing::StartsWith("page:4: "), testing::HasSubstr("paper")));
  EXPECT_THAT(objections[3], testing::AllOf(testing::StartsWith("page:5: "), testing::HasSubstr("--out")));
  EXPECT_THAT(objections[4], testing::AllOf(testing::StartsWith("page:7: "), testing::HasSubstr("SOURCE")));
}

TEST(DocumentedCommands, AreThoseOfTheProgram) {
  std::vector<std::filesystem::path> files{sourceTree() / "README.md"};
  for (const auto& entry : std::filesystem::recursive_directory_iterator(sourceTree() / "docs")) {
    if (entry.path().extension() == ".md") files.push_back(entry.path());
  }
  std::size_t commands = 0;
  for (const std::filesystem::path& file : files) {
    const std::string text = textOf(file);
    commands += documentedCommands(text).size();
    EXPECT_THAT(objectionsTo(text, file.filename().string()), testing::IsEmpty());
  }
  EXPECT_GT(commands, 100U);
}

}  // namespace
}  // namespace scantrove::test
