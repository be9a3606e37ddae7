#pragma once
#include "core/base/boosted_trees.h"
#include "core/labeling/border_features.h"

namespace scantrove {

/// A border model: trees over those of kBorderFeatures that its file names. Any thread.
class BorderModel {
 public:
  /// Error: as BoostedTrees::parse.
  [[nodiscard]] static Result<BorderModel> parse(const ModelFile& file);
  /// resources/models/border.json.
  [[nodiscard]] static const BorderModel& embedded();

  /// Log-odds that both fragments belong to one object, as trained.
  [[nodiscard]] float logOdds(const SizedBorder& border) const;
  /// Whether the trees read `outlined` or `outlined_part`. Otherwise outlineRule() is used.
  [[nodiscard]] bool readsOutlines() const { return reads_outlines_; }

 private:
  explicit BorderModel(BoostedTrees trees);

  BoostedTrees trees_;
  bool reads_outlines_;
};

/// Term of the log-odds for models that do not read the outlines on supports: below 0 if more observations
/// have an outline than not (BorderEvidence::outlined, unoutlined), else 0.
[[nodiscard]] float outlineRule(float outlined, float unoutlined);

}  // namespace scantrove
