#include "core/capture/phones/device_metadata.h"

#include <cmath>

#include "core/capture/pose_files.h"
#include "core/image/image_header.h"

namespace scantrove {

namespace {

/// The device normalises its quaternions; text has rounded them.
constexpr double kQuaternionTolerance = 0.02;

/// Appends the numbers of `value`; false if something in it is no finite number.
bool appendNumbers(const nlohmann::json& value, std::vector<double>& numbers, int levels = 2) {
  if (value.is_number()) {
    numbers.push_back(value.get<double>());
    return std::isfinite(numbers.back());
  }
  if (!value.is_array() || levels == 0) return false;
  for (const nlohmann::json& element : value) {
    if (!appendNumbers(element, numbers, levels - 1)) return false;
  }
  return true;
}

const nlohmann::json* memberOf(const nlohmann::json& object, const char* key) {
  if (!object.is_object()) return nullptr;
  const auto found = object.find(key);
  return found == object.end() ? nullptr : &*found;
}

}  // namespace

std::optional<std::vector<double>> numbersIn(const nlohmann::json& value, std::size_t count) {
  std::vector<double> numbers;
  if (!appendNumbers(value, numbers) || numbers.size() != count) return std::nullopt;
  return numbers;
}

std::optional<std::vector<double>> numbersOf(const nlohmann::json& object, const char* key,
                                             std::size_t count) {
  const nlohmann::json* const value = memberOf(object, key);
  return value == nullptr ? std::nullopt : numbersIn(*value, count);
}

std::optional<double> numberOf(const nlohmann::json& object, const char* key) {
  const nlohmann::json* const value = memberOf(object, key);
  if (value == nullptr || !value->is_number()) return std::nullopt;
  const auto number = value->get<double>();
  return std::isfinite(number) ? std::optional(number) : std::nullopt;
}

std::optional<int> sideOf(const nlohmann::json& object, const char* key) {
  const auto number = numberOf(object, key);
  if (!number || *number < 1 || *number > kLongestImageSide_px) return std::nullopt;
  return static_cast<int>(*number);
}

std::string textOf(const nlohmann::json& object, const char* key) {
  const nlohmann::json* const value = memberOf(object, key);
  return value != nullptr && value->is_string() ? value->get<std::string>() : std::string();
}

std::optional<Eigen::Isometry3d> poseFromRows(std::span<const double> matrix) {
  if (matrix.size() != 16) return std::nullopt;
  return rigidMotion(Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(matrix.data()));
}

std::optional<Eigen::Isometry3d> poseFromQuaternion(std::span<const double> values) {
  if (values.size() != 7) return std::nullopt;
  for (const double value : values) {
    if (!std::isfinite(value)) return std::nullopt;
  }
  const Eigen::Quaterniond rotation(values[3], values[0], values[1], values[2]);
  if (std::abs(rotation.norm() - 1) > kQuaternionTolerance) return std::nullopt;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = rotation.normalized().toRotationMatrix();
  pose.translation() = Eigen::Vector3d(values[4], values[5], values[6]);
  return pose;
}

std::optional<Eigen::Isometry3d> fromArkitAxes(const std::optional<Eigen::Isometry3d>& pose) {
  if (!pose) return std::nullopt;
  Eigen::Isometry3d turned = *pose;
  turned.linear().rightCols<2>() *= -1;  // T * diag(1, -1, -1, 1)
  return turned;
}

Intrinsics intrinsicsFromRows(std::span<const double> matrix, int width, int height) {
  const auto at = [&](std::size_t i) { return i < matrix.size() ? static_cast<float>(matrix[i]) : 0.0F; };
  return {at(0), at(4), at(2), at(5), width, height};
}

Intrinsics intrinsicsFromColumns(std::span<const double> matrix, int width, int height) {
  const auto at = [&](std::size_t i) { return i < matrix.size() ? static_cast<float>(matrix[i]) : 0.0F; };
  return {at(0), at(4), at(6), at(7), width, height};
}

}  // namespace scantrove
