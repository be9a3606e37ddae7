#include <string>

#include "app/command.h"
#include "app/manual_page.h"
#include "app/shell_completion.h"

namespace scantrove {

void addReferenceCommand(CLI::App& app, CommandJob& job) {
  CLI::App* sub = app.add_subcommand("reference", "Print the manual page or the completion for a shell");
  sub->group("");  // for packages: not in the help
  sub->add_option("KIND", "what to print")->required()->check(CLI::IsMember({"man", "bash", "zsh"}));
  sub->callback([&app, &job, sub] {
    const auto kind = sub->get_option("KIND")->as<std::string>();
    const ReferenceCommand program = readReference(app);  // now, while the parser is there
    const std::string text = kind == "man"    ? manualPage(program, SCANTROVE_VERSION)
                             : kind == "bash" ? bashCompletion(program)
                                              : zshCompletion(program);
    job = [text]() -> Result<void> {
      std::cout << text;
      return {};
    };
  });
}

}  // namespace scantrove
