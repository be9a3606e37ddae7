#include "app/recognition_evaluation.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <map>
#include <numeric>
#include <opencv2/imgproc.hpp>
#include <random>
#include <set>
#include <sstream>

#include "app/command.h"
#include "app/json_output.h"
#include "core/base/text_file.h"
#include "core/capture/image_pairs.h"
#include "core/catalogue/detector.h"
#include "core/discovery/oriented_box.h"
#include "core/evaluation/recognition_metrics.h"
#include "core/exchange/label_image_writer.h"
#include "core/session/param_registry.h"

namespace scantrove {
namespace {

namespace fs = std::filesystem;

constexpr int kInstancesOfAThing = 100;  // LABEL = 100 * thing + instance
constexpr double kMostFalse = 0.01;

struct Crop {
  int image = 0, scene = 0, thing = 0;
  DetectionQuery query;
};

/// Names by number: lines NUMBER,NAME after a heading.
Result<std::map<int, std::string>> readMapping(const fs::path& file) {
  const Result<std::string> text = readTextFile(file);
  if (!text) return fail(text.error().what, "It names the things: a heading, then lines NUMBER,NAME.");
  std::map<int, std::string> names;
  std::istringstream lines(*text);
  for (std::string line; std::getline(lines, line);) {
    int thing = 0;
    const char* const end = line.data() + line.size();
    const auto [stop, error] = std::from_chars(line.data(), end, thing);
    if (error != std::errc() || stop == end || *stop != ',') continue;
    std::string name(stop + 1, end);
    if (name.ends_with('\r')) name.pop_back();
    names[thing] = std::move(name);
  }
  if (names.empty()) return fail(file.string() + " names no things.", "Its lines are NUMBER,NAME.");
  return names;
}

/// Sides of the oriented box of what the depth image shows under the label; zero: too few readings.
Eigen::Vector3f sizeOf(const RgbdFrame& frame, const Intrinsics& K, const cv::Mat& mask) {
  constexpr std::size_t kFewest = 20;
  constexpr float kDeepest_m = 0.3F;  // hand-drawn outlines reach into what lies behind
  std::vector<Eigen::Vector4f> points;
  std::vector<float> depths_m;
  for (int v = 0; v < mask.rows; ++v) {
    for (int u = 0; u < mask.cols; ++u) {
      const float z_m = static_cast<float>(frame.depth.at<std::uint16_t>(v, u)) * frame.meters_per_unit;
      if (mask.at<std::uint8_t>(v, u) == 0 || !(z_m > 0)) continue;
      points.emplace_back((static_cast<float>(u) - K.cx) * z_m / K.fx,
                          (static_cast<float>(v) - K.cy) * z_m / K.fy, z_m, 1);
      depths_m.push_back(z_m);
    }
  }
  if (points.size() < kFewest) return Eigen::Vector3f::Zero();
  const auto middle = depths_m.begin() + static_cast<std::ptrdiff_t>(depths_m.size() / 2);
  std::ranges::nth_element(depths_m, middle);
  std::erase_if(points, [&](const Eigen::Vector4f& p) { return std::abs(p.z() - *middle) > kDeepest_m; });
  return fitOrientedBox(points).size_m;
}

/// One crop for each label of the image.
void cut(const RgbdFrame& frame, int scene, const Intrinsics& K, const cv::Mat& labels,
         std::vector<Crop>& crops) {
  std::set<int> present;
  cv::Mat1i numbers;
  labels.convertTo(numbers, CV_32S);
  for (const int label : numbers) {
    if (label >= kInstancesOfAThing) present.insert(label);
  }
  for (const int label : present) {
    const cv::Mat mask = numbers == label;
    const cv::Rect box = cv::boundingRect(mask);
    crops.push_back({frame.index,
                     scene,
                     label / kInstancesOfAThing,
                     {frame.color(box).clone(), mask(box).clone(), sizeOf(frame, K, mask)}});
  }
}

/// A name without its last number: "mix_1_top_raw_12" becomes "mix_1_top_raw".
std::string sceneOf(std::string name) {
  while (!name.empty() && std::isdigit(static_cast<unsigned char>(name.back())) != 0) name.pop_back();
  while (!name.empty() && (name.back() == '_' || name.back() == '-')) name.pop_back();
  return name;
}

Result<std::vector<Crop>> readCrops(const fs::path& folder, bool each_image, std::size_t& images) {
  auto pairs = openImagePairs(folder);
  if (!pairs) return fail(pairs.error());
  std::vector<Crop> crops;
  std::map<std::string, int> scenes;
  for (FrameRead read = pairs->frames->next(); read.status != FrameRead::Status::end;
       read = pairs->frames->next()) {
    if (read.status != FrameRead::Status::frame) return fail(read.error);
    const std::string& name = pairs->names[static_cast<std::size_t>(read.frame.index)];
    const int scene =
        scenes.try_emplace(each_image ? name : sceneOf(name), static_cast<int>(scenes.size())).first->second;
    const fs::path file = folder / (name + "-label.png");
    const Result<cv::Mat> labels = readLabelImage(file);
    if (!labels) return fail(labels.error());
    if (labels->size() != read.frame.color.size() || labels->size() != read.frame.depth.size()) {
      return fail(file.string() + " has another size than its colour and depth image.",
                  "Give images of one size.");
    }
    cut(read.frame, scene, pairs->frames->info().intrinsics, *labels, crops);
    ++images;
  }
  return crops;
}

/// A catalogue of random views, and its answers.
class StoredThings {
 public:
  StoredThings(const std::vector<Crop>& crops, Detector detector)
      : crops_(crops), detector_(std::move(detector)) {}

