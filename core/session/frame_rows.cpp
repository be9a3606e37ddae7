#include "core/session/frame_rows.h"

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <tuple>
#include <utility>

#include "core/session/row_checks.h"
#include "core/session/table_reading.h"

namespace scantrove::rows {
namespace {

using ColorJson = nlohmann::ordered_json;

/// Size and, for a separate colour camera, its calibration.
std::string colorToJson(const SavedKeyFrame& key) {
  ColorJson json{{"size", {key.color_width, key.color_height}}};
  if (!key.color_camera) return json.dump();
  ColorJson T = ColorJson::array();
  for (int i = 0; i < 12; ++i) T.push_back(key.color_camera->T_color_depth.matrix()(i / 4, i % 4));
  const Intrinsics& K = key.color_camera->K;
  json["K"] = {K.fx, K.fy, K.cx, K.cy};
  json["K_size"] = {K.width, K.height};
  json["T_color_depth"] = T;
  return json.dump();
}

/// False: malformed.
bool readColor(const std::string& written, SavedKeyFrame& key) {
  try {
    const ColorJson json = ColorJson::parse(written);
    const auto sizeOf = [&](const char* name) {
      return std::pair(json.at(name).at(0).get<int>(), json.at(name).at(1).get<int>());
    };
    std::tie(key.color_width, key.color_height) = sizeOf("size");
    if (!json.contains("K")) return true;
    const auto [width, height] = sizeOf("K_size");
    const auto number = [&](std::size_t i) { return json.at("K").at(i).get<float>(); };
    ColorCamera camera;
    camera.K = {number(0), number(1), number(2), number(3), width, height};
    for (int i = 0; i < 12; ++i)
      camera.T_color_depth.matrix()(i / 4, i % 4) =
          json.at("T_color_depth").at(static_cast<std::size_t>(i)).get<double>();
    key.color_camera = camera;
    return true;
  } catch (const ColorJson::exception&) {
    return false;
  }
}

constexpr std::array kStates{TrackingState::tracking, TrackingState::uncertain, TrackingState::lost,
                             TrackingState::relocalized};

std::optional<TrackingState> stateFrom(const std::string& word) {
  for (const TrackingState state : kStates) {
    if (word == toString(state)) return state;
  }
  return std::nullopt;
}

QVariant checksumOrNull(const std::optional<std::uint32_t>& checksum) {
  return checksum ? QVariant(*checksum) : QVariant();
}

QVariant numberOrNull(const std::optional<Intrinsics>& K, float Intrinsics::*number) {
  return K ? QVariant(static_cast<double>((*K).*number)) : QVariant();
}

QVariant sideOrNull(const std::optional<Intrinsics>& K, int Intrinsics::*side) {
  return K ? QVariant((*K).*side) : QVariant();
}

/// The frame's own camera, or none if the columns are empty. False: neither.
bool readIntrinsics(const QSqlQuery& row, int first_column, std::optional<Intrinsics>& K) {
  constexpr int kColumns = 6;
  int empty = 0, numbers = 0;
  for (int i = 0; i < kColumns; ++i) empty += row.value(first_column + i).isNull() ? 1 : 0;
  if (empty == kColumns) return true;
  const auto number = [&](int i) {
    bool is_number = false;
    const float value = row.value(first_column + i).toFloat(&is_number);
    numbers += is_number ? 1 : 0;
    return value;
  };
  const auto side = [&](int i) {
    return static_cast<int>(integerAt(row, first_column + i, kCounts).value_or(0));
  };
  K = Intrinsics{number(0), number(1), number(2), number(3), side(4), side(5)};
  return numbers == 4 && isPlausible(*K);
}

std::optional<SavedFrame> frameFrom(const QSqlQuery& row) {
  const auto pose = poseAt(row, 4);
  const auto state = stateFrom(text(row, 3));
  SavedFrame frame;
  frame.time_s = row.value(2).toDouble();
  if (!pose || !state || !areIntegers(row, 0, 1, kCounts) || !std::isfinite(frame.time_s) ||
      !readIntrinsics(row, 11, frame.intrinsics))
    return std::nullopt;
  frame.number = row.value(0).toInt();
  frame.source_index = row.value(1).toInt();
  frame.state = *state;
  frame.T_world_camera = *pose;
  return frame;
}

/// None: the image is of an earlier version.
std::optional<std::uint32_t> checksumAt(const QSqlQuery& row, const char* column) {
  const QVariant value = row.value(QLatin1String(column));
  return value.isNull() ? std::nullopt : std::optional(static_cast<std::uint32_t>(value.toLongLong()));
}

std::optional<SavedKeyFrame> keyFrameFrom(const QSqlQuery& row) {
  SavedKeyFrame key;
  key.frame = row.value(0).toInt();
  key.color_file = text(row, 1);
  key.depth_file = text(row, 2);
  key.meters_per_unit = row.value(3).toFloat();
  key.color_checksum = checksumAt(row, "color_checksum");
  key.depth_checksum = checksumAt(row, "depth_checksum");
  if (!integerAt(row, 0, kCounts) || !readColor(text(row, 4), key) || !isPlausible(key)) return std::nullopt;
  return key;
}

}  // namespace

Result<void> writeFrames(DatabaseConnection& database, const SavedDelta& delta) {
  for (const SavedFrame& frame : delta.frames) {
    const Eigen::Vector3d t = frame.T_world_camera.translation();
    const Eigen::Quaterniond q(frame.T_world_camera.linear());
    SCANTROVE_TRY(put(database, "frames",
                      {{"number", frame.number},
                       {"source_index", frame.source_index},
                       {"time_s", frame.time_s},
                       {"state", QString(toString(frame.state))},
                       {"tx", t.x()},
                       {"ty", t.y()},
                       {"tz", t.z()},
                       {"qx", q.x()},
                       {"qy", q.y()},
                       {"qz", q.z()},
                       {"qw", q.w()},
                       {"fx", numberOrNull(frame.intrinsics, &Intrinsics::fx)},
                       {"fy", numberOrNull(frame.intrinsics, &Intrinsics::fy)},
                       {"cx", numberOrNull(frame.intrinsics, &Intrinsics::cx)},
                       {"cy", numberOrNull(frame.intrinsics, &Intrinsics::cy)},
                       {"width", sideOrNull(frame.intrinsics, &Intrinsics::width)},
                       {"height", sideOrNull(frame.intrinsics, &Intrinsics::height)}}));
  }
  if (!delta.frames.empty()) SCANTROVE_TRY(seal(database, "frames"));
  for (const SavedKeyFrame& key : delta.key_frames) {
    SCANTROVE_TRY(put(database, "key_frames",
                      {{"number", key.frame},
                       {"color_file", text(key.color_file.generic_string())},
                       {"depth_file", text(key.depth_file.generic_string())},
                       {"metres_per_unit", static_cast<double>(key.meters_per_unit)},
                       {"color", text(colorToJson(key))},
                       {"color_checksum", checksumOrNull(key.color_checksum)},
                       {"depth_checksum", checksumOrNull(key.depth_checksum)}}));
  }
  return delta.key_frames.empty() ? Result<void>() : seal(database, "key_frames");
}

Result<void> readFrames(DatabaseConnection& database, SavedScan& scan, std::vector<std::string>& damages) {
  SCANTROVE_TRY(readTable(database,
                          {"frames",
                           "SELECT number, source_index, time_s, state, tx, ty, tz, qx, qy, qz, qw,"
                           " fx, fy, cx, cy, width, height, row_check FROM frames ORDER BY number",
                           "frames"},
                          damages, scan.frames, frameFrom));
  return readTable(database, {"key_frames", "SELECT * FROM key_frames ORDER BY number", "key frames"},
                   damages, scan.key_frames, keyFrameFrom);
}

}  // namespace scantrove::rows
