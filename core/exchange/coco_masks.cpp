#include "core/exchange/coco_masks.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>
#include <utility>

#include "core/base/overloaded.h"
#include "core/image/image_header.h"

namespace scantrove {
namespace {

using CocoJson = nlohmann::json;

constexpr std::size_t kMaxMasks = 10'000;

/// The rows from `begin` to before `end` of a column.
struct Rows {
  int begin = 0, end = 0;
};

/// The rows of a column whose pixel centres lie within the polygon. COCO counts from the corner of the first
/// pixel.
void addRows(const std::vector<cv::Point2f>& polygon, int column, int height, std::vector<Rows>& rows) {
  const float x = static_cast<float>(column) + 0.5F;
  std::vector<float> crossings;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const cv::Point2f& from = polygon[i];
    const cv::Point2f& to = polygon[(i + 1) % polygon.size()];
    if ((from.x <= x) != (to.x <= x))
      crossings.push_back(from.y + (x - from.x) / (to.x - from.x) * (to.y - from.y));
  }
  std::ranges::sort(crossings);
  const auto rowOf = [&](float y) { return std::clamp(cvCeil(y - 0.5F), 0, height); };
  for (std::size_t i = 0; i + 1 < crossings.size(); i += 2)
    rows.push_back({rowOf(crossings[i]), rowOf(crossings[i + 1])});
}

/// The mask of polygons, of which each adds its inside.
MaskRuns runsOfPolygons(const std::vector<std::vector<cv::Point2f>>& polygons, const cv::Size& size) {
  RunBuilder builder;
  for (int column = 0; column < size.width; ++column) {
    std::vector<Rows> rows;
    for (const auto& polygon : polygons) addRows(polygon, column, size.height, rows);
    std::ranges::sort(rows, {}, &Rows::begin);
    int next = 0;
    for (const auto& [begin, end] : rows) {
      for (next = std::max(next, begin); next < end; ++next)
        builder.add(static_cast<std::uint32_t>(column * size.height + next));
    }
  }
  return std::move(builder).finish(static_cast<std::uint32_t>(size.area()));
}

bool hasPixels(const MaskRuns& runs) {
  for (std::size_t i = 1; i < runs.size(); i += 2)
    if (runs[i] > 0) return true;
  return false;
}

std::string pixelsOf(std::int64_t width, std::int64_t height) {
  return std::to_string(width) + " x " + std::to_string(height) + " pixels";
}

/// Also of a number like 640.0.
std::int64_t integerOf(const CocoJson& json) {
  constexpr double kExact = 1e15;
  if (json.is_number_float() && std::abs(json.get<double>()) < kExact)
    return static_cast<std::int64_t>(json.get<double>());
  return json.get_ref<const CocoJson::number_integer_t&>();
}

}  // namespace

/// Fills a CocoMasks. Throws nlohmann's exceptions.
class CocoParser {
 public:
  explicit CocoParser(std::string name) : name_(std::move(name)) {}

  Result<CocoMasks> parse(const CocoJson& file) {
    for (const CocoJson& image : file.at("images").get_ref<const CocoJson::array_t&>())
      SCANTROVE_TRY(addImage(image));
    for (const CocoJson& annotation : file.at("annotations").get_ref<const CocoJson::array_t&>())
      SCANTROVE_TRY(addMask(annotation));
    return std::move(masks_);
  }

 private:
  using Image = CocoMasks::Image;

