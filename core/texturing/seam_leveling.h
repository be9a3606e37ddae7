#pragma once
#include <Eigen/Core>
#include <Eigen/Sparse>
#include <opencv2/core/mat.hpp>
#include <span>
#include <vector>

#include "core/texturing/chart_cutter.h"

namespace scantrove {

/// Offsets of colours that make neighbouring charts alike where they meet (after Lempitsky and Ivanov 2007):
/// first one offset for each chart, then one for each of its vertices, by least squares; what remains is
/// shared between the charts and fades out within a few faces.
class SeamLeveling {
 public:
  /// Of charts that cover faces at most once. The arguments outlive this.
  SeamLeveling(const ViewedSurface& viewed, std::span<const TextureChart> charts);

  /// Reads the colours at the seams from the image of a view (CV_8UC3); once for each view.
  void sample(ViewNumber view, const cv::Mat& image);
  void solve();

  /// What is added at the corners of the face: one column for each, blue, green, red; zero outside of charts.
  [[nodiscard]] Eigen::Matrix3f offsetsOf(std::uint32_t face) const;

 private:
  /// A vertex within a chart.
  struct Node {
    std::uint32_t vertex, chart;
  };
  using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;
  using Channels = Eigen::Matrix<double, Eigen::Dynamic, 3>;

  void findNodes();
  /// Calls use(a, b) for each pair of nodes of one vertex.
  template <class Use>
  void forEachSeamPair(const Use& use) const;
  [[nodiscard]] Channels offsetsOfCharts() const;
  [[nodiscard]] Matrix equations() const;
  void fadeRest(const Matrix& equations);

  const ViewedSurface& viewed_;
  std::span<const TextureChart> charts_;
  std::vector<Node> nodes_;                    // by vertex
  std::vector<std::uint32_t> seam_nodes_;      // those whose vertex has several, ascending
  std::vector<std::uint32_t> node_of_corner_;  // by 3 * face + corner
  Channels colors_;                            // of seam nodes: blue, green, red
  Channels offsets_;                           // of nodes
};

}  // namespace scantrove
