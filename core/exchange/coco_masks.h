#pragma once
#include <opencv2/core/types.hpp>
#include <string>
#include <variant>
#include <vector>

#include "core/base/result.h"
#include "core/exchange/image_masks.h"

namespace scantrove {

/// The images of a COCO file and the masks of their annotations.
class CocoMasks {
 public:
  /// Reads a COCO file: `images` with id, file_name, width and height; `annotations` with image_id and a
  /// segmentation: run lengths (as text or as numbers) or polygons. Annotations without a segmentation
  /// (boxes, key points) are left out. `name` is the file in messages. Error: no JSON; an entry lacks one of
  /// these or has it wrong; a mask does not fit its image; an image is too large or has over 10,000 masks.
  [[nodiscard]] static Result<CocoMasks> parse(const std::string& text, const std::string& name);

  [[nodiscard]] std::size_t imageCount() const { return images_.size(); }
  /// As in the file, with folders.
  [[nodiscard]] const std::string& fileName(std::size_t image) const { return images_.at(image).file_name; }
  /// Whether the image has annotations with a segmentation.
  [[nodiscard]] bool hasMasks(std::size_t image) const { return !images_.at(image).masks.empty(); }
  /// Masks without a pixel in the image are left out.
  [[nodiscard]] ImageMasks masksOfImage(std::size_t image) const;

 private:
  using Polygon = std::vector<cv::Point2f>;
  using Mask = std::variant<MaskRuns, std::vector<Polygon>>;
  struct Image {
    std::string file_name;
    cv::Size size;
    std::vector<Mask> masks;
  };
  friend class CocoParser;

  std::vector<Image> images_;
};

}  // namespace scantrove
