#include "tools/train/figures.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "core/base/check.h"

namespace scantrove::train {
namespace {

constexpr double kUndefined = std::numeric_limits<double>::quiet_NaN();
constexpr int kModelWidth = 24;  // characters of a model's column

std::string numberOf(double value) { return std::isnan(value) ? "-" : fmt::format("{:.4f}", value); }

}  // namespace

SceneKind kindOf(std::string_view scene) {
  const auto has = [scene](std::string_view mode) {
    for (std::size_t at = scene.find(':'); at != std::string_view::npos; at = scene.find(':', at + 1)) {
      const std::string_view rest = scene.substr(at + 1);
      if (rest.substr(0, rest.find(':')) == mode) return true;
    }
    return false;
  };
  if (has("hard") || scene.substr(0, scene.find(':')) == "hands") return SceneKind::hard;
  if (has("drab")) return SceneKind::drab;
  return has("uneven") ? SceneKind::uneven : SceneKind::plain;
}

double logLoss(std::span<const Answer> answers, std::span<const float> log_odds) {
  double sum = 0, weights = 0;
  for (std::size_t i = 0; i < answers.size(); ++i) {
    // log(1 + exp(x)) without overflow
    const double x = static_cast<double>(answers[i].is_yes ? -log_odds[i] : log_odds[i]);
    const auto weight = static_cast<double>(answers[i].weight);
    sum += weight * (std::max(x, 0.0) + std::log1p(std::exp(-std::abs(x))));
    weights += weight;
  }
  return weights > 0 ? sum / weights : kUndefined;
}

double areaUnderCurve(std::span<const Answer> answers, std::span<const float> log_odds) {
  std::vector<std::size_t> order(answers.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t i) { return log_odds[i]; });
  double no = 0, yes = 0, ordered = 0;
  for (auto first = order.begin(); first != order.end();) {
    double equal_no = 0, equal_yes = 0;
    auto last = first;
    for (; last != order.end() && log_odds[*last] == log_odds[*first]; ++last)
      (answers[*last].is_yes ? equal_yes : equal_no) += static_cast<double>(answers[*last].weight);
    ordered += equal_yes * (no + equal_no / 2);
    no += equal_no;
    yes += equal_yes;
    first = last;
  }
  return no > 0 && yes > 0 ? ordered / (no * yes) : kUndefined;
}

void Figures::add(std::string model, std::vector<float> log_odds) {
  SCANTROVE_CHECK(log_odds.size() == answers_.size());
  models_.push_back({std::move(model), std::move(log_odds)});
}

template <class IsIn>
std::string Figures::rowOf(std::string_view name, const IsIn& is_in) const {
  std::vector<std::size_t> chosen;
  std::vector<Answer> answers;
  std::size_t yes = 0;
  for (std::size_t i = 0; i < answers_.size(); ++i) {
    if (!is_in(answers_[i])) continue;
    chosen.push_back(i);
    answers.push_back(answers_[i]);
    yes += answers_[i].is_yes ? 1 : 0;
  }
  if (chosen.empty()) return {};
  std::string row = fmt::format("{:<14}{:>9}{:>7.3f}", name, chosen.size(),
                                static_cast<double>(yes) / static_cast<double>(chosen.size()));
  for (const Model& model : models_) {
    std::vector<float> log_odds;
    for (const std::size_t i : chosen) log_odds.push_back(model.log_odds[i]);
    row += fmt::format(
        "{:>{}}", numberOf(logLoss(answers, log_odds)) + "  " + numberOf(areaUnderCurve(answers, log_odds)),
        kModelWidth);
  }
  return row + "\n";
}

std::string Figures::table() const {
  constexpr std::array<std::pair<std::string_view, SceneKind>, 4> kKinds{{{"plain", SceneKind::plain},
                                                                          {"uneven", SceneKind::uneven},
                                                                          {"drab", SceneKind::drab},
                                                                          {"hard", SceneKind::hard}}};
  std::string text = fmt::format("{:<14}{:>9}{:>7}", "scenes", "samples", "yes");
  for (const Model& model : models_) text += fmt::format("{:>{}}", model.name, kModelWidth);
  text += "\n";
  for (const auto& [name, kind] : kKinds)
    text += rowOf(name, [kind = kind](const Answer& answer) { return answer.kind == kind; });
  text += rowOf("all", [](const Answer&) { return true; });
  return text + rowOf("on supports", [](const Answer& answer) { return answer.has_evidence; });
}

}  // namespace scantrove::train
