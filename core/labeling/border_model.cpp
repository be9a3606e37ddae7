#include "core/labeling/border_model.h"

#include <algorithm>
#include <utility>

#include "embedded/border_model.h"

namespace scantrove {
namespace {

/// Weight of an outline on a support, reached after kSureOutline observations.
constexpr float kOutline = 6;
constexpr float kSureOutline = 3;

}  // namespace

BorderModel::BorderModel(BoostedTrees trees)
    : trees_(std::move(trees)), reads_outlines_(trees_.reads("outlined") || trees_.reads("outlined_part")) {}

Result<BorderModel> BorderModel::parse(const ModelFile& file) {
  Result<BoostedTrees> trees = BoostedTrees::parse(file, namesOf(kBorderFeatures));
  if (!trees) return fail(std::move(trees).error());
  return BorderModel(std::move(*trees));
}

const BorderModel& BorderModel::embedded() {
  static const BorderModel model(BoostedTrees::embedded(models::border, namesOf(kBorderFeatures)));
  return model;
}

float BorderModel::logOdds(const SizedBorder& border) const {
  std::array values = valuesOf(kBorderFeatures, border);
  return trees_.logOdds(values);
}

float outlineRule(float outlined, float unoutlined) {
  const float more = outlined - unoutlined;
  return more > 0 ? -kOutline * more / std::max(kSureOutline, outlined + unoutlined) : 0;
}

}  // namespace scantrove
