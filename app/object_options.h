#pragma once
#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "core/pipeline/object_mask.h"

namespace scantrove {

/// Options for scanning one object alone.
struct ObjectOptions {
  bool is_alone = false;
  std::string box;  ///< "W,D,H" in metres, or empty
  std::string at;   ///< "X,Y" in pixels, or empty

  /// `command` has an option --resume.
  void addTo(CLI::App& command);
  /// None: everything is scanned. Throws CLI::ValidationError (wrong usage).
  [[nodiscard]] std::optional<ObjectChoice> toChoice() const;
};

}  // namespace scantrove
