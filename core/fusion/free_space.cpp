#include "core/fusion/free_space.h"

#include <opencv2/core/utility.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/base/check.h"

namespace scantrove {
namespace {

constexpr int kViewsPerWitness = 4;    // successive views are nearly the same
constexpr std::size_t kWitnesses = 7;  // times 4 views: about a second
constexpr int kWitnessesNeeded = 2;    // one view alone may be wrong
constexpr float kNoReading_m = 1e6F;   // farther than any reading

}  // namespace

cv::Mat FreeSpace::contradicting(const DepthView& now) const {
  SCANTROVE_CHECK(now.z_m.type() == CV_32FC1 && now.z_m.cols == now.K.width && now.z_m.rows == now.K.height);
  cv::Mat votes = cv::Mat::zeros(now.z_m.size(), CV_8UC1);
  const auto askOfRows = [&](const Witness& witness, const cv::Range& rows) {
    const Eigen::Affine3f T((witness.T_camera_world * now.T_world_camera).cast<float>());
    const Intrinsics& K = witness.K;
    const Eigen::Vector3f along_row = T.linear().col(0) / now.K.fx;
    for (int v = rows.start; v < rows.end; ++v) {
      const auto* z = now.z_m.ptr<float>(v);
      auto* vote = votes.ptr<std::uint8_t>(v);
      const Eigen::Vector3f first =
          T.linear() *
          Eigen::Vector3f(-now.K.cx / now.K.fx, (static_cast<float>(v) - now.K.cy) / now.K.fy, 1);
      for (int u = 0; u < now.z_m.cols; ++u) {
        if (!(z[u] > 0)) continue;
        const Eigen::Vector3f q = z[u] * (first + static_cast<float>(u) * along_row) + T.translation();
        if (!(q.z() > 0)) continue;
        const float per_z = 1 / q.z();
        const float x = K.fx * q.x() * per_z + K.cx + 0.5F;
        const float y = K.fy * q.y() * per_z + K.cy + 0.5F;
        if (!(x >= 0 && y >= 0 && x < static_cast<float>(K.width) && y < static_cast<float>(K.height)))
          continue;
        const float seen = witness.nearest_m.at<float>(static_cast<int>(y), static_cast<int>(x));
        if (seen > q.z() + kBefore.at(q.z(), depth_noise_m_)) ++vote[u];
      }
    }
  };
  cv::parallel_for_({0, now.z_m.rows}, [&](const cv::Range& rows) {
    for (const Witness& witness : seen_.witnesses) askOfRows(witness, rows);
  });
  return votes >= kWitnessesNeeded;
}

void FreeSpace::add(const DepthView& view) {
  if (seen_.views++ % kViewsPerWitness != 0) return;
  cv::Mat readings = view.z_m.clone();
  const cv::Mat none = readings <= 0;
  readings.setTo(kNoReading_m, none);
  cv::Mat nearest;
  cv::erode(readings, nearest, cv::getStructuringElement(cv::MORPH_RECT, {3, 3}));
  nearest.setTo(0, none);
  seen_.witnesses.push_back({view.K, view.T_world_camera.inverse(), nearest});
  if (seen_.witnesses.size() > kWitnesses) seen_.witnesses.pop_front();
}

}  // namespace scantrove
