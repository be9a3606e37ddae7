#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace scantrove {

/// The labels that a data set takes. Background and rejected regions are a choice of their own.
enum class ExportedLabels : std::uint8_t {
  all,       ///< named regions and all objects; one without a name is a class of its own
  named,     ///< with a name or a class
  confirmed  ///< objects that a user has confirmed
};

/// What becomes of objects that images show and that the data set does not label: those without a name, or
/// unconfirmed ones if only confirmed ones are taken. To a learner they look like background.
enum class UnlabeledObjects : std::uint8_t {
  warn,    ///< counted in a note
  ignore,  ///< regions to ignore, in formats that have these; objects without a name are never exported then
  leave    ///< nothing
};

/// What a person chooses of the labels of a scan or a project. Plain data.
struct ExportChoices {
  ExportedLabels labels = ExportedLabels::all;
  std::vector<std::string> classes = {};  ///< only these, by their names; empty: all
  UnlabeledObjects unlabeled = UnlabeledObjects::warn;
  double validation_share = 0.2;  ///< of the frames of one scan, its last ones; a project is split by scan
  // A choice of the frames that a person has checked belongs here, once scans have states of review.

  bool operator==(const ExportChoices&) const = default;
};

}  // namespace scantrove
