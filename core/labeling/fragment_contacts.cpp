#include "core/labeling/fragment_contacts.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "core/geometry/surface_step.h"

namespace scantrove {
namespace {

constexpr int kLongestStep_px = 3;  // over pixels without fragment
constexpr float kBendGap = 4;       // times d_max: normals farther apart belong to another surface

struct Step {
  float length_m, depth_m, concavity_rad, step_m;
  bool bridged, has_bend;
  Eigen::Vector3f color = Eigen::Vector3f::Zero();  // b minus a
};

std::uint64_t pairKey(FragmentId a, FragmentId b) {
  const auto [low, high] = std::minmax(a.value, b.value);
  return std::uint64_t{low} << 32 | high;
}

/// Sums over the steps between two fragments.
struct Sum {
  std::uint64_t pair = 0;  // a in the upper half
  FragmentContact contact;
  Eigen::Vector3f color = Eigen::Vector3f::Zero();

  void add(const Step& step) {
    ++contact.length_px;
    contact.bridged_px += step.bridged ? 1 : 0;
    contact.length_m += step.length_m;
    contact.depth_m += step.depth_m;
    contact.step_m += step.step_m;
    color += step.color;
    if (!step.has_bend) return;
    ++contact.bends;
    contact.concavity_rad += step.concavity_rad;
    contact.folded += step.concavity_rad > kClearBend_rad ? 1.0F : 0.0F;
    contact.ridged += step.concavity_rad < -kClearBend_rad ? 1.0F : 0.0F;
  }

  /// Sums to means.
  [[nodiscard]] FragmentContact mean(bool has_color) const {
    FragmentContact result = contact;
    result.a.value = static_cast<std::uint32_t>(pair >> 32);
    result.b.value = static_cast<std::uint32_t>(pair);
    result.depth_m /= static_cast<float>(contact.length_px);
    result.step_m /= static_cast<float>(contact.length_px);
    if (has_color) result.color_shift = color.norm() / static_cast<float>(contact.length_px);
    if (contact.bends > 0) {
      result.concavity_rad /= static_cast<float>(contact.bends);
      result.folded /= static_cast<float>(contact.bends);
      result.ridged /= static_cast<float>(contact.bends);
    }
    return result;
  }
};

class StepFinder {
 public:
  StepFinder(const MergeInput& input, std::span<const FragmentId> parts)
      : input_(input), parts_(parts), focal_px_(std::min(input.view.K.fx, input.view.K.fy)) {}

  /// Ordered by pair.
  std::vector<Sum> find() {
    const int last_x = input_.view.K.width - 1, last_y = input_.view.K.height - 1;
    for (int y = 0; y <= last_y; ++y) {
      const FragmentId* row = parts_.data() + at(0, y);
      const FragmentId* below = parts_.data() + at(0, std::min(y + 1, last_y));
      for (int x = 0; x <= last_x; ++x) {
        if (!row[x]) continue;
        if (x < last_x && row[x + 1] != row[x]) visit(x, y, 1, 0);
        if (below[x] != row[x]) visit(x, y, 0, 1);
      }
    }
    std::ranges::sort(sums_, {}, &Sum::pair);
    return std::move(sums_);
  }

 private:
  [[nodiscard]] std::size_t at(int x, int y) const { return input_.view.K.indexOf(x, y); }
  [[nodiscard]] bool isInside(int x, int y) const { return input_.view.K.isInside(x, y); }

  void visit(int x, int y, int dx, int dy) {
    for (int step = 1; step <= kLongestStep_px; ++step) {
      const int u = x + step * dx, v = y + step * dy;
      if (!isInside(u, v)) return;
      const FragmentId other = parts_[at(u, v)];
      if (!other) continue;
      if (other != parts_[at(x, y)]) cross(x, y, u, v, dx, dy, step);
      return;
    }
  }