  /// Stores `views` crops of each thing, each from another image, none from `scene`.
  void fill(int views, int scene, std::mt19937& random) {
    std::vector<std::size_t> order(crops_.size());
    std::iota(order.begin(), order.end(), 0U);
    std::ranges::shuffle(order, random);
    std::map<int, std::set<int>> images_of;  // by thing
    for (const std::size_t i : order) {
      const Crop& crop = crops_[i];
      std::set<int>& images = images_of[crop.thing];
      if (crop.scene == scene || std::ssize(images) >= views || images.contains(crop.image)) continue;
      const std::optional<ViewDescriptor> descriptor = detector_.describe(crop.query.color, crop.query.mask);
      if (!descriptor) continue;
      images.insert(crop.image);
      detector_.add({0, idOf(crop.thing), crop.query.size_m, *descriptor, {}});
      show(crop.thing, true);
    }
  }

  [[nodiscard]] bool has(int thing) const { return !!detector_.mergeRootOf(idOf(thing)); }

  RecognitionTrial ask(const Crop& crop) {
    const DetectionMatch match = detector_.find({crop.query}).front();
    show(crop.thing, false);
    const DetectionMatch without = detector_.find({crop.query}).front();
    show(crop.thing, true);
    return {match.nearest == idOf(crop.thing), match.distance, without.distance};
  }

 private:
  static ObjectId idOf(int thing) { return ObjectId{static_cast<std::uint32_t>(thing)}; }
  void show(int thing, bool is_shown) {
    detector_.setMergeRoot({idOf(thing), is_shown ? idOf(thing) : ObjectId{}});
  }

