#pragma once
#include <Eigen/Core>

namespace scantrove {

/// The directions in which a set of vectors varies most, and coordinates along them (thesis 5.2: 19 of them
/// prune).
class PrincipalComponents {
 public:
  static constexpr int kCount = 19;
  using Coordinates = Eigen::Matrix<float, kCount, 1>;

  /// `rows`: one vector a row, at least kCount of them. Subspace iteration from a fixed start, so that the
  /// same rows give the same components everywhere; cost rows * columns * about 300 multiplications.
  [[nodiscard]] static PrincipalComponents fit(const Eigen::MatrixXf& rows);

  /// Distances between coordinates are at most those between the vectors.
  [[nodiscard]] Coordinates project(const Eigen::VectorXf& vector) const {
    return axes_.transpose() * (vector - mean_);
  }

  [[nodiscard]] bool isEmpty() const { return axes_.size() == 0; }
  [[nodiscard]] const Eigen::MatrixXf& axes() const {
    return axes_;
  }  ///< columns orthonormal, most variance first

 private:
  Eigen::VectorXf mean_;
  Eigen::MatrixXf axes_;
};

}  // namespace scantrove
