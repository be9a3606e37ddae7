#include "core/exchange/recording_writer.h"

#include <spdlog/fmt/fmt.h>

#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "core/capture/usable_depth.h"
#include "core/exchange/atomic_file.h"
#include "core/image/png_encoder.h"

namespace scantrove {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// The 4 x 4 matrix, row by row, with all digits of a double; fmt ignores the locale.
std::string matrixText(const Eigen::Isometry3d& pose) {
  std::string text;
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) {
      text += fmt::format("{}{}", pose.matrix()(row, column), column < 3 ? ' ' : '\n');
    }
  }
  return text;
}

/// The 3 x 3 matrix, row by row, with all digits of a float.
std::string matrixText(const Intrinsics& K) {
  return fmt::format("{} 0 {}\n0 {} {}\n0 0 1\n", K.fx, K.cx, K.fy, K.cy);
}

Json instancesToJson(const std::vector<InstanceName>& instances) {
  Json all = Json::array();
  for (const InstanceName& instance : instances) {
    Json one{{"id", instance.id}, {"name", instance.name}, {"object", instance.is_object}};
    if (instance.extent_m > 0) one["extent_m"] = instance.extent_m;
    all.push_back(std::move(one));
  }
  return all;
}

Json toJson(const Intrinsics& K) {
  return {{"width", K.width},
          {"height", K.height},
          {"intrinsic_matrix", {K.fx, 0, 0, 0, K.fy, 0, K.cx, K.cy, 1}}};  // column by column
}

Json toJson(const ColorCamera& camera) {
  Json json = toJson(camera.K);
  const Eigen::Matrix4d by_columns = camera.T_color_depth.matrix().transpose();
  json["T_color_depth"] = std::vector<double>(by_columns.data(), by_columns.data() + 16);
  return json;
}

/// Checks that the folder is missing or empty.
Result<void> checkIsFree(const fs::path& folder) {
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored) || fs::is_empty(folder, ignored)) return {};
  return fail("The folder " + folder.string() + " is not empty.", "Give a new folder for the recording.");
}

}  // namespace

Result<RecordingWriter> RecordingWriter::create(const fs::path& folder, const SourceInfo& info) {
  SCANTROVE_TRY(checkIsFree(folder));
  SCANTROVE_TRY(prepareOutputFolder(folder));
  Result<FileLock> lock = FileLock::take(
      folder, {"Another program is writing to the folder " + folder.string() + '.', "Choose another one."});
  if (!lock) return fail(lock.error());
  SCANTROVE_TRY(checkIsFree(folder));  // the previous holder of the lock may have recorded
  RecordingWriter writer(folder, std::move(*lock), info);
  if (!info.instances.empty()) {
    SCANTROVE_TRY(writer.write(folder / "instances.json", instancesToJson(info.instances).dump(1) + '\n'));
  }
  return writer;
}

Result<void> RecordingWriter::add(const RgbdFrame& frame) {
  if (!is_described_) {
    SCANTROVE_TRY(describeCamera(frame));
    is_described_ = true;
  }
  of_frame_.clear();
  Result<void> written = writeParts(frame);
  if (!written) {
    std::error_code ignored;
    for (const fs::path& path : of_frame_) fs::remove(path, ignored);
  }
  return written;
}

Result<void> RecordingWriter::write(const fs::path& path, std::string_view bytes) {
  std::error_code ignored;
  if (fs::exists(fs::symlink_status(path, ignored)))
    return fail("The file " + path.string() + " is there already.", "Give a new folder for the recording.");
  SCANTROVE_TRY(writeFileAtomically(path, bytes, Durability::process));
  of_frame_.push_back(path);
  return {};
}

Result<void> RecordingWriter::describeCamera(const RgbdFrame& frame) {
  Json camera = toJson(info_.intrinsics);
  const double units_per_meter = 1.0 / double{frame.meters_per_unit};
  camera["depth_scale"] = std::round(units_per_meter * 1e3) / 1e3;
  camera["color_registered"] = !frame.color_camera;
  if (info_.is_color_optional) camera["color_optional"] = true;
  if (frame.color_camera) camera["color_camera"] = toJson(*frame.color_camera);
  return write(folder_ / "intrinsic.json", camera.dump(1) + '\n');
}

Result<void> RecordingWriter::writeParts(const RgbdFrame& frame) {
  if (!frame.color.empty()) {
    SCANTROVE_TRY(write(pathOf(frame.index, "color.png"), encodePng(frame.color)));
  }
  if (frame.T_world_camera) {
    SCANTROVE_TRY(write(pathOf(frame.index, "pose.txt"), matrixText(*frame.T_world_camera)));
  }
  if (frame.intrinsics) {
    SCANTROVE_TRY(write(pathOf(frame.index, "intrinsics.txt"), matrixText(*frame.intrinsics)));
  }
  if (!frame.instances.empty()) {
    SCANTROVE_TRY(write(pathOf(frame.index, "instance.png"), encodePng(frame.instances)));
  }
  // Written last: readers ignore a frame without depth image.
  return write(pathOf(frame.index, "depth.png"), encodePng(usableDepth(frame)));
}

fs::path RecordingWriter::pathOf(int index, const char* suffix) const {
  return folder_ / fmt::format("frame-{:06}.{}", index, suffix);
}

}  // namespace scantrove