  const std::vector<Crop>& crops_;
  Detector detector_;
};

struct Answers {
  std::vector<RecognitionTrial> all;
  std::map<int, std::vector<RecognitionTrial>> of_thing;
};

/// Asks for the crops of each scene in a catalogue of the other scenes.
Result<void> askAll(const std::vector<Crop>& crops, const RecognitionEvaluation& request,
                    const DetectionParams& params, ComputeContext& compute, std::mt19937& random,
                    Answers& answers) {
  std::map<int, std::vector<const Crop*>> queries;  // by scene
  for (const Crop& crop : crops) queries[crop.scene].push_back(&crop);
  for (const auto& [scene, asked] : queries) {
    Result<Detector> detector = Detector::create(compute, params.model);
    if (!detector) return fail(detector.error());
    detector->setParams(params);
    StoredThings stored(crops, std::move(*detector));
    stored.fill(request.views, scene, random);
    for (const Crop* crop : asked) {
      if (!stored.has(crop->thing)) continue;
      answers.all.push_back(stored.ask(*crop));
      answers.of_thing[crop->thing].push_back(answers.all.back());
    }
  }
  return {};
}

Json toJson(const RecognitionRates& rates, float limit) {
  return {{"limit", limit},
          {"named", rates.named},
          {"wrong", rates.wrong},
          {"unknown_named", rates.unknown_named}};
}

}  // namespace

Result<Json> evaluateRecognition(const RecognitionEvaluation& request) {
  ScanParams params;
  for (const std::string& setting : request.settings) SCANTROVE_TRY(applySetting(params, setting));
  const fs::path folder = request.folder;
  const auto names = readMapping(folder / "label_mapping.csv");
  if (!names) return fail(names.error());
  std::size_t images = 0;
  const Result<std::vector<Crop>> crops = readCrops(folder, request.each_image, images);
  if (!crops) return fail(crops.error());
  const auto compute = ComputeContext::create({.device = request.device});
  if (!compute) return fail(compute.error());

  std::mt19937 random(static_cast<unsigned>(request.seed));
  Answers answers;
  for (int draw = 0; draw < request.draws; ++draw)
    SCANTROVE_TRY(askAll(*crops, request, params.detection, **compute, random, answers));
  if (answers.all.empty()) {
    return fail("No thing in " + request.folder + " is in two scenes.",
                request.each_image ? "Give more images." : "Is each image a scene? Then give --each-image.");
  }
  const float limit = std::min(limitFor(answers.all, kMostFalse), DetectionMatch{}.distance);
  const float set_limit = params.detection.max_distance;
  Json json = {{"images", images},
               {"things", answers.of_thing.size()},
               {"crops", crops->size()},
               {"views", request.views},
               {"queries", answers.all.size()},
               {"nearest_right", nearestRight(answers.all)},
               {"at_1_percent_false", toJson(ratesAt(answers.all, limit), limit)},
               {"at_set_limit", toJson(ratesAt(answers.all, set_limit), set_limit)}};
  for (const auto& [thing, trials] : answers.of_thing) {
    const auto name = names->find(thing);
    json["each"].push_back({{"name", name == names->end() ? std::to_string(thing) : name->second},
                            {"queries", trials.size()},
                            {"nearest_right", nearestRight(trials)},
                            {"named_at_1_percent_false", ratesAt(trials, limit).named}});
  }
  return json;
}

void printRecognition(const Json& result) {
  const auto printRates = [](const char* title, const Json& rates) {
    std::cout << title << " (limit " << rates["limit"].get<double>() << "): " << rates["named"].get<double>()
              << " named rightly, " << rates["wrong"].get<double>() << " wrongly, "
              << rates["unknown_named"].get<double>() << " of the unknown\n";
  };
  std::cout << std::fixed << std::setprecision(3) << result["things"] << " things in " << result["images"]
            << " images, " << result["views"] << " views of each stored, " << result["queries"]
            << " queries from other scenes\n"
            << "nearest right: " << result["nearest_right"].get<double>() << '\n';
  printRates("at most 1 % false names", result["at_1_percent_false"]);
  printRates("as set", result["at_set_limit"]);
  for (const Json& thing : result["each"]) {
    std::cout << "  " << std::left << std::setw(24) << inLine(thing["name"].get<std::string>()) << std::right
              << std::setw(6) << thing["queries"] << " queries, nearest right "
              << thing["nearest_right"].get<double>() << ", named "
              << thing["named_at_1_percent_false"].get<double>() << '\n';
  }
}

}  // namespace scantrove
