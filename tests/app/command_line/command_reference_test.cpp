// The manual page and the completions are made from a small parser whose every word is known.
#include "app/command_reference.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "app/command_line.h"
#include "app/manual_page.h"
#include "app/shell_completion.h"
#include "tests/support/child_process.h"
#include "tests/support/temporary_folder.h"

namespace scantrove::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

/// wash [--gentle] {dry --heat low|high [ITEM...], show list DIR}
class SmallParser {
 public:
  SmallParser() {
    app.add_flag("-g,--gentle", gentle_, "it's [very] gentle");
    CLI::App* dry = app.add_subcommand("dry", "Dry things");
    dry->add_option("--heat", heat_, "how warm: low-high")
        ->required()
        ->check(CLI::IsMember({"low", "high"}))
        ->type_name("low|high");
    dry->add_option("--into", into_, ".basket")->type_name("DIR");
    dry->add_option("ITEM", items_, "what to dry");
    CLI::App* show = app.add_subcommand("show", "Show things");
    show->add_subcommand("list", "List them")->add_option("DIR", into_, "where")->required();
    app.add_subcommand("secret", "Not for the help")->group("");
  }
  CLI::App app{"Wash laundry\nSecond line", "wash"};

 private:
  bool gentle_ = false;
  std::string heat_, into_;
  std::vector<std::string> items_;
};

TEST(CommandReference, ReadsCommandsOptionsAndChoices) {
  const SmallParser parser;
  const ReferenceCommand wash = readReference(parser.app);
  EXPECT_EQ(wash.name, "wash");
  ASSERT_EQ(wash.commands.size(), 2U);  // not the hidden one
  const ReferenceCommand& dry = wash.commands[0];
  EXPECT_EQ(dry.name, "dry");
  EXPECT_EQ(dry.description, "Dry things");
  ASSERT_EQ(dry.options.size(), 3U);  // --help first
  EXPECT_THAT(dry.options[0].names, ElementsAre("-h", "--help"));
  EXPECT_EQ(dry.options[0].kind, ValueKind::none);
  EXPECT_THAT(dry.options[1].names, ElementsAre("--heat"));
  EXPECT_EQ(dry.options[1].value, "low|high");
  EXPECT_EQ(dry.options[1].kind, ValueKind::choice);
  EXPECT_THAT(dry.options[1].choices, testing::UnorderedElementsAre("low", "high"));
  EXPECT_TRUE(dry.options[1].is_required);
  EXPECT_FALSE(dry.options[1].is_repeatable);
  EXPECT_EQ(dry.options[2].kind, ValueKind::folder);
  ASSERT_EQ(dry.positionals.size(), 1U);
  EXPECT_EQ(dry.positionals[0].kind, ValueKind::text);
  EXPECT_TRUE(dry.positionals[0].is_repeatable);
  ASSERT_EQ(wash.commands[1].commands.size(), 1U);
  EXPECT_EQ(wash.commands[1].commands[0].positionals[0].kind, ValueKind::folder);
}

TEST(ManualPage, NamesEveryCommandAndOption) {
  const SmallParser parser;
  const std::string page = manualPage(readReference(parser.app), "1.2.3");
  EXPECT_THAT(page, testing::StartsWith(".TH WASH 1 \"\" \"wash 1.2.3\""));
  EXPECT_THAT(page, HasSubstr(".SH NAME\nwash \\- Wash laundry\n"));
  EXPECT_THAT(page, HasSubstr(".SS \"wash dry\"\nDry things\n"));
  EXPECT_THAT(page, HasSubstr("\\fB\\-\\-heat\\fR \\fIlow|high\\fR\nhow warm: low\\-high\n"));
  EXPECT_THAT(page, HasSubstr(".SS \"wash show list\"\n"));
  EXPECT_THAT(page, HasSubstr("\n\\&.basket\n"));  // no request of roff
  EXPECT_THAT(page, Not(HasSubstr("secret")));
}

