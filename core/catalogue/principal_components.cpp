#include "core/catalogue/principal_components.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <random>

#include "core/base/check.h"

namespace scantrove {

PrincipalComponents PrincipalComponents::fit(const Eigen::MatrixXf& rows) {
  SCANTROVE_CHECK(rows.rows() >= kCount && rows.cols() >= kCount);
  constexpr int kSpare = 5, kRounds = 4;  // spare directions and rounds settle the last components
  const Eigen::Index width = std::min<Eigen::Index>({kCount + kSpare, rows.rows(), rows.cols()});
  PrincipalComponents result;
  result.mean_ = rows.colwise().mean();
  const Eigen::MatrixXf centered = rows.rowwise() - result.mean_.transpose();

  std::mt19937 random(19);
  Eigen::MatrixXf basis(rows.cols(), width);
  for (Eigen::Index i = 0; i < basis.size(); ++i) {
    basis.data()[i] = static_cast<float>(random() % 2001) / 1000.0F - 1.0F;
  }
  const auto orthonormal = [&](const Eigen::MatrixXf& columns) -> Eigen::MatrixXf {
    return Eigen::HouseholderQR<Eigen::MatrixXf>(columns).householderQ() *
           Eigen::MatrixXf::Identity(columns.rows(), width);
  };
  for (int round = 0; round < kRounds; ++round) {
    basis = orthonormal(basis);
    const Eigen::MatrixXf along = centered * basis;
    basis = centered.transpose() * along;
  }
  basis = orthonormal(basis);
  const Eigen::MatrixXf along = centered * basis;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXf> eigen(along.transpose() * along);
  result.axes_ =
      basis * eigen.eigenvectors().rowwise().reverse().leftCols(kCount);  // ascending becomes descending
  return result;
}

}  // namespace scantrove
