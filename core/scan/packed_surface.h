#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace scantrove {

/// Red, green, blue, a byte each. Black means "not seen in colour", so real black is stored as nearly
/// black.
struct PackedColor {
  std::array<std::uint8_t, 3> rgb{};

  [[nodiscard]] static PackedColor of(std::uint8_t red, std::uint8_t green, std::uint8_t blue) {
    const bool black = red == 0 && green == 0 && blue == 0;
    return {{black ? std::uint8_t{1} : red, green, blue}};
  }
  [[nodiscard]] bool known() const { return rgb != std::array<std::uint8_t, 3>{}; }
  bool operator==(const PackedColor&) const = default;
};

/// A direction in two bytes, accurate to about a degree: octahedral encoding. 0, 0: none.
struct PackedNormal {
  std::int8_t u = 0;
  std::int8_t v = 0;

  /// From a vector of any length; none for a zero vector.
  [[nodiscard]] static PackedNormal of(const Eigen::Vector3f& normal) {
    const float sum = normal.cwiseAbs().sum();
    if (!(sum > 0)) return {};
    Eigen::Vector2f flat = normal.head<2>() / sum;
    // The lower half is folded outwards. The upright direction would be 0, 0 and is shifted slightly.
    if (normal.z() < 0) flat = folded(flat);
    PackedNormal packed{step(flat.x()), step(flat.y())};
    if (packed.u == 0 && packed.v == 0) packed.u = 1;
    return packed;
  }

  [[nodiscard]] bool known() const { return u != 0 || v != 0; }

  /// Unit vector; zero for none.
  [[nodiscard]] Eigen::Vector3f unpacked() const {
    if (!known()) return Eigen::Vector3f::Zero();
    Eigen::Vector2f flat(static_cast<float>(u) / kSteps, static_cast<float>(v) / kSteps);
    const float z = 1 - flat.cwiseAbs().sum();
    if (z < 0) flat = folded(flat);
    return Eigen::Vector3f(flat.x(), flat.y(), z).normalized();
  }
  bool operator==(const PackedNormal&) const = default;

 private:
  static constexpr float kSteps = 127;
  static std::int8_t step(float value) {
    return static_cast<std::int8_t>(std::lround(kSteps * std::clamp(value, -1.0F, 1.0F)));
  }
  static Eigen::Vector2f folded(const Eigen::Vector2f& flat) {
    return {std::copysign(1 - std::abs(flat.y()), flat.x()), std::copysign(1 - std::abs(flat.x()), flat.y())};
  }
};

}  // namespace scantrove
