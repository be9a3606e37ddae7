#include "core/capture/phones/stray_scanner.h"

#include <algorithm>
#include <map>

#include "core/base/stamped_pose.h"
#include "core/base/text.h"
#include "core/base/text_file.h"
#include "core/capture/camera_intrinsics.h"
#include "core/capture/phones/device_files.h"
#include "core/capture/phones/device_metadata.h"
#include "core/capture/video_frames.h"

namespace scantrove {

namespace {

/// The intrinsics refer to the sensor's images.
constexpr int kStrayWidth = 1920, kStrayHeight = 1440;

/// The fields of a line of a CSV file, without blanks.
std::vector<std::string_view> fieldsOf(std::string_view line) {
  std::vector<std::string_view> fields;
  for (bool is_last = false; !is_last;) {
    const std::size_t comma = line.find(',');
    is_last = comma == std::string_view::npos;
    fields.push_back(trimmed(line.substr(0, comma)));
    line.remove_prefix(is_last ? line.size() : comma + 1);
  }
  return fields;
}

/// A line of odometry.csv by the names of its columns.
class OdometryLine {
 public:
  OdometryLine(const std::map<std::string, std::size_t>& columns, std::string_view line)
      : columns_(columns), fields_(fieldsOf(line)) {}

  [[nodiscard]] std::string_view text(const char* column) const {
    const auto found = columns_.find(column);
    return found == columns_.end() || found->second >= fields_.size() ? std::string_view()
                                                                      : fields_[found->second];
  }
  [[nodiscard]] std::optional<double> number(const char* column) const {
    const auto numbers = parseNumbers(text(column));
    return numbers && numbers->size() == 1 ? std::optional(numbers->front()) : std::nullopt;
  }
  /// Empty if one is missing.
  [[nodiscard]] std::optional<std::vector<double>> numbers(std::initializer_list<const char*> columns) const {
    std::vector<double> all;
    for (const char* const column : columns) {
      const auto value = number(column);
      if (!value) return std::nullopt;
      all.push_back(*value);
    }
    return all;
  }

 private:
  const std::map<std::string, std::size_t>& columns_;
  std::vector<std::string_view> fields_;
};

/// Colour images: of the video, else files in rgb/.
class StrayColor {
 public:
  explicit StrayColor(const std::filesystem::path& folder) : images_(folder / "rgb") {
    if (const auto video = fileIfPresent(folder / "rgb.mp4"); !video.empty())
      video_ = std::make_shared<VideoFrames>(video);
  }
  /// `position`: of the frame's line. `name`: such as "000012".
  void addTo(ImageSequenceEntry& entry, int position, const std::string& name) const {
    if (video_) {
      entry.decode_color = [video = video_, position] { return video->frame(position); };
      return;
    }
    for (const char* const end : {".jpg", ".png"}) {
      if (entry.color.empty()) entry.color = fileIfPresent(images_ / (name + end));
    }
  }

 private:
  std::filesystem::path images_;
  std::shared_ptr<VideoFrames> video_;
};

std::optional<ImageSequenceEntry> strayEntry(const std::filesystem::path& folder, const OdometryLine& line,
                                             const StrayColor& color, int position) {
  const std::string name(line.text("frame"));
  const auto number = parseFrameNumber(name);
  if (!number) return std::nullopt;
  ImageSequenceEntry entry;
  entry.index = *number;
  entry.timestamp_s = line.number("timestamp").value_or(position / kFrameRateHz);
  entry.depth = fileIfPresent(folder / "depth" / (name + ".png"));
  if (entry.depth.empty())
    entry.depth = fileIfPresent(folder / "depth" / (name + ".npy"));  // apps before 2022
  if (entry.depth.empty()) return std::nullopt;
  entry.confidence = fileIfPresent(folder / "confidence" / (name + ".png"));
  color.addTo(entry, position, name);
  if (const auto values = line.numbers({"fx", "fy", "cx", "cy"})) {
    const auto at = [&](std::size_t i) { return static_cast<float>((*values)[i]); };
    entry.intrinsics = Intrinsics{at(0), at(1), at(2), at(3), kStrayWidth, kStrayHeight};
  }
  if (const auto values = line.numbers({"qx", "qy", "qz", "qw", "x", "y", "z"}))
    entry.T_world_camera = poseFromQuaternion(*values);  // the app has turned the axes already
  return entry;
}

}  // namespace

bool isStrayScannerFolder(const std::filesystem::path& folder, const std::vector<std::string>& names) {
  const auto has = [&](const std::string& name) { return std::ranges::binary_search(names, name); };
  return has("odometry.csv") && isFolder(folder / "depth") && (has("rgb.mp4") || has("rgb"));
}

Result<ImageSequence> readStrayScannerFolder(const std::filesystem::path& folder) {
  const std::filesystem::path odometry = folder / "odometry.csv", matrix = folder / "camera_matrix.csv";
  const auto text = readTextFile(odometry);
  if (!text) return fail(text.error());
  const std::vector<std::string_view> lines = splitLines(*text);
  std::map<std::string, std::size_t> columns;
  if (!lines.empty()) {
    const auto header = fieldsOf(lines.front());
    for (std::size_t i = 0; i < header.size(); ++i) columns.emplace(header[i], i);
  }
  if (!columns.contains("frame") || !columns.contains("qw"))
    return fail(
        odometry.string() + " does not start with the names of its columns (timestamp, frame, x, ...).",
        "Record with a version of Stray Scanner from 2022 or later.");
  ImageSequence sequence;
  sequence.kind = "Stray Scanner";
  sequence.folder = folder;
  sequence.has_poses = true;
  sequence.is_color_optional = true;
  sequence.camera_origin = odometry.string();
  const StrayColor color(folder);
  for (std::size_t i = 1; i < lines.size(); ++i) {
    auto entry = strayEntry(folder, OdometryLine(columns, lines[i]), color, static_cast<int>(i) - 1);
    if (entry) sequence.entries.push_back(std::move(*entry));
  }
  if (sequence.entries.empty())
    return fail(folder.string() + ": no line of odometry.csv has a depth image in depth/.",
                "Copy the whole folder of the recording.");
  if (!std::ranges::all_of(sequence.entries,
                           [](const auto& entry) { return entry.intrinsics.has_value(); })) {
    SCANTROVE_TRY(moveInto(sequence.camera, readIntrinsicsMatrix(matrix)));
    sequence.camera.K.width = kStrayWidth;
    sequence.camera.K.height = kStrayHeight;
    sequence.camera_origin = matrix.string();
  }
  return sequence;
}

}  // namespace scantrove