/// What bash proposes for the last of `words`.
std::vector<std::string> completed(const std::string& script, const std::string& words, int last,
                                   const std::string& folder = "/") {
  const std::string program = script + "\ncd " + folder + "\nCOMP_WORDS=(" + words +
                              ")\nCOMP_CWORD=" + std::to_string(last) +
                              "\n_${COMP_WORDS[0]}\nprintf '%s\\n' \"${COMPREPLY[@]}\"\n";
  const Finished run = runProgram({"bash", "--norc", "-c", program});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.err, "");
  std::vector<std::string> lines;
  std::istringstream text(run.out);
  for (std::string line; std::getline(text, line);) {
    if (!line.empty()) lines.push_back(line);
  }
  return lines;
}

TEST(BashCompletion, CompletesCommandsOptionsAndValues) {
  const SmallParser parser;
  const std::string script = bashCompletion(readReference(parser.app));
  EXPECT_THAT(completed(script, "wash ''", 1), ElementsAre("dry", "show"));
  EXPECT_THAT(completed(script, "wash d", 1), ElementsAre("dry"));
  EXPECT_THAT(completed(script, "wash show ''", 2), ElementsAre("list"));
  EXPECT_THAT(completed(script, "wash --g", 1), ElementsAre("--gentle"));
  EXPECT_THAT(completed(script, "wash dry --h", 2), testing::UnorderedElementsAre("--help", "--heat"));
  EXPECT_THAT(completed(script, "wash dry --heat l", 3), ElementsAre("low"));
  EXPECT_THAT(completed(script, "wash dry --heat = h", 4), ElementsAre("high"));
  EXPECT_THAT(completed(script, "wash --gentle sh", 2), ElementsAre("show"));
}

TEST(BashCompletion, CompletesFoldersWithSpaces_WhereAFolderIsExpected) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "one two");
  const SmallParser parser;
  const std::string script = bashCompletion(readReference(parser.app));
  EXPECT_THAT(completed(script, "wash show list one", 3, folder / ""), ElementsAre("one two"));
  EXPECT_THAT(completed(script, "wash dry --into o", 3, folder / ""), ElementsAre("one two"));
}

TEST(ZshCompletion, EscapesWhatItsSpecificationsReserve) {
  const SmallParser parser;
  const std::string script = zshCompletion(readReference(parser.app));
  EXPECT_THAT(script, testing::StartsWith("#compdef wash\n"));
  EXPECT_THAT(script, HasSubstr("'(-g --gentle)--gentle[it'\\''s \\[very\\] gentle]'"));
  EXPECT_THAT(script, HasSubstr("[how warm\\: low-high]:low|high:(")) << script;
  EXPECT_THAT(script, HasSubstr("dry) _wash__dry ;;"));
}

/// The text that `scantrove reference KIND` prints.
std::string printed(const char* kind) {
  const std::vector<const char*> argv{"scantrove", "reference", kind};
  const CommandLine line = parseCommandLine(3, argv.data());
  EXPECT_FALSE(line.exit_code) << line.err;
  testing::internal::CaptureStdout();
  EXPECT_TRUE(line.job());
  return testing::internal::GetCapturedStdout();
}

TEST(CommandReference, PrintsThoseOfTheProgram) {
  const std::string page = printed("man");
  for (const char* command : {"scantrove scan", "scantrove session paint", "scantrove objects classes"})
    EXPECT_THAT(page, HasSubstr(std::string(".SS \"") + command)) << command;
  EXPECT_THAT(page, Not(HasSubstr("scantrove reference")));  // hidden
  const std::string script = printed("bash");
  EXPECT_THAT(completed(script, "scantrove exp", 1), ElementsAre("export"));
  EXPECT_THAT(completed(script, "scantrove session und", 2), ElementsAre("undo"));
  EXPECT_THAT(completed(script, "scantrove export x --format co", 4), ElementsAre("coco"));
  EXPECT_THAT(completed(script, "scantrove scan --label", 2), ElementsAre("--label-maps"));
}

}  // namespace
}  // namespace scantrove::test
