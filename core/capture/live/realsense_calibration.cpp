#include "core/capture/live/realsense_calibration.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/checksum.h"
#include "core/capture/camera_intrinsics.h"
#include "core/capture/containers/byte_cursor.h"

namespace scantrove {

namespace {

constexpr std::uint16_t kMonitorMagic = 0xcdab;
constexpr std::uint32_t kGetTable = 0x15;
constexpr std::uint16_t kMonitorCommandBytes = 20;  // the operation and four parameters
constexpr std::size_t kAnswerSizeOffset = 1020;
constexpr std::size_t kAnswerHeaderBytes = 4;  // the operation again

constexpr std::size_t kTableHeaderBytes = 16;  // version, type, size, parameter, checksum of the rest
constexpr std::size_t kTableChecksumOffset = 12;
constexpr std::size_t kDepthParamsOffset = 256;  // fx, fy, cx, cy for each of the sizes below
constexpr std::size_t kColorLensOffset = 52, kColorSizeOffset = 144, kColorRotationOffset = 184;
constexpr std::size_t kColorTableBytes = 232;  // up to the end of the translation

/// The order of sizes in the table of depth; further entries belong to other models.
constexpr std::array<std::array<int, 2>, 10> kRectifiedSizes{{{1920, 1080},
                                                              {1280, 720},
                                                              {640, 480},
                                                              {848, 480},
                                                              {640, 360},
                                                              {424, 240},
                                                              {320, 240},
                                                              {480, 270},
                                                              {1280, 800},
                                                              {960, 540}}};

constexpr std::uint16_t kD405 = 0x0b5b;
constexpr double kFarthestColor_m = 0.2;  // within one housing
constexpr double kPlaceTolerance = 1e-2;

Result<void> checkTable(std::span<const std::uint8_t> table, std::size_t least_bytes) {
  if (table.size() < least_bytes)
    return fail("The calibration table has only " + std::to_string(table.size()) + " bytes.");
  ByteCursor header(table.subspan(kTableChecksumOffset));
  const auto checksum = header.get<std::uint32_t>();
  const auto content = table.subspan(kTableHeaderBytes);
  if (crc32Of({reinterpret_cast<const char*>(content.data()), content.size()}) != checksum)
    return fail("The calibration table is damaged (checksum).");
  return {};
}

template <std::size_t Count>
std::array<float, Count> floatsAt(std::span<const std::uint8_t> table, std::size_t offset) {
  ByteCursor cursor(table.subspan(offset));
  std::array<float, Count> values{};
  for (float& value : values) value = cursor.get<float>();
  return values;
}

/// A camera whose pixels -1 to 1 span the image in both directions.
struct NormalizedCamera {
  float fx, fy, cx, cy;

