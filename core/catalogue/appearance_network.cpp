#include "core/catalogue/appearance_network.h"

#include <QtCore/QCryptographicHash>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <numeric>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgproc.hpp>

#include "core/base/check.h"
#include "core/base/regular_file.h"

namespace scantrove {
namespace {

namespace fs = std::filesystem;

constexpr int kLargestInput_px = 1024;
constexpr std::size_t kLongestVector = 8192;

/// The text between `before` and the first of `ends`; empty: it is not there.
std::string partOf(const std::string& text, const std::string& before, const char* ends) {
  const std::size_t found = text.find(before);
  if (found == std::string::npos) return {};
  const std::size_t first = found + before.size(), last = text.find_first_of(ends, first);
  return last == std::string::npos ? std::string() : text.substr(first, last - first);
}

/// The error of a network that OpenCV refuses; `reason` is OpenCV's text of many lines.
Error refusalOf(const fs::path& file, const std::string& reason) {
  std::string layer = partOf(reason, "Node [", "@]");
  if (layer.empty()) layer = partOf(reason, "of type \"", "\"");
  if (layer.empty())
    return {"The network " + file.string() + " cannot be read.", "It must be an ONNX file with one input."};
  return {"The network " + file.string() + " has a layer that cannot be read: " + layer + ".",
          "Choose a network of convolutions, or export it with such layers."};
}

std::string hashOf(const std::string& network, const std::string& settings) {
  QCryptographicHash hash(QCryptographicHash::Sha256);
  for (const std::string& text : {std::cref(network), std::cref(settings)})
    hash.addData(QByteArrayView(text.data(), static_cast<qsizetype>(text.size())));
  return hash.result().toHex().toStdString();
}

}  // namespace

Result<AppearanceNetwork> AppearanceNetwork::load(const fs::path& file) {
  const Result<std::string> network = readFile(file);
  if (!network) return fail(network.error().what, "Scan without a network: recognition.model=off.");
  const fs::path settings_file = fs::path(file).replace_extension(".json");
  const Result<std::string> settings = readFile(settings_file);
  if (!settings) {
    return fail(settings.error().what,
                "It says what " + file.filename().string() + " takes: input, mean and scale.");
  }
  AppearanceNetwork loaded;
  SCANTROVE_TRY(moveInto(loaded.input_, readInput(settings_file, *settings)));
  loaded.hash_ = hashOf(*network, *settings);
  // OpenCV reports each unknown layer on stderr, too.
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  try {
    loaded.net_ = cv::dnn::readNetFromONNX(network->data(), network->size());
    loaded.net_.setPreferableBackend(cv::dnn::DNN_BACKEND_OPENCV);
    loaded.net_.setPreferableTarget(cv::dnn::DNN_TARGET_CPU);
    // Some layers are refused only when they run.
    const std::vector<float> vector = loaded.run(cv::Mat::zeros(loaded.input_.size_px, CV_8UC3));
    if (vector.empty() || vector.size() > kLongestVector) {
      return fail("The network " + file.string() + " gives " + std::to_string(vector.size()) +
                      " numbers for a picture.",
                  "It must give one vector of at most " + std::to_string(kLongestVector) + " numbers.");
    }
  } catch (const std::exception& exception) {
    return fail(refusalOf(file, exception.what()));
  }
  return loaded;
}

Result<AppearanceNetwork::Input> AppearanceNetwork::readInput(const fs::path& file, const std::string& json) {
  Input input;
  try {
    const nlohmann::json settings = nlohmann::json::parse(json);
    const auto size = settings.at("input").get<std::array<int, 2>>();
    const auto mean = settings.at("mean").get<std::array<double, 3>>();
    input.size_px = {size[0], size[1]};
    input.mean = {mean[0], mean[1], mean[2]};
    input.scale = settings.at("scale").get<double>();
    input.is_rgb = settings.value("rgb", true);
    input.unrelated = settings.value("unrelated", 1.0F);
  } catch (const nlohmann::json::exception& exception) {
    return fail("The settings " + file.string() + " cannot be read (" + exception.what() + ").",
                R"(They are like {"input": [224, 224], "mean": [123.7, 116.3, 103.5], "scale": 0.0171}.)");
  }
  const auto isSide = [](int side_px) { return side_px >= 1 && side_px <= kLargestInput_px; };
  if (!isSide(input.size_px.width) || !isSide(input.size_px.height)) {
    return fail("The settings " + file.string() + " give an input of impossible size.",
                "Each side is 1 to " + std::to_string(kLargestInput_px) + " pixels.");
  }
  if (!(input.unrelated > 0))
    return fail("In the settings " + file.string() + " 'unrelated' is not above 0.",
                "It is the cosine distance of unrelated objects.");
  return input;
}

std::vector<float> AppearanceNetwork::run(const cv::Mat& picture) {
  const cv::Mat blob =
      cv::dnn::blobFromImage(picture, input_.scale, input_.size_px, input_.mean, input_.is_rgb, false);
  net_.setInput(blob);
  cv::Mat output;
  net_.forward().reshape(1, 1).convertTo(output, CV_32F);
  return {output.begin<float>(), output.end<float>()};
}

std::optional<NetworkVector> AppearanceNetwork::describe(const cv::Mat& color, const cv::Mat& mask) {
  if (color.empty() || mask.empty() || cv::countNonZero(mask) == 0) return std::nullopt;
  SCANTROVE_CHECK(color.type() == CV_8UC3 && mask.type() == CV_8UC1 && color.size() == mask.size());
  const cv::Scalar background =
      input_.is_rgb ? cv::Scalar(input_.mean[2], input_.mean[1], input_.mean[0]) : input_.mean;
  // The smallest canvas of the network's shape that holds the picture.
  const double scale = std::max(static_cast<double>(color.cols) / input_.size_px.width,
                                static_cast<double>(color.rows) / input_.size_px.height);
  const cv::Size canvas_px(std::max(color.cols, cvRound(input_.size_px.width * scale)),
                           std::max(color.rows, cvRound(input_.size_px.height * scale)));
  cv::Mat picture(canvas_px, CV_8UC3, background);
  const cv::Rect place((canvas_px.width - color.cols) / 2, (canvas_px.height - color.rows) / 2, color.cols,
                       color.rows);
  color.copyTo(picture(place), mask);
  cv::Mat small;
  cv::resize(picture, small, input_.size_px, 0, 0, scale > 1 ? cv::INTER_AREA : cv::INTER_LINEAR);
  NetworkVector vector{hash_, {}};
  try {
    vector.values = run(small);
  } catch (const std::exception&) {
    return std::nullopt;  // memory: load() has run the network at this size
  }
  const double length = cv::norm(vector.values, cv::NORM_L2);
  if (!std::isfinite(length) || length <= 0) return std::nullopt;
  for (float& value : vector.values) value /= static_cast<float>(length);
  return vector;
}

std::optional<float> AppearanceNetwork::distance(const std::optional<NetworkVector>& a,
                                                 const std::optional<NetworkVector>& b) const {
  if (!a || !b || a->network != hash_ || b->network != hash_ || a->values.size() != b->values.size())
    return std::nullopt;
  const float cosine = std::inner_product(a->values.begin(), a->values.end(), b->values.begin(), 0.0F);
  return std::max(1 - cosine, 0.0F) / input_.unrelated;
}

}  // namespace scantrove
