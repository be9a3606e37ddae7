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

/// Where each feature of the file stands among those of the program.
Result<std::vector<int>> placesOf(const std::vector<std::string>& in_file,
                                  std::span<const std::string_view> computed) {
  std::vector<int> places;
  for (const std::string& name : in_file) {
    const auto found = std::ranges::find(computed, name);
    if (found == computed.end())
      return fail(
          fmt::format("its feature {} is '{}', which the program does not compute", places.size() + 1, name));
    const auto place = static_cast<int>(found - computed.begin());
    if (std::ranges::find(places, place) != places.end())
      return fail(fmt::format("it names the feature '{}' twice", name));
    places.push_back(place);
  }
  return places;
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
  names_ = model.at("features").get<std::vector<std::string>>();
  const auto places = placesOf(names_, features);
  if (!places) return fail(places.error());
  medians_.assign(features.size(), std::numeric_limits<float>::quiet_NaN());
  for (const auto& [name, median] : model.at("medians").items()) {
    const auto feature = std::ranges::find(names_, name);
    if (feature == names_.end()) return fail(fmt::format("its median '{}' is of no feature", name));
    const int place = (*places)[static_cast<std::size_t>(feature - names_.begin())];
    medians_[static_cast<std::size_t>(place)] = median.get<float>();
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
      if (feature < 0 || feature >= static_cast<int>(places->size()))
        return fail(fmt::format("a tree asks for feature {}", feature));
      splits_.push_back({(*places)[static_cast<std::size_t>(feature)], std::next(number)->get<float>()});
    }
    for (; number != tree.end(); ++number) leaves_.push_back(number->get<float>());
  }
  return {};
}

bool BoostedTrees::reads(std::string_view feature) const {
  return std::ranges::find(names_, feature) != names_.end();
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
