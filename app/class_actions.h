#pragma once
#include <CLI/CLI.hpp>
#include <functional>
#include <memory>

#include "app/command_job.h"
#include "core/base/result.h"
#include "core/catalogue/object_database.h"

namespace scantrove {

/// How a group of commands finds its catalogue.
struct CataloguePlace {
  /// Adds the options that name the catalogue to a command.
  std::function<void(CLI::App&)> add_options;
  std::function<Result<std::unique_ptr<ObjectDatabase>>()> open;
};

/// Adds list, add, edit, rename, merge, hide, restore, classify, import and export of classes to `classes`,
/// for a catalogue at any place. Their callbacks set `job`.
void addClassActions(CLI::App& classes, CommandJob& job, const CataloguePlace& place);

}  // namespace scantrove
