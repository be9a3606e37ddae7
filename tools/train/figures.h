#pragma once
#include <span>
#include <string>
#include <vector>

namespace scantrove::train {

/// What is difficult about a synthetic scene.
enum class SceneKind {
  plain,
  uneven,  ///< surfaces have bumps
  drab,    ///< few colours
  hard,    ///< a camera that fails as real ones do; whatever else the scene is
};
/// Of a scene as after "demo:". All scenes with hands are hard.
[[nodiscard]] SceneKind kindOf(std::string_view scene);

/// What is true of a sample, and how much it counts.
struct Answer {
  bool is_yes = false;
  float weight = 1;
  SceneKind kind = SceneKind::plain;
  bool has_evidence = false;  ///< of supports
};

/// Mean of -log(probability of the true answer), by weight. NaN: no samples.
[[nodiscard]] double logLoss(std::span<const Answer> answers, std::span<const float> log_odds);
/// Part of the pairs of a yes and a no that log odds put in the right order (area under the ROC curve), by
/// weight; equal log odds count half. NaN: all have the same answer.
[[nodiscard]] double areaUnderCurve(std::span<const Answer> answers, std::span<const float> log_odds);

/// Log loss and area under the curve of several models on the same samples, by kind of scene.
class Figures {
 public:
  explicit Figures(std::vector<Answer> answers) : answers_(std::move(answers)) {}

  /// `log_odds`: one for each answer, from a model that was not trained on its scene.
  void add(std::string model, std::vector<float> log_odds);
  /// A row for each kind that occurs, one for all samples, and one for those with evidence of supports.
  [[nodiscard]] std::string table() const;

 private:
  struct Model {
    std::string name;
    std::vector<float> log_odds;
  };
  template <class IsIn>
  [[nodiscard]] std::string rowOf(std::string_view name, const IsIn& is_in) const;

  std::vector<Answer> answers_;
  std::vector<Model> models_;
};

}  // namespace scantrove::train
