#include <chrono>
#include <ctime>
#include <opencv2/core.hpp>

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
  explicit CocoInstances(ExportJob& job) : job_(job), list_(job.scan().classes(), job.chosen()) {
    for (const DatasetCategory& one : list_.all())
      categories_.push_back({{"id", one.id}, {"name", one.name}, {"supercategory", one.supercategory}});
  }

  Result<void> add(const LabeledImage& image) {
    SCANTROVE_TRY(job_.write("images/" + image.image_name, image.image_bytes));
    const std::size_t number = images_.size() + 1;
    images_.push_back({{"id", number},
                       {"file_name", image.image_name},
                       {"width", image.K.width},
                       {"height", image.K.height},
                       {"frame", image.frame.index},
                       {"timestamp_s", image.frame.timestamp_s}});
    if (hasLicense()) images_.back()["license"] = kLicenseId;
    for (const LabeledRegion& region : job_.chosen()) {
      const cv::Mat mask = image.maskOf(region.id);
      const cv::Rect box = boxOf(mask);
      if (!box.empty()) annotate(region, number, mask, box);
    }
    return {};
  }

  Result<void> finish() {
    const std::string date = dateNow();
    const ExportJson file = {{"info",
                              {{"description", "Scantrove: " + validUtf8(job_.scan().name())},
                               {"url", ""},
                               {"version", "1.0"},
                               {"year", std::stoi(date.substr(0, 4))},
                               {"contributor", "Scantrove " + programVersion()},
                               {"date_created", date}}},
                             {"licenses", licenses()},
                             {"images", images_},
                             {"annotations", annotations_},
                             {"categories", categories_}};
    return job_.write("annotations/instances.json", jsonText(file, -1));
  }

 private:
  static constexpr int kLicenseId = 1;

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
    job_.countMask(class_name, area);
    annotations_.push_back(
        {{"id", annotations_.size() + 1},
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
  }

  ExportJob& job_;
  CategoryList list_;
  ExportJson images_ = ExportJson::array(), annotations_ = ExportJson::array(),
             categories_ = ExportJson::array();
};

}  // namespace

Result<void> exportCoco(ExportJob& job) {
  SCANTROVE_TRY(job.needRegions());
  CocoInstances instances(job);
  SCANTROVE_TRY(
      forEachLabeledImage(job, true, [&](const LabeledImage& image) { return instances.add(image); }));
  return instances.finish();
}

}  // namespace scantrove
