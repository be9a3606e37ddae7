#pragma once
#include <algorithm>
#include <span>
#include <string_view>
#include <vector>

namespace scantrove::train {

/// The features that a model reads, of all that samples hold.
class FeatureChoice {
 public:
  /// All of a table but those with a name in `left_out`, which may name others, too.
  template <class Table, class Names>
  FeatureChoice(const Table& table, const Names& left_out) {
    for (std::size_t column = 0; column < table.size(); ++column) {
      const std::string_view name = table[column].name;
      if (std::ranges::find(left_out, name) != std::ranges::end(left_out)) continue;
      columns_.push_back(column);
      names_.push_back(name);
    }
  }

  [[nodiscard]] const std::vector<std::string_view>& names() const { return names_; }
  [[nodiscard]] bool hasAnyOf(std::span<const std::string_view> names) const {
    return std::ranges::find_first_of(names_, names) != names_.end();
  }
  /// The chosen ones of all features of a sample.
  [[nodiscard]] std::vector<float> of(std::span<const float> all) const {
    std::vector<float> chosen;
    chosen.reserve(columns_.size());
    for (const std::size_t column : columns_) chosen.push_back(all[column]);
    return chosen;
  }

 private:
  std::vector<std::size_t> columns_;
  std::vector<std::string_view> names_;
};

}  // namespace scantrove::train
