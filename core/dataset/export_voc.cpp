#include <cstdint>
#include <map>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "core/dataset/category_list.h"
#include "core/dataset/dataset_formats.h"
#include "core/dataset/export_instances.h"
#include "core/dataset/frame_split.h"
#include "core/dataset/key_frame_images.h"
#include "core/dataset/region_choice.h"
#include "core/dataset/silhouette.h"
#include "core/exchange/region_palette.h"
#include "core/image/png_encoder.h"

namespace scantrove {
namespace {

/// 0 is background and 255 "void", the border that VOC leaves undecided.
constexpr std::size_t kMaxNumber = 254;
constexpr int kIgnored = 255;

/// VOC's colours: the bits of an index, spread over the high bits of red, green and blue.
std::vector<Rgb> vocPalette() {
  std::vector<Rgb> palette;
  for (unsigned index = 0; index < 256; ++index) {
    Rgb color{};
    for (unsigned bit = 0; bit < 8; ++bit) {
      const unsigned channel = bit % 3, shift = 7 - bit / 3;
      color[channel] = static_cast<std::uint8_t>(color[channel] | (index >> bit & 1U) << shift);
    }
    palette.push_back(color);
  }
  return palette;
}

std::string element(const std::string& tag, const std::string& content) {
  return "<" + tag + ">" + content + "</" + tag + ">";
}

std::string element(const std::string& tag, int number) { return element(tag, std::to_string(number)); }

std::string attribute(const std::string& name, const std::string& value) {
  return element("attribute", element("name", name) + element("value", xmlEscaped(value)));
}

/// One object. Pixels count from 1, and the box includes its last ones.
std::string objectElement(const ExportInstance& instance, std::uint32_t id, const cv::Rect& box,
                          cv::Size image) {
  const bool is_at_border =
      box.x == 0 || box.y == 0 || box.br().x == image.width || box.br().y == image.height;
  return "\t<object>\n\t\t" + element("name", xmlEscaped(instance.class_name)) + "\n\t\t" +
         element("pose", "Unspecified") + element("truncated", is_at_border ? 1 : 0) +
         element("difficult", 0) + "\n\t\t" +
         element("bndbox", element("xmin", box.x + 1) + element("ymin", box.y + 1) +
                               element("xmax", box.br().x) + element("ymax", box.br().y)) +
         "\n\t\t" +
         element("attributes", attribute("name", instance.name) + attribute("instance", std::to_string(id))) +
         "\n\t</object>\n";
}

/// A label of labelmap.txt, whose fields end with colons.
std::string labelMapName(const std::string& name) {
  std::string safe = onOneLine(name);
  for (char& c : safe) c = c == ':' || c == '#' ? '_' : c;
  return safe;
}

/// The data set under construction.
class VocDataset {
 public:
  explicit VocDataset(ExportJob& job)
      : job_(job), categories_(job.scans().classes(), job.scans().chosen()), palette_(vocPalette()) {}

  Result<void> begin() {
    if (categories_.all().size() > kMaxNumber) {
      return fail(std::to_string(categories_.all().size()) + " classes do not fit into images of 8 bits.",
                  "Export coco instead.");
    }
    return {};
  }

  Result<void> beginScan() {
    instances_ = instancesOf(job_.chosen());
    addToLegend(legend_, instanceLegend(instances_), job_.part());
    return moveInto(split_, splitFrames(job_));
  }

