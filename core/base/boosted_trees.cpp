#include "core/base/boosted_trees.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/base/check.h"

namespace scantrove {
namespace {

constexpr int kMaxLevels = 16;

/// Describes the first difference of the two lists.
Result<void> checkFeatures(const std::vector<std::string>& in_file,
                           std::span<const std::string_view> expected) {
  const auto [file, program] = std::ranges::mismatch(in_file, expected);
  if (file == in_file.end() && program == expected.end()) return {};
  const auto quoted = [](bool is_end, std::string_view name) {
    return is_end ? std::string("no more") : fmt::format("'{}'", name);
  };
  return fail(fmt::format("its feature {} is {}, and the program computes {}", file - in_file.begin() + 1,
                          quoted(file == in_file.end(), file == in_file.end() ? "" : *file),
                          quoted(program == expected.end(), program == expected.end() ? "" : *program)));
}

}  // namespace

Result<BoostedTrees> BoostedTrees::parse(const ModelFile& file, std::span<const std::string_view> features) {
  BoostedTrees trees;
  Result<void> read;
  try {
    read = trees.read(file.json, features);
  } catch (const nlohmann::json::exception& e) {
    read = fail(e.what());
  }
  if (read) return trees;
  return fail(fmt::format("The model {} cannot be used: {}.", file.path, read.error().what),
              "Train it anew, see tools/train/README.md.");
}

BoostedTrees BoostedTrees::embedded(const ModelFile& file, std::span<const std::string_view> features) {
  Result<BoostedTrees> trees = parse(file, features);
  if (!trees) {
    std::fprintf(stderr, "scantrove: %s\n", trees.error().message().c_str());
    std::abort();
  }
  return std::move(*trees);
}

Result<void> BoostedTrees::read(std::string_view json, std::span<const std::string_view> features) {
  const nlohmann::json model = nlohmann::json::parse(json);
  SCANTROVE_TRY(checkFeatures(model.at("features").get<std::vector<std::string>>(), features));
  medians_.assign(features.size(), std::numeric_limits<float>::quiet_NaN());
  for (const auto& [name, median] : model.at("medians").items()) {
    const auto feature = std::ranges::find(features, name);
    if (feature == features.end()) return fail(fmt::format("its median '{}' is of no feature", name));
    medians_[static_cast<std::size_t>(feature - features.begin())] = median.get<float>();
  }
  prior_ = model.at("prior").get<float>();
  const int levels = model.at("levels").get<int>();
  if (levels < 1 || levels > kMaxLevels) return fail(fmt::format("its trees have {} levels", levels));
  const std::size_t leaves = std::size_t{1} << levels;
  splits_per_tree_ = leaves - 1;
  for (const auto& tree : model.at("trees")) {
    if (tree.size() != 2 * splits_per_tree_ + leaves)
      return fail(fmt::format("tree {} holds {} numbers", leaves_.size() / leaves, tree.size()));
    auto number = tree.begin();
    for (std::size_t i = 0; i < splits_per_tree_; ++i, number += 2) {
      const int feature = number->get<int>();
      if (feature < 0 || feature >= static_cast<int>(features.size()))
        return fail(fmt::format("a tree asks for feature {}", feature));
      splits_.push_back({feature, std::next(number)->get<float>()});
    }
    for (; number != tree.end(); ++number) leaves_.push_back(number->get<float>());
  }
  return {};
}

float BoostedTrees::logOdds(std::span<float> features) const {
  SCANTROVE_CHECK(features.size() == medians_.size());
  for (std::size_t i = 0; i < features.size(); ++i) {
    if (std::isnan(features[i])) features[i] = medians_[i];
  }
  float sum = prior_;
  const Split* splits = splits_.data();
  for (const float* leaves = leaves_.data(); leaves != leaves_.data() + leaves_.size();
       leaves += splits_per_tree_ + 1, splits += splits_per_tree_) {
    std::size_t node = 0;
    while (node < splits_per_tree_) {
      const auto [feature, limit] = splits[node];
      node = 2 * node + (features[static_cast<std::size_t>(feature)] <= limit ? 1 : 2);
    }
    sum += leaves[node - splits_per_tree_];
  }
  return sum;
}

}  // namespace scantrove