  Result<void> addImage(const CocoJson& json) {
    Image image{json.at("file_name").get<std::string>(), {}, {}};
    const std::string called = image.file_name + " in " + name_;
    const std::int64_t width = integerOf(json.at("width")), height = integerOf(json.at("height"));
    const auto isSide = [](std::int64_t side) { return side > 0 && side <= kLongestImageSide_px; };
    if (!isSide(width) || !isSide(height))
      return fail("The image " + called + " has no possible width and height.",
                  "Sides have 1 to " + std::to_string(kLongestImageSide_px) + " pixels.");
    image.size = {static_cast<int>(width), static_cast<int>(height)};
    SCANTROVE_TRY(
        checkImageSize({static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)}, called));
    if (!places_.emplace(integerOf(json.at("id")), masks_.images_.size()).second)
      return fail("The id of the image " + called + " belongs to another image, too.", "Number the images.");
    masks_.images_.push_back(std::move(image));
    return {};
  }

  Result<void> addMask(const CocoJson& json) {
    const auto found = json.find("segmentation");
    if (found == json.end() || found->is_null() || (found->is_array() && found->empty())) return {};
    const std::int64_t id = integerOf(json.at("image_id"));
    const auto place = places_.find(id);
    if (place == places_.end())
      return fail(
          "An annotation in " + name_ + " is of image " + std::to_string(id) + ", which is not listed.",
          "List every image with its id.");
    Image& image = masks_.images_[place->second];
    if (image.masks.size() == kMaxMasks)
      return fail("The image " + image.file_name + " in " + name_ + " has over " + std::to_string(kMaxMasks) +
                      " masks.",
                  "Leave out small ones.");
    if (found->is_array()) return addPolygons(*found, image);
    return addRuns(*found, image);
  }

  Result<void> addRuns(const CocoJson& json, Image& image) {
    const CocoJson& counts = json.at("counts");
    MaskRuns runs;
    if (counts.is_string()) {
      std::optional<MaskRuns> decoded = decodeRuns(counts.get_ref<const std::string&>());
      if (!decoded) return fail(maskOf(image) + " is no run-length code.", "It is damaged.");
      runs = std::move(*decoded);
    } else {
      for (const CocoJson& count : counts) {
        const std::int64_t run = integerOf(count);
        if (run < 0 || run > std::numeric_limits<std::int32_t>::max())
          return fail(maskOf(image) + " has a run of " + count.dump() + " pixels.", "It is damaged.");
        runs.push_back(static_cast<std::uint32_t>(run));
      }
    }
    const CocoJson& size = json.at("size");
    const std::int64_t height = integerOf(size.at(0)), width = integerOf(size.at(1));
    if (width != image.size.width || height != image.size.height)
      return fail(maskOf(image) + " has " + pixelsOf(width, height) + ", the image " +
                      pixelsOf(image.size.width, image.size.height) + ".",
                  "Write masks at the size of their image; \"size\" is [height, width].");
    const std::uint64_t pixels = std::accumulate(runs.begin(), runs.end(), std::uint64_t{0});
    if (pixels != static_cast<std::uint64_t>(image.size.area()))
      return fail(maskOf(image) + " covers " + std::to_string(pixels) + " pixels, the image has " +
                      std::to_string(image.size.area()) + ".",
                  "The mask is damaged.");
    image.masks.emplace_back(std::move(runs));
    return {};
  }

  Result<void> addPolygons(const CocoJson& json, Image& image) {
    std::vector<std::vector<cv::Point2f>> polygons;
    for (const CocoJson& numbers : json) {
      const bool is_polygon = numbers.is_array() && numbers.size() >= 6 && numbers.size() % 2 == 0;
      if (!is_polygon)
        return fail(maskOf(image) + " has a polygon without three corners.", "Write x and y of each corner.");
      // Corners far outside would overflow; those beside the image have the same effect.
      const auto coordinate = [&](std::size_t place, int side) {
        return static_cast<float>(std::clamp(numbers.at(place).get<double>(), -1.0, side + 1.0));
      };
      std::vector<cv::Point2f>& polygon = polygons.emplace_back();
      for (std::size_t i = 0; i + 1 < numbers.size(); i += 2)
        polygon.emplace_back(coordinate(i, image.size.width), coordinate(i + 1, image.size.height));
    }
    image.masks.emplace_back(std::move(polygons));
    return {};
  }

  [[nodiscard]] std::string maskOf(const Image& image) const {
    return "A mask of " + image.file_name + " in " + name_;
  }

  std::string name_;
  CocoMasks masks_;
  std::map<std::int64_t, std::size_t> places_;  // of images, by id
};

Result<CocoMasks> CocoMasks::parse(const std::string& text, const std::string& name) {
  try {
    return CocoParser(name).parse(CocoJson::parse(text));
  } catch (const CocoJson::exception& exception) {
    return fail(name + " is not a COCO file: " + exception.what() + ".",
                "It lists images and annotations with segmentations.");
  }
}

ImageMasks CocoMasks::masksOfImage(std::size_t number) const {
  const Image& image = images_.at(number);
  ImageMasks result{image.size, {}};
  for (const Mask& mask : image.masks) {
    MaskRuns runs = std::visit(Overloaded{[](const MaskRuns& given) { return given; },
                                          [&](const std::vector<Polygon>& polygons) {
                                            return runsOfPolygons(polygons, image.size);
                                          }},
                               mask);
    if (hasPixels(runs)) result.masks.push_back(std::move(runs));
  }
  return result;
}

}  // namespace scantrove
