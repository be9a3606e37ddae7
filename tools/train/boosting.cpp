#include "tools/train/boosting.h"

#include <spdlog/fmt/fmt.h>
#include <spdlog/fmt/ranges.h>
#include <xgboost/c_api.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>

namespace scantrove::train {
namespace {

using Json = nlohmann::json;

constexpr float kAlwaysLeft = 1e30F;

/// In as few digits as say which float it is.
Json shortest(float value) { return Json::parse(fmt::format("{}", value)); }

void check(int status) {
  if (status != 0) throw std::runtime_error(XGBGetLastError());
}

struct FreeMatrix {
  void operator()(void* matrix) const { XGDMatrixFree(matrix); }
};
struct FreeBooster {
  void operator()(void* booster) const { XGBoosterFree(booster); }
};
using Matrix = std::unique_ptr<void, FreeMatrix>;
using Booster = std::unique_ptr<void, FreeBooster>;

std::vector<float> mediansOf(std::span<const Example> examples) {
  std::vector<float> medians;
  for (std::size_t f = 0; f < examples.front().x.size(); ++f) {
    std::vector<float> known;
    for (const Example& example : examples) {
      if (!std::isnan(example.x[f])) known.push_back(example.x[f]);
    }
    const auto middle = known.begin() + static_cast<std::ptrdiff_t>(known.size() / 2);
    std::ranges::nth_element(known, middle);
    medians.push_back(known.empty() ? 0 : *middle);
  }
  return medians;
}

Matrix matrixOf(std::span<const Example> examples, const std::vector<float>& medians) {
  std::vector<float> values, answers, weights;
  for (const Example& example : examples) {
    for (std::size_t f = 0; f < example.x.size(); ++f)
      values.push_back(std::isnan(example.x[f]) ? medians[f] : example.x[f]);
    answers.push_back(example.is_yes ? 1.0F : 0.0F);
    weights.push_back(example.weight);
  }
  DMatrixHandle handle = nullptr;
  check(XGDMatrixCreateFromMat(values.data(), examples.size(), examples.front().x.size(),
                               std::numeric_limits<float>::quiet_NaN(), &handle));
  Matrix matrix(handle);
  check(XGDMatrixSetFloatInfo(handle, "label", answers.data(), answers.size()));
  check(XGDMatrixSetFloatInfo(handle, "weight", weights.data(), weights.size()));
  return matrix;
}

/// Part of the weight that is yes.
double priorOf(std::span<const Example> examples) {
  double yes = 0, all = 0;
  for (const Example& example : examples) {
    all += static_cast<double>(example.weight);
    yes += example.is_yes ? static_cast<double>(example.weight) : 0;
  }
  return yes / all;
}

Booster boost(const Matrix& matrix, double prior, const BoostingParams& params) {
  const DMatrixHandle matrices[] = {matrix.get()};
  BoosterHandle handle = nullptr;
  check(XGBoosterCreate(matrices, 1, &handle));
  Booster booster(handle);
  const auto set = [handle](const char* name, const std::string& value) {
    check(XGBoosterSetParam(handle, name, value.c_str()));
  };
  set("objective", "binary:logistic");
  set("base_score", fmt::format("{}", prior));
  set("tree_method", "hist");
  set("nthread", "1");  // the order of sums stays the same
  set("seed", "1");
  set("max_depth", fmt::format("{}", params.levels));
  set("eta", fmt::format("{}", params.learning_rate));
  set("lambda", fmt::format("{}", params.ridge));
  set("min_child_weight", fmt::format("{}", params.min_hessian));
  set("colsample_bytree", fmt::format("{}", params.feature_part));
  if (!params.directions.empty())
    set("monotone_constraints", fmt::format("({})", fmt::join(params.directions, ",")));
  for (int i = 0; i < params.trees; ++i) check(XGBoosterUpdateOneIter(handle, i, matrix.get()));
  return booster;
}

/// A complete tree: the root, its two children, their four, and so on.
struct CompleteTree {
  std::vector<std::pair<int, float>> splits;  // feature, up to this to the left
  std::vector<float> leaves;
};

void fill(const Json& node, std::size_t at, CompleteTree& tree) {
  if (at >= tree.splits.size()) {
    tree.leaves[at - tree.splits.size()] = node.at("leaf").get<float>();
    return;
  }
  if (node.contains("leaf")) {  // an early end: all go to the left
    tree.splits[at] = {0, kAlwaysLeft};
    fill(node, 2 * at + 1, tree);
    fill(node, 2 * at + 2, tree);
    return;
  }
  // XGBoost goes to the left below its limit, the program up to it.
  const float below = node.at("split_condition").get<float>();
  tree.splits[at] = {std::stoi(node.at("split").get<std::string>().substr(1)),
                     std::nextafter(below, std::numeric_limits<float>::lowest())};
  for (const Json& child : node.at("children")) {
    const bool is_left = child.at("nodeid") == node.at("yes");
    fill(child, 2 * at + (is_left ? 1 : 2), tree);
  }
}

std::vector<std::string> treesOf(const Booster& booster, int levels) {
  bst_ulong count = 0;
  const char** texts = nullptr;
  check(XGBoosterDumpModelEx(booster.get(), "", 0, "json", &count, &texts));
  std::vector<std::string> lines;
  for (const char* text : std::span(texts, count)) {
    CompleteTree tree;
    tree.leaves.resize(std::size_t{1} << levels);
    tree.splits.resize(tree.leaves.size() - 1);
    fill(Json::parse(text), 0, tree);
    std::vector<std::string> numbers;
    for (const auto& [feature, limit] : tree.splits) numbers.push_back(fmt::format("{},{}", feature, limit));
    for (const float leaf : tree.leaves) numbers.push_back(fmt::format("{:.4g}", leaf));
    lines.push_back(fmt::format("[{}]", fmt::join(numbers, ",")));
  }
  return lines;
}

/// The program's trees must say what XGBoost's say, but for rounded leaves.
Result<void> compare(const BoostedTrees& trees, const Booster& booster, const Matrix& matrix,
                     std::span<const Example> examples) {
  constexpr int kLogOdds = 1, kAllTrees = 0, kNotTraining = 0;
  constexpr float kTolerance = 0.01F;
  bst_ulong count = 0;
  const float* expected = nullptr;
  check(XGBoosterPredict(booster.get(), matrix.get(), kLogOdds, kAllTrees, kNotTraining, &count, &expected));
  for (std::size_t i = 0; i < examples.size(); ++i) {
    std::vector<float> x = examples[i].x;
    const float log_odds = trees.logOdds(x);
    if (std::abs(log_odds - expected[i]) > kTolerance)
      return fail(
          fmt::format("The model says {} of example {}, and XGBoost says {}.", log_odds, i, expected[i]));
  }
  return {};
}

}  // namespace

Provenance provenanceOf(std::span<const SceneSamples> scenes) {
  std::set<std::string> commits;
  std::vector<std::string> names;
  for (const SceneSamples& scene : scenes) {
    commits.insert(scene.origin.commit);
    names.push_back("demo:" + scene.origin.scene);
  }
  const int frames = scenes.empty() ? 0 : scenes.front().origin.frames;
  return {fmt::format("{}", fmt::join(commits, ", ")),
          fmt::format("{} of {} frames each", fmt::join(names, " "), frames)};
}

Result<std::string> trainModel(std::span<const Example> examples, const BoostingParams& params,
                               const ModelDescription& description) {
  const double prior = examples.empty() ? 0 : priorOf(examples);
  if (!(prior > 0 && prior < 1))
    return fail("The examples all have the same answer.", "Take more scenes, or longer ones.");
  const std::vector<float> medians = mediansOf(examples);
  nlohmann::ordered_json head;
  head["question"] = description.question;
  head["provenance"] = {{"trained_by", "tools/train"},
                        {"commit", description.provenance.commit},
                        {"scenes", description.provenance.scenes},
                        {"examples", examples.size()},
                        {"held_out", description.held_out}};
  head["features"] = description.features;
  head["medians"] = nlohmann::ordered_json::object();
  for (std::size_t f = 0; f < medians.size(); ++f)
    head["medians"][std::string(description.features[f])] = shortest(medians[f]);
  head["prior"] = shortest(static_cast<float>(std::log(prior / (1 - prior))));
  head["levels"] = params.levels;
  try {
    const Matrix matrix = matrixOf(examples, medians);
    const Booster booster = boost(matrix, prior, params);
    std::string text = head.dump(1);
    text.resize(text.size() - 2);  // the trees come one a line
    text += fmt::format(",\n \"trees\": [\n{}\n ]\n}}\n", fmt::join(treesOf(booster, params.levels), ",\n"));
    const Result<BoostedTrees> trees = readModel(text, description);
    if (!trees) return fail(trees.error());
    SCANTROVE_TRY(compare(*trees, booster, matrix, examples));
    return text;
  } catch (const std::exception& e) {
    return fail(fmt::format("XGBoost cannot train the model: {}", e.what()));
  }
}

Result<BoostedTrees> readModel(const std::string& text, const ModelDescription& description) {
  return BoostedTrees::parse({"just trained", text}, description.features);
}

}  // namespace scantrove::train