  Result<void> add(const LabeledImage& image) {
    cv::Mat class_numbers = cv::Mat::zeros(image.regions.size(), CV_8UC1);
    cv::Mat object_numbers = class_numbers.clone();
    const DatasetSplit split = split_.of(image.frame.index);
    job_.counts().beginImage(split);
    std::string objects;
    std::size_t count = 0;
    for (const ExportInstance& instance : instances_) {
      const cv::Mat mask = instance.maskIn(image);
      const cv::Rect box = boxOf(mask);
      if (box.empty()) continue;
      if (++count > kMaxNumber)
        return fail("Frame " + std::to_string(image.frame.index) + " shows more than 254 objects.",
                    "Export coco instead.");
      class_numbers.setTo(static_cast<int>(categories_.indexOf(instance)) + 1, mask);
      object_numbers.setTo(static_cast<int>(count), mask);
      objects += objectElement(instance, job_.part().idOf(instance.id), box, mask.size());
      job_.counts().countMask(instance.class_name, cv::countNonZero(mask));
    }
    if (!image.ignored.empty()) {
      for (cv::Mat* numbers : {&class_numbers, &object_numbers}) numbers->setTo(kIgnored, image.ignored);
    }
    lists_[split] += image.stem + "\n";
    return write(image, objects, class_numbers, object_numbers);
  }

  Result<void> finish() {
    for (const char* kind : {"ImageSets/Main/", "ImageSets/Segmentation/"}) {
      const std::string folder = kind;
      const std::string &train = lists_[DatasetSplit::train], &val = lists_[DatasetSplit::val];
      SCANTROVE_TRY(job_.write(folder + "train.txt", train));
      SCANTROVE_TRY(job_.write(folder + "val.txt", val.empty() ? train : val));
      SCANTROVE_TRY(job_.write(folder + "trainval.txt", train + val));
      const std::string& test = lists_[DatasetSplit::test];
      if (!test.empty()) SCANTROVE_TRY(job_.write(folder + "test.txt", test));
    }
    std::string labels = "# label:color_rgb:parts:actions\nbackground:0,0,0::\n";
    for (std::size_t i = 0; i < categories_.all().size(); ++i) {
      const Rgb& rgb = palette_[i + 1];
      labels += labelMapName(categories_.all()[i].name) + ":" + std::to_string(rgb[0]) + "," +
                std::to_string(rgb[1]) + "," + std::to_string(rgb[2]) + "::\n";
    }
    SCANTROVE_TRY(job_.write("labelmap.txt", labels));
    return job_.write("labels.json", jsonByLines(legend_));
  }

 private:
  Result<void> write(const LabeledImage& image, const std::string& objects, const cv::Mat& class_numbers,
                     const cv::Mat& object_numbers) {
    const auto jpeg = asJpeg(image);
    if (!jpeg) return fail(jpeg.error());
    SCANTROVE_TRY(job_.write("JPEGImages/" + image.stem + ".jpg", *jpeg));
    SCANTROVE_TRY(
        job_.write("SegmentationClass/" + image.stem + ".png", encodePalettePng(class_numbers, palette_)));
    SCANTROVE_TRY(
        job_.write("SegmentationObject/" + image.stem + ".png", encodePalettePng(object_numbers, palette_)));
    const std::string xml =
        "<annotation>\n\t" + element("folder", "JPEGImages") + "\n\t" +
        element("filename", image.stem + ".jpg") + "\n\t" +
        element("source", element("database", xmlEscaped("Scantrove: " + job_.scans().title()))) + "\n\t" +
        element("size",
                element("width", image.K.width) + element("height", image.K.height) + element("depth", 3)) +
        "\n\t" + element("segmented", 1) + "\n" + objects + "</annotation>\n";
    return job_.write("Annotations/" + image.stem + ".xml", xml);
  }

  ExportJob& job_;
  CategoryList categories_;
  std::vector<ExportInstance> instances_;
  std::vector<Rgb> palette_;
  FrameSplit split_;
  std::map<DatasetSplit, std::string> lists_;  // names of images
  ExportJson legend_ = ExportJson::object();
};

}  // namespace

Result<void> exportVoc(ExportJob& job) {
  SCANTROVE_TRY(job.needRegions());
  VocDataset dataset(job);
  SCANTROVE_TRY(dataset.begin());
  const auto addScan = [&]() -> Result<void> {
    SCANTROVE_TRY(dataset.beginScan());
    return forEachLabeledImage(job, true, [&](const LabeledImage& image) { return dataset.add(image); });
  };
  SCANTROVE_TRY(job.forEachScan(addScan));
  return dataset.finish();
}

}  // namespace scantrove
