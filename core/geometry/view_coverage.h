#pragma once
#include <Eigen/Core>
#include <array>
#include <bitset>
#include <optional>

namespace scantrove {

/// From which directions something was seen: a sphere around it, in 256 cells of equal size. Directions are
/// vectors of any length from the thing to the camera, in the world.
class ViewCoverage {
 public:
  static constexpr std::size_t kCells = 256;  ///< 14 degrees apart: finer than kReach_deg
  using Cells = std::bitset<kCells>;
  /// A view also covers directions up to this angle from its own.
  static constexpr float kReach_deg = 22.5F;

  ViewCoverage() = default;
  /// As cells() gave it.
  explicit ViewCoverage(const Cells& cells) : cells_(cells) {}

  /// It was seen from there. One that is not a finite, non-zero vector changes nothing.
  void addDirection(const Eigen::Vector3f& direction);
  /// It is part of what the other one is of, or the other way round.
  void add(const ViewCoverage& other) { cells_ |= other.cells_; }

  [[nodiscard]] bool covers(const Eigen::Vector3f& direction) const;
  /// Of the whole sphere, 0 .. 1.
  [[nodiscard]] float share() const;
  [[nodiscard]] const Cells& cells() const { return cells_; }
  bool operator==(const ViewCoverage&) const = default;

 private:
  Cells cells_;  // those that were seen
};

/// What a person has to know of it who walks around a thing: which sides were seen, at whatever height.
struct SeenSides {
  static constexpr std::size_t kSides = 12;  ///< as the hours of a clock, 30 degrees each
  std::array<bool, kSides> sides{};  ///< counterclockwise from above, the first one towards SideAxes::front
  bool above = false;                ///< seen steeply from above

  [[nodiscard]] int count() const;
  /// From all around; for what stands somewhere that is all there is to see.
  [[nodiscard]] bool isComplete() const { return count() == static_cast<int>(kSides); }
  bool operator==(const SeenSides&) const = default;
};

/// How the sides lie in the world: unit vectors, `front` square to `up`.
struct SideAxes {
  Eigen::Vector3f up = -Eigen::Vector3f::UnitY();
  Eigen::Vector3f front = -Eigen::Vector3f::UnitZ();

  /// `towards`: any direction; its part along `up` is left out. Some front where nothing else is left of it.
  [[nodiscard]] static SideAxes of(const Eigen::Vector3f& up, const Eigen::Vector3f& towards);
  /// The middle of a side, so high above the horizon. Unit.
  [[nodiscard]] Eigen::Vector3f directionOf(std::size_t side, float elevation_deg) const;
  bool operator==(const SideAxes&) const = default;
};

[[nodiscard]] SeenSides sidesOf(const ViewCoverage& coverage, const SideAxes& axes);

/// Where to look from next: the unseen side with the shortest way around from `from` (thing to camera), as
/// high as that is, within reason. Unit; none: all sides were seen.
[[nodiscard]] std::optional<Eigen::Vector3f> nextDirection(const SeenSides& seen, const SideAxes& axes,
                                                           const Eigen::Vector3f& from);

}  // namespace scantrove
