#include "core/capture/rig_info.h"

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/text.h"
#include "core/base/text_file.h"
#include "core/capture/rig_cameras.h"
#include "core/image/image_header.h"

namespace scantrove {
namespace {

using RigLines = std::map<std::string, std::vector<double>, std::less<>>;

/// Lines with numbers; others, such as the sensor's name, are left out.
RigLines rigLines(std::string_view text) {
  RigLines lines;
  for (const std::string_view line : splitLines(text)) {
    const std::size_t equals = line.find('=');
    if (equals == std::string_view::npos) continue;
    auto values = parseNumbers(line.substr(equals + 1));
    if (values) lines.emplace(trimmed(line.substr(0, equals)), std::move(*values));
  }
  return lines;
}

class RigInfo {
 public:
  RigInfo(RigLines lines, const std::filesystem::path& file) : lines_(std::move(lines)), file_(file) {}

  /// `which`: "Depth" or "Color"; `size_prefix`: "m_depth" or "m_color".
  [[nodiscard]] Result<RigCamera> camera(const std::string& which, const std::string& size_prefix) const {
    RigCamera camera;
    SCANTROVE_TRY(readSide(camera.width, size_prefix + "Width"));
    SCANTROVE_TRY(readSide(camera.height, size_prefix + "Height"));
    const std::string projection = "m_calibration" + which + "Intrinsic";
    const auto matrix = matrixOf(projection);
    if (!matrix) return fail(file_.string() + ": " + projection + " is no matrix of 4 columns.", kRigAdvice);
    camera.projection = *matrix;
    // 3RScan has no places: both cameras are at one.
    camera.T_rig_camera =
        matrixOf("m_calibration" + which + "Extrinsic").value_or(Eigen::Matrix4d::Identity());
    return camera;
  }
  [[nodiscard]] std::optional<double> number(const std::string& name) const {
    const auto found = lines_.find(name);
    if (found == lines_.end() || found->second.size() != 1) return std::nullopt;
    return found->second.front();
  }

 private:
  static constexpr const char* kRigAdvice = "Correct it, or give --intrinsics fx,fy,cx,cy.";

  [[nodiscard]] Result<void> readSide(int& side, const std::string& name) const {
    const double value = number(name).value_or(0);
    if (!(value >= 1 && value <= kLongestImageSide_px))
      return fail(file_.string() + " has no " + name + " from 1 to 8192.", kRigAdvice);
    side = static_cast<int>(value);
    return {};
  }
  /// Three or four rows of four columns.
  [[nodiscard]] std::optional<Eigen::Matrix4d> matrixOf(const std::string& name) const {
    const auto found = lines_.find(name);
    if (found == lines_.end()) return std::nullopt;
    const std::vector<double>& values = found->second;
    if (values.size() != 12 && values.size() != 16) return std::nullopt;
    Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
    for (std::size_t i = 0; i < values.size(); ++i)
      matrix(static_cast<int>(i / 4), static_cast<int>(i % 4)) = values[i];
    return matrix;
  }

  RigLines lines_;
  const std::filesystem::path& file_;
};

}  // namespace

Result<CameraModel> readRigInfo(const std::filesystem::path& file) {
  const auto text = readTextFile(file);
  if (!text) return fail(text.error());
  const RigInfo info(rigLines(*text), file);
  RigCamera depth, color;
  SCANTROVE_TRY(moveInto(depth, info.camera("Depth", "m_depth")));
  SCANTROVE_TRY(moveInto(color, info.camera("Color", "m_color")));
  CameraModel model = rigModel(depth, color);
  model.units_per_meter = info.number("m_depthShift");
  return model;
}

std::optional<std::filesystem::path> findRigInfo(const std::filesystem::path& folder) {
  for (const char* const name : {"info.txt", "_info.txt"}) {
    const std::filesystem::path file = folder / name;
    const auto text = readTextFile(file);
    if (text && text->find("m_calibrationDepthIntrinsic") != std::string::npos) return file;
  }
  return std::nullopt;
}

}  // namespace scantrove
