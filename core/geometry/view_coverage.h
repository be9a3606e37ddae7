#pragma once
#include <Eigen/Core>
#include <array>
#include <bitset>
#include <optional>

namespace scantrove {

/// The directions from which a thing was seen: a sphere around it, in 256 cells of equal size. Directions are
/// vectors of any length from the thing to the camera, in the world.
class ViewCoverage {
 public:
  static constexpr std::size_t kCells = 256;  ///< 14 degrees apart: finer than kReach_deg
  using Cells = std::bitset<kCells>;
  /// A view also covers directions up to this angle from its own.
  static constexpr float kReach_deg = 22.5F;

  ViewCoverage() = default;
  /// `cells`: from cells().
  explicit ViewCoverage(const Cells& cells) : cells_(cells) {}

  /// Adds a view. Ignores a vector that is zero or not finite.
  void addDirection(const Eigen::Vector3f& direction);
  /// Adds the views of a part of the thing.
  void add(const ViewCoverage& other) { cells_ |= other.cells_; }

  [[nodiscard]] bool covers(const Eigen::Vector3f& direction) const;
  /// Of the whole sphere, 0 .. 1.
  [[nodiscard]] float share() const;
  [[nodiscard]] const Cells& cells() const { return cells_; }
  bool operator==(const ViewCoverage&) const = default;

 private:
  Cells cells_;  // the covered ones
};

/// The sides of a thing that were seen, for a user who walks around it. Height does not matter.
struct SeenSides {
  static constexpr std::size_t kSides = 12;  ///< as the hours of a clock, 30 degrees each
  std::array<bool, kSides> sides{};  ///< counterclockwise from above, the first one towards SideAxes::front
  bool above = false;                ///< seen steeply from above

  [[nodiscard]] int count() const;
  /// Seen from all around. `above` is not required.
  [[nodiscard]] bool isComplete() const { return count() == static_cast<int>(kSides); }
  bool operator==(const SeenSides&) const = default;
};

/// How the sides lie in the world: unit vectors, `front` square to `up`.
struct SideAxes {
  Eigen::Vector3f up = -Eigen::Vector3f::UnitY();
  Eigen::Vector3f front = -Eigen::Vector3f::UnitZ();

  /// `front` is the part of `towards` square to `up`; if that vanishes, any direction square to `up`.
  [[nodiscard]] static SideAxes of(const Eigen::Vector3f& up, const Eigen::Vector3f& towards);
  /// Unit direction of the middle of a side, at this elevation above the horizon.
  [[nodiscard]] Eigen::Vector3f directionOf(std::size_t side, float elevation_deg) const;
  bool operator==(const SideAxes&) const = default;
};

[[nodiscard]] SeenSides sidesOf(const ViewCoverage& coverage, const SideAxes& axes);

/// The next direction to scan from: the unseen side nearest to `from` (thing to camera), at the elevation of
/// `from`, limited to 10 .. 50 degrees. Unit; none: all sides were seen.
[[nodiscard]] std::optional<Eigen::Vector3f> nextDirection(const SeenSides& seen, const SideAxes& axes,
                                                           const Eigen::Vector3f& from);

}  // namespace scantrove
