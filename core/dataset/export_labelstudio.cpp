#include <spdlog/fmt/fmt.h>

#include <opencv2/core.hpp>
#include <string>
#include <utility>
#include <vector>

#include "core/dataset/brush_rle.h"
#include "core/dataset/category_list.h"
#include "core/dataset/dataset_formats.h"
#include "core/dataset/export_instances.h"
#include "core/dataset/key_frame_images.h"
#include "core/dataset/region_choice.h"

namespace scantrove {
namespace {

// The names that connect results with the labelling interface in label-config.xml.
const std::string kFromName = "label", kToName = "image";

std::string labelConfig(const CategoryList& categories) {
  std::string xml = "<View>\n  <Image name=\"" + kToName + "\" value=\"$image\" zoom=\"true\"/>\n" +
                    "  <BrushLabels name=\"" + kFromName + "\" toName=\"" + kToName + "\">\n";
  for (const DatasetCategory& one : categories.all()) {
    xml +=
        fmt::format("    <Label value=\"{}\" background=\"{}\"/>\n", xmlEscaped(one.name), hexOf(one.color));
  }
  return xml + "  </BrushLabels>\n</View>\n";
}

/// The tasks under construction.
class LabelStudioTasks {
 public:
  explicit LabelStudioTasks(ExportJob& job)
      : job_(job), categories_(job.scans().classes(), job.scans().chosen()) {}

  void beginScan() {
    instances_ = instancesOf(job_.chosen());
    addToLegend(legend_, instanceLegend(instances_), job_.part());
  }

  Result<void> add(const LabeledImage& image) {
    SCANTROVE_TRY(job_.write("images/" + image.image_name, image.image_bytes));
    ExportJson results = ExportJson::array();
    for (const ExportInstance& instance : instances_) {
      const cv::Mat mask = instance.maskIn(image);
      const int pixels = cv::countNonZero(mask);
      if (pixels == 0) continue;
      results.push_back(resultOf(instance, image, mask));
      job_.counts().countMask(instance.class_name, pixels);
    }
    ExportJson annotation = ExportJson::object();
    annotation["result"] = std::move(results);
    // Text, because a list of numbers takes four times the memory as JSON values.
    ExportJson task = {{"data",
                        {{"image", "/data/local-files/?d=images/" + image.image_name},
                         {"scan", validUtf8(job_.part().name)},
                         {"frame", image.frame.index}}},
                       {"annotations", ExportJson::array({annotation})}};
    if (job_.part().split) task["data"]["split"] = splitName(*job_.part().split);
    tasks_ +=
        (tasks_.empty() ? "[\n" : ",\n") + task.dump(-1, ' ', false, ExportJson::error_handler_t::replace);
    return {};
  }

  Result<void> finish() {
    SCANTROVE_TRY(job_.write("tasks.json", tasks_ + "\n]\n"));
    SCANTROVE_TRY(job_.write("label-config.xml", labelConfig(categories_)));
    return job_.write("labels.json", jsonByLines(legend_));
  }

 private:
  [[nodiscard]] ExportJson resultOf(const ExportInstance& instance, const LabeledImage& image,
                                    const cv::Mat& mask) const {
    const std::uint32_t id = job_.part().idOf(instance.id);
    return {{"id", fmt::format("instance-{}-frame-{}", id, image.frame.index)},
            {"type", "brushlabels"},
            {"from_name", kFromName},
            {"to_name", kToName},
            {"original_width", image.K.width},
            {"original_height", image.K.height},
            {"image_rotation", 0},
            {"value",
             {{"format", "rle"},
              {"rle", brushRle(mask)},
              {"brushlabels", ExportJson::array({instance.class_name})}}},
            {"meta", {{"text", ExportJson::array({instance.name})}}}};
  }

  ExportJob& job_;
  CategoryList categories_;
  std::vector<ExportInstance> instances_;
  ExportJson legend_ = ExportJson::object();
  std::string tasks_;
};

}  // namespace

Result<void> exportLabelStudio(ExportJob& job) {
  SCANTROVE_TRY(job.needRegions());
  LabelStudioTasks tasks(job);
  SCANTROVE_TRY(job.forEachScan([&] {
    tasks.beginScan();
    return forEachLabeledImage(job, true, [&](const LabeledImage& image) { return tasks.add(image); });
  }));
  return tasks.finish();
}

}  // namespace scantrove
