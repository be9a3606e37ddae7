#pragma once
#include <Eigen/Core>
#include <array>
#include <vector>

namespace scantrove {

/// The size of an object from those of its views: the median of each side, in metres. A few views may show
/// only a part of it.
class MedianSize {
 public:
  /// A size that is zero or not finite is ignored.
  void add(const Eigen::Vector3f& size_m);
  /// Zero: no view has a size.
  [[nodiscard]] Eigen::Vector3f value_m() const;

 private:
  std::array<std::vector<float>, 3> sides_m_;
};

}  // namespace scantrove