  void cross(int x, int y, int u, int v, int dx, int dy, int length) {
    const std::size_t here = at(x, y), there = at(u, v);
    const Eigen::Vector4f& from = input_.view.vertices_world[here];
    const Eigen::Vector4f& to = input_.view.vertices_world[there];
    if (!(from.w() > 0) || !(to.w() > 0)) return;
    const float z = input_.segments.depths_m[here];
    const float reach_m = maxNeighborDistance(z, focal_px_);
    if (!(z > 0) || !((to - from).squaredNorm() < std::pow(reach_m * static_cast<float>(length), 2.0F)))
      return;
    Step step{z / focal_px_, z, 0, stepBetween(here, there), false, false, Eigen::Vector3f::Zero()};
    // Some distance off the border, because the segments' border and the voxels' border never quite coincide.
    for (int off = kBendReach_px; off >= 0; --off) {
      if (!isInside(x - off * dx, y - off * dy) || !isInside(u + off * dx, v + off * dy)) continue;
      const std::size_t a = at(x - off * dx, y - off * dy), b = at(u + off * dx, v + off * dy);
      if (parts_[a] != parts_[here] || parts_[b] != parts_[there]) continue;
      step.bridged = input_.segments.ids[a] != 0 && input_.segments.ids[a] == input_.segments.ids[b];
      if (off > 0) measureBend(a, b, kBendGap * reach_m, step);
      if (!input_.color_lab.empty()) {
        step.color = input_.color_lab[b] - input_.color_lab[a];
        if (parts_[here] > parts_[there]) step.color = -step.color;
      }
      break;
    }
    sumOf(pairKey(parts_[here], parts_[there])).add(step);
  }

  /// Along the mean of both normals.
  [[nodiscard]] float stepBetween(std::size_t here, std::size_t there) const {
    const Eigen::Vector4f& n_a = input_.view.normals_world[here];
    const Eigen::Vector4f& n_b = input_.view.normals_world[there];
    if (!(n_a.w() > 0) || !(n_b.w() > 0)) return 0;
    const Eigen::Vector3f across =
        (input_.view.vertices_world[there] - input_.view.vertices_world[here]).head<3>();
    return std::abs((n_a + n_b).head<3>().normalized().dot(across));
  }

  Sum& sumOf(std::uint64_t pair) {
    if (sums_.empty() || sums_[last_].pair != pair) {
      const auto [entry, is_new] = index_.try_emplace(pair, sums_.size());
      if (is_new) sums_.emplace_back().pair = pair;
      last_ = entry->second;
    }
    return sums_[last_];
  }

  void measureBend(std::size_t here, std::size_t there, float gap_m, Step& step) {
    const Eigen::Vector4f& n_a = input_.view.normals_world[here];
    const Eigen::Vector4f& n_b = input_.view.normals_world[there];
    if (!(n_a.w() > 0) || !(n_b.w() > 0)) return;
    const Eigen::Vector3f across =
        (input_.view.vertices_world[there] - input_.view.vertices_world[here]).head<3>();
    if (!(across.norm() < gap_m)) return;
    step.concavity_rad = bendBetween(n_a, n_b, across);
    step.has_bend = true;
  }

  const MergeInput& input_;
  std::span<const FragmentId> parts_;
  float focal_px_;
  std::vector<Sum> sums_;
  std::unordered_map<std::uint64_t, std::size_t> index_;  // of pairs in sums_
  std::size_t last_ = 0;                                  // of the last pair
};

}  // namespace

std::vector<FragmentContact> findContacts(const MergeInput& input, std::span<const FragmentId> parts) {
  std::vector<FragmentContact> contacts;
  const FragmentColors colors(input, parts);
  for (const Sum& sum : StepFinder(input, parts).find()) {
    FragmentContact& contact = contacts.emplace_back(sum.mean(!input.color_lab.empty()));
    contact.colors = colors.between(contact.a, contact.b);
  }
  return contacts;
}

}  // namespace scantrove