  [[nodiscard]] Intrinsics inPixels(const cv::Size& size) const {
    const auto w = static_cast<float>(size.width), h = static_cast<float>(size.height);
    return {fx * w / 2, fy * h / 2, (cx + 1) * w / 2, (cy + 1) * h / 2, size.width, size.height};
  }
};

/// The image scaled to cover `size`, cropped to it around the middle.
Intrinsics coveringCrop(const Intrinsics& K, const cv::Size& size) {
  const auto w = static_cast<float>(size.width), h = static_cast<float>(size.height);
  const float scale = std::max(w / static_cast<float>(K.width), h / static_cast<float>(K.height));
  const float left = (static_cast<float>(K.width) * scale - w) / 2;
  const float top = (static_cast<float>(K.height) * scale - h) / 2;
  return {K.fx * scale, K.fy * scale, K.cx * scale - left, K.cy * scale - top, size.width, size.height};
}

/// The sensor is cropped to the image's shape from that in which it was calibrated.
Intrinsics colorIntrinsics(NormalizedCamera camera, const cv::Size& calibrated, const cv::Size& size) {
  const float shape = static_cast<float>(size.height) / static_cast<float>(size.width);
  const float calibrated_shape = static_cast<float>(calibrated.height) / static_cast<float>(calibrated.width);
  if (shape < calibrated_shape) {
    camera.fy *= calibrated_shape / shape;
    camera.cy *= calibrated_shape / shape;
  } else {
    camera.fx *= shape / calibrated_shape;
    camera.cx *= shape / calibrated_shape;
  }
  return camera.inPixels(size);
}

/// A D405 makes 640x480 from its whole sensor of 1280x800, by way of 770x480.
Intrinsics d405ColorIntrinsics(NormalizedCamera camera, const cv::Size& calibrated, const cv::Size& size) {
  if (size == cv::Size(1280, 720)) return camera.inPixels(size);
  if (size != cv::Size(640, 480)) return coveringCrop(camera.inPixels(calibrated), size);
  const cv::Size sensor(1280, 800), scaled(770, 480);
  const float part = static_cast<float>(calibrated.height) / static_cast<float>(sensor.height);
  camera.fy *= part;
  camera.cy *= part;
  Intrinsics K = coveringCrop(camera.inPixels(sensor), scaled);
  K.cx -= static_cast<float>((scaled.width - size.width) / 2);
  K.width = size.width;
  return K;
}

}  // namespace

std::vector<std::uint8_t> realsenseTableCommand(RealsenseTable table) {
  std::vector<std::uint8_t> command;
  const auto add = [&](std::uint32_t value, int bytes) {
    for (int i = 0; i < bytes; ++i) command.push_back(static_cast<std::uint8_t>(value >> 8 * i));
  };
  add(kMonitorCommandBytes, 2);
  add(kMonitorMagic, 2);
  add(kGetTable, 4);
  add(static_cast<std::uint32_t>(table), 4);
  command.resize(kRealsenseControlBytes, 0);
  return command;
}

Result<std::vector<std::uint8_t>> realsenseTableIn(std::span<const std::uint8_t> answer) {
  if (answer.size() != kRealsenseControlBytes) return fail("The answer has another size.");
  ByteCursor start(answer), end(answer.subspan(kAnswerSizeOffset));
  const auto operation = start.get<std::uint32_t>();
  const auto bytes = end.get<std::uint32_t>();
  if (operation != kGetTable)
    return fail("The device refuses (" + std::to_string(static_cast<std::int32_t>(operation)) + ").");
  if (bytes > kAnswerSizeOffset - kAnswerHeaderBytes)
    return fail("The answer has an impossible size: " + std::to_string(bytes) + " bytes.");
  const auto table = answer.subspan(kAnswerHeaderBytes, bytes);
  return std::vector<std::uint8_t>(table.begin(), table.end());
}

Result<Intrinsics> realsenseDepthIntrinsics(std::span<const std::uint8_t> table, const cv::Size& size) {
  constexpr std::size_t kEntryBytes = 4 * sizeof(float);
  SCANTROVE_TRY(checkTable(table, kDepthParamsOffset + kRectifiedSizes.size() * kEntryBytes));
  const auto* const entry = std::ranges::find(kRectifiedSizes, std::array{size.width, size.height});
  if (entry == kRectifiedSizes.end())
    return fail("The calibration table is without images of " + std::to_string(size.width) + "x" +
                std::to_string(size.height) + ".");
  const auto index = static_cast<std::size_t>(entry - kRectifiedSizes.begin());
  const auto values = floatsAt<4>(table, kDepthParamsOffset + index * kEntryBytes);
  const Intrinsics K{values[0], values[1], values[2], values[3], size.width, size.height};
  SCANTROVE_TRY(checkIntrinsics(K, "the calibration table"));
  return K;
}

Result<RealsenseColor> realsenseColorCamera(std::span<const std::uint8_t> table, const cv::Size& size,
                                            bool is_d405) {
  SCANTROVE_TRY(checkTable(table, kColorTableBytes));
  const auto matrix = floatsAt<9>(table, kTableHeaderBytes);
  const NormalizedCamera camera{matrix[0], matrix[4], matrix[2], matrix[5]};
  ByteCursor sides(table.subspan(kColorSizeOffset));
  cv::Size calibrated;
  calibrated.width = sides.get<std::uint16_t>();
  calibrated.height = sides.get<std::uint16_t>();
  if (calibrated.area() == 0) calibrated = {1920, 1080};
  RealsenseColor color;
  color.camera.K =
      is_d405 ? d405ColorIntrinsics(camera, calibrated, size) : colorIntrinsics(camera, calibrated, size);
  SCANTROVE_TRY(checkIntrinsics(color.camera.K, "the calibration table of the colour camera"));

  const auto lens = floatsAt<5>(table, kColorLensOffset);
  if (!std::ranges::all_of(lens, [](float value) { return std::isfinite(value); }))
    return fail("The colour camera's lens is impossible.");
  color.lens = {
      .k1 = lens[0], .k2 = lens[1], .p1 = lens[2], .p2 = lens[3], .k3 = lens[4], .is_inverse = true};

  // From colour to depth: the rotation column by column, then the translation in mm with the other sign.
  const auto place = floatsAt<12>(table, kColorRotationOffset);
  const Eigen::Matrix3d rotation = Eigen::Map<const Eigen::Matrix3f>(place.data()).cast<double>();
  const Eigen::Vector3d translation_m =
      -1e-3 * Eigen::Map<const Eigen::Vector3f>(place.data() + 9).cast<double>();
  const double skew = (rotation.transpose() * rotation - Eigen::Matrix3d::Identity()).norm();
  if (!(skew < kPlaceTolerance) || !(translation_m.norm() < kFarthestColor_m) || rotation.determinant() < 0)
    return fail("The colour camera's place beside the depth camera is impossible.");
  Eigen::Isometry3d T_depth_color = Eigen::Isometry3d::Identity();
  T_depth_color.linear() = Eigen::Quaterniond(rotation).normalized().toRotationMatrix();
  T_depth_color.translation() = translation_m;
  color.camera.T_color_depth = T_depth_color.inverse();
  return color;
}

Intrinsics nominalRealsenseIntrinsics(std::uint16_t product, const cv::Size& size) {
  // D400, D410 and D415 have narrow lenses, the other models wide ones, whose images of 640x480 show more.
  constexpr std::array<std::uint16_t, 3> kNarrow{0x0ad1, 0x0ad2, 0x0ad3};
  const bool is_narrow = std::ranges::find(kNarrow, product) != kNarrow.end();
  const bool is_vga = size.width * 3 == size.height * 4;
  const float focal_480 = is_narrow ? 615.0F : is_vga ? 385.0F : 425.0F;  // pixels of images 480 high
  const float f = focal_480 * static_cast<float>(size.height) / 480;
  return {
      f,          f,          static_cast<float>(size.width - 1) / 2, static_cast<float>(size.height - 1) / 2,
      size.width, size.height};
}

bool isRealsenseD405(std::uint16_t product) { return product == kD405; }

}  // namespace scantrove
