#include <algorithm>
#include <chrono>
#include <cstdint>
#include <ctime>
#include <map>
#include <opencv2/core.hpp>
#include <string>

#include "core/dataset/category_list.h"
#include "core/dataset/dataset_formats.h"
#include "core/dataset/dataset_readme.h"
#include "core/dataset/key_frame_images.h"
#include "core/dataset/region_choice.h"
#include "core/dataset/silhouette.h"
#include "core/exchange/coco_rle.h"

namespace scantrove {
namespace {

std::string dateNow() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm utc{};
  gmtime_r(&now, &utc);
  char text[32];
  return {text, std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc)};
}

/// The file under construction.
class CocoInstances {
 public:
  explicit CocoInstances(ExportJob& job) : job_(job), list_(job.scans().classes(), job.scans().chosen()) {
    for (const DatasetCategory& one : list_.all())
      categories_.push_back({{"id", one.id}, {"name", one.name}, {"supercategory", one.supercategory}});
    if (job.options().choices.unlabeled == UnlabeledObjects::ignore) addIgnoredCategory();
    for (const DatasetPart& part : job.scans().parts()) files_[fileOf(part)];
  }

  Result<void> add(const LabeledImage& image) {
    SCANTROVE_TRY(job_.write("images/" + image.image_name, image.image_bytes));
    const std::size_t number = ++image_count_;
    ExportJson& images = files_.at(fileOf(job_.part())).images;
    images.push_back({{"id", number},
                      {"file_name", image.image_name},
                      {"width", image.K.width},
                      {"height", image.K.height},
                      {"frame", image.frame.index},
                      {"timestamp_s", image.frame.timestamp_s}});
    if (job_.scans().isProject()) images.back()["scan"] = validUtf8(job_.part().name);
    if (hasLicense()) images.back()["license"] = kLicenseId;
    for (const LabeledRegion& region : job_.chosen()) {
      const cv::Mat mask = image.maskOf(region.id);
      const cv::Rect box = boxOf(mask);
      if (!box.empty()) annotate(region, number, mask, box);
    }
    if (!image.ignored.empty() && cv::countNonZero(image.ignored) > 0) annotateIgnored(number, image.ignored);
    return {};
  }

  Result<void> finish() {
    for (const auto& [name, content] : files_) SCANTROVE_TRY(write(name, content));
    return {};
  }

 private:
  static constexpr int kLicenseId = 1;

  /// The lists of one file; ids are unique over all files.
  struct File {
    ExportJson images = ExportJson::array(), annotations = ExportJson::array();
  };

  /// One file, or one for each split.
  static std::string fileOf(const DatasetPart& part) {
    return "annotations/instances" + (part.split ? "_" + splitName(*part.split) : "") + ".json";
  }

  Result<void> write(const std::string& name, const File& content) {
    const std::string date = dateNow();
    const ExportJson file = {{"info",
                              {{"description", "Scantrove: " + validUtf8(job_.scans().title())},
                               {"url", ""},
                               {"version", "1.0"},
                               {"year", std::stoi(date.substr(0, 4))},
                               {"contributor", "Scantrove " + programVersion()},
                               {"date_created", date}}},
                             {"licenses", licenses()},
                             {"images", content.images},
                             {"annotations", content.annotations},
                             {"categories", categories_}};
    return job_.write(name, jsonText(file, -1));
  }

  /// The largest id of COCO files, so that it never changes; no class of the catalogue uses it in practice.
  void addIgnoredCategory() {
    const auto isTaken = [&](const auto& matches) { return std::ranges::any_of(list_.all(), matches); };
    std::string name = "unlabelled";
    while (isTaken([&](const DatasetCategory& one) { return one.name == name; })) name += "_";
    while (isTaken([&](const DatasetCategory& one) { return one.id == ignored_id_; })) --ignored_id_;
    categories_.push_back({{"id", ignored_id_}, {"name", name}, {"supercategory", "ignore"}});
  }

  [[nodiscard]] bool hasLicense() const { return !licenseName(job_.options().license).empty(); }

  [[nodiscard]] ExportJson licenses() const {
    if (!hasLicense()) return ExportJson::array();
    ExportJson license = ExportJson::object();
    license["id"] = kLicenseId;
    license["name"] = licenseName(job_.options().license);
    license["url"] = licenseUrl(job_.options().license);
    return ExportJson::array({license});
  }

  void annotate(const LabeledRegion& region, std::size_t image, const cv::Mat& mask, const cv::Rect& box) {
    const std::string class_name = classOf(region);
    const int area = cv::countNonZero(mask);
    job_.counts().countMask(class_name, area);
    ExportJson& annotations = files_.at(fileOf(job_.part())).annotations;
    annotations.push_back(
        {{"id", ++annotation_count_},
         {"image_id", image},
         {"category_id", list_.idOf(region)},
         {"segmentation", {{"size", {mask.rows, mask.cols}}, {"counts", encodeRuns(runsOf(mask))}}},
         {"area", area},
         {"bbox", {box.x, box.y, box.width, box.height}},
         {"iscrowd", 0},
         {"attributes",
          {{"region", region.id},
           {"object", region.object ? ExportJson(*region.object) : ExportJson(nullptr)},
           {"name", displayName(region)}}}});
    if (job_.scans().isProject()) annotations.back()["attributes"]["scan"] = validUtf8(job_.part().name);
  }

  /// All unlabelled objects of an image as one crowd, which evaluations ignore and trainers leave out.
  void annotateIgnored(std::size_t image, const cv::Mat& mask) {
    const cv::Rect box = boxOf(mask);
    files_.at(fileOf(job_.part()))
        .annotations.push_back(
            {{"id", ++annotation_count_},
             {"image_id", image},
             {"category_id", ignored_id_},
             {"segmentation", {{"size", {mask.rows, mask.cols}}, {"counts", encodeRuns(runsOf(mask))}}},
             {"area", cv::countNonZero(mask)},
             {"bbox", {box.x, box.y, box.width, box.height}},
             {"iscrowd", 1}});
  }

  ExportJob& job_;
  CategoryList list_;
  ExportJson categories_ = ExportJson::array();
  std::map<std::string, File> files_;
  std::size_t image_count_ = 0, annotation_count_ = 0;
  std::uint32_t ignored_id_ = kLargestClassId;
};

}  // namespace

Result<void> exportCoco(ExportJob& job) {
  SCANTROVE_TRY(job.needRegions());
  CocoInstances instances(job);
  const auto add = [&](const LabeledImage& image) { return instances.add(image); };
  SCANTROVE_TRY(job.forEachScan([&] { return forEachLabeledImage(job, true, add); }));
  return instances.finish();
}

}  // namespace scantrove
