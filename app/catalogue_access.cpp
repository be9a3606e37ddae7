#include "app/catalogue_access.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <filesystem>
#include <iostream>

#include "app/command.h"
#include "core/base/text.h"
#include "core/database/server_address.h"
#include "core/project/project.h"

namespace scantrove {
namespace {

/// 0: the text is no id.
std::uint32_t idFrom(const std::string& text) {
  std::uint32_t id = 0;
  const char* end = text.data() + text.size();
  const auto [stop, failure] = std::from_chars(text.data(), end, id);
  return failure == std::errc{} && stop == end ? id : 0;
}

}  // namespace

Result<std::unique_ptr<ObjectDatabase>> openExistingCatalogue(const std::string& database) {
  std::error_code failure;
  if (!isServerAddress(database) && !std::filesystem::exists(database, failure)) {
    if (failure) {
      return fail("Cannot read " + database + " (" + failure.message() + ").", "Check the path.");
    }
    return fail("There is no database " + database + ".",
                "A scan creates one: scantrove scan SOURCE --out DIR.");
  }
  return ObjectDatabase::open(database);
}

void addCatalogueOption(CLI::App& command, std::optional<std::string>& database) {
  command.add_option("--database", database, "the catalogue; without it that of the default project")
      ->type_name("DB");
}

Result<std::unique_ptr<ObjectDatabase>> openChosenCatalogue(const std::optional<std::string>& database) {
  if (database) return openExistingCatalogue(*database);
  const std::string own = defaultProject().catalogue.string();
  auto opened = openExistingCatalogue(own);
  if (opened) std::cerr << "scantrove: the catalogue is " << inLine(own) << ". --database chooses another.\n";
  return opened;
}

Result<ObjectRecord> findObject(ObjectDatabase& database, const std::string& text) {
  if (const std::uint32_t id = idFrom(text); id != 0) return database.object(ObjectId{id});
  const auto by_name = database.findByName(text);
  if (!by_name) return fail(by_name.error());
  if (*by_name) return database.object(*by_name);
  return fail("There is no object '" + text + "'.", "'scantrove objects list' shows names and ids.");
}

Result<ObjectClass> findClass(const ClassTable& classes, const std::string& text) {
  const ObjectClass* found = classes.find(ClassId{idFrom(text)});
  if (found == nullptr) found = classes.named(trimmed(text));
  if (found != nullptr) return *found;
  const auto hidden = std::ranges::find_if(
      classes.all(), [&](const auto& entry) { return entry.second.name == trimmed(text); });
  if (hidden != classes.all().end()) return hidden->second;
  return fail("There is no class '" + text + "'.", "'objects classes list' shows names and ids.");
}

}  // namespace scantrove
