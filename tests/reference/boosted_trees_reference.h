#pragma once
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

namespace scantrove::test {

/// Boosted trees as tools/train/README.md describes their file.
class BoostedTreesReference {
 public:
  explicit BoostedTreesReference(const std::string& json) : model_(nlohmann::json::parse(json)) {}

  [[nodiscard]] bool names(const std::string& feature) const {
    for (const auto& name : model_.at("features"))
      if (name == feature) return true;
    return false;
  }

  /// `values`: by name, at least those that the file names; NaN: unknown.
  [[nodiscard]] float logOdds(const std::map<std::string, float>& values) const {
    float sum = model_.at("prior").get<float>();
    for (const auto& tree : model_.at("trees")) sum += leafOf(tree, values);
    return sum;
  }

 private:
  [[nodiscard]] float leafOf(const nlohmann::json& tree, const std::map<std::string, float>& values) const {
    const int levels = model_.at("levels").get<int>();
    std::size_t first_of_level = 0, position = 0;
    for (int level = 0; level < levels; ++level) {
      const std::size_t split = 2 * (first_of_level + position);
      const std::string name = model_.at("features").at(tree.at(split).get<std::size_t>());
      float value = values.at(name);
      if (std::isnan(value)) value = model_.at("medians").at(name).get<float>();
      position = 2 * position + (value <= tree.at(split + 1).get<float>() ? 0 : 1);
      first_of_level = 2 * first_of_level + 1;
    }
    return tree.at(2 * first_of_level + position).get<float>();
  }

  nlohmann::json model_;
};

}  // namespace scantrove::test
