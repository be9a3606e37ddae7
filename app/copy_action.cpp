#include "app/copy_action.h"

#include <iostream>
#include <memory>
#include <string>

#include "app/core_application.h"
#include "app/json_output.h"
#include "core/catalogue/catalogue_copy.h"

namespace scantrove {
namespace {

struct CopyCommand {
  std::string from, to;
  bool json = false;
};

Result<void> copyObjects(const CopyCommand& command) {
  const CoreApplication qt;
  const Result<CatalogueCopy> copied = copyCatalogue(command.from, command.to);
  if (!copied) return fail(copied.error());
  if (command.json) {
    printJson({{"objects", copied->objects},
               {"views", copied->views},
               {"classes", copied->classes},
               {"events", copied->events}});
    return {};
  }
  std::cout << "copied  " << copied->objects << " objects, " << copied->views << " views, " << copied->classes
            << " classes and the history of " << copied->events << " changes to " << inLine(command.to)
            << '\n';
  return {};
}

}  // namespace

void addCopyAction(CLI::App& objects, CommandJob& job) {
  auto command = std::make_shared<CopyCommand>();
  CLI::App* sub = objects.add_subcommand(
      "copy", "Copy a whole catalogue, with its history, into an empty one: files and servers, either way");
  sub->add_option("--from", command->from, "the catalogue to copy; it stays as it is")
      ->required()
      ->type_name("DB");
  sub->add_option("--to", command->to, "a new file, or an empty database of a server")
      ->required()
      ->type_name("DB");
  sub->add_flag("--json", command->json, "as JSON");
  sub->callback([command, &job] { job = [command] { return copyObjects(*command); }; });
}

}  // namespace scantrove
