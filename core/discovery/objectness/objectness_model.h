#pragma once
#include "core/base/boosted_trees.h"
#include "core/discovery/objectness/objectness_features.h"

namespace scantrove {

/// An objectness model: trees over those of kObjectnessFeatures that its file names. Any thread.
class ObjectnessModel {
 public:
  /// Error: as BoostedTrees::parse.
  [[nodiscard]] static Result<ObjectnessModel> parse(const ModelFile& file);
  /// resources/models/objectness.json.
  [[nodiscard]] static const ObjectnessModel& embedded();

  /// Log-odds that the regions are one complete object, as trained.
  [[nodiscard]] float logOdds(const ObjectnessEvidence& evidence) const;
  /// Whether the trees read `support`. Otherwise supportRule() is used.
  [[nodiscard]] bool readsSupport() const { return reads_support_; }

 private:
  explicit ObjectnessModel(BoostedTrees trees);

  BoostedTrees trees_;
  bool reads_support_;
};

/// Log-odds for models that do not read the supports: at most -4 for what is mostly a support
/// (ObjectnessEvidence::support), because tables, shelves and floors carry objects.
[[nodiscard]] float supportRule(float log_odds, float support);

}  // namespace scantrove
