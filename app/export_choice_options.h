#pragma once
#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/dataset/export_choices.h"
#include "core/dataset/scan_split.h"

namespace scantrove {

/// The options of `export` that choose labels, and scans with their splits.
struct ExportChoiceOptions {
  std::string only, unlabeled, split;
  bool named_only = false, confirmed_only = false;
  std::vector<std::string> classes;
  std::vector<std::string> scans, train, val, test;
  std::uint64_t seed = 0;
  CLI::Option* seed_option = nullptr;

  void addTo(CLI::App& command);

  /// Whether any of the options was given.
  [[nodiscard]] bool isAny() const;
  /// Throws CLI::ValidationError where options contradict each other, or need a project or another format.
  void check(bool is_project, const std::string& format) const;
  /// After check().
  [[nodiscard]] ExportChoices choices() const;
  /// The split of a project, after check().
  [[nodiscard]] ScanSplit scanSplit() const;
  /// The scans of a project to export: those given, else those of the given split; empty: all.
  [[nodiscard]] std::vector<std::string> scanNames() const;
};

}  // namespace scantrove
