#pragma once
#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <string>

#include "core/base/result.h"
#include "core/catalogue/object_database.h"

namespace scantrove {

/// Opens a catalogue that must exist. Error: there is none; or as ObjectDatabase::open.
[[nodiscard]] Result<std::unique_ptr<ObjectDatabase>> openExistingCatalogue(const std::string& database);

/// The option --database of commands that have a default.
void addCatalogueOption(CLI::App& command, std::optional<std::string>& database);

/// As openExistingCatalogue(); without `database` that of the default project, which one line on stderr
/// names.
[[nodiscard]] Result<std::unique_ptr<ObjectDatabase>> openChosenCatalogue(
    const std::optional<std::string>& database);

/// The visible object with that id or name. Names are never only digits.
[[nodiscard]] Result<ObjectRecord> findObject(ObjectDatabase& database, const std::string& text);

/// The class with that id, else the visible one of that name, else the oldest hidden or merged one of it.
[[nodiscard]] Result<ObjectClass> findClass(const ClassTable& classes, const std::string& text);

}  // namespace scantrove
