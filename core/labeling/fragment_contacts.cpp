#include "core/labeling/fragment_contacts.h"

#include <algorithm>
#include <cmath>

namespace scantrove {
namespace {

constexpr float kDistanceFactor = 3;       // d_max of eq. 3.5: factor * z / f ...
constexpr float kLeastDistance_m = 0.01F;  // ... but at least this, for each step
constexpr int kLongestStep_px = 3;         // over pixels without fragment
constexpr int kBendReach_px = 3;           // normals and segments are compared so far to either side
constexpr float kBendGap = 4;              // times d_max: normals farther apart belong to something else

struct Step {
  std::uint64_t pair;  // a in the upper half
  float length_m, depth_m, concavity_rad;
  bool bridged, has_bend;
  Eigen::Vector3f color = Eigen::Vector3f::Zero();  // of b less that of a
};

std::uint64_t pairKey(FragmentId a, FragmentId b) {
  const auto [low, high] = std::minmax(a.value, b.value);
  return std::uint64_t{low} << 32 | high;
}

class StepFinder {
 public:
  StepFinder(const MergeInput& input, std::span<const FragmentId> parts)
      : input_(input), parts_(parts), focal_px_(std::min(input.K.fx, input.K.fy)) {}

  std::vector<Step> find() {
    for (int y = 0; y < input_.K.height; ++y) {
      for (int x = 0; x < input_.K.width; ++x) {
        if (!parts_[at(x, y)]) continue;
        look(x, y, 1, 0);
        look(x, y, 0, 1);
      }
    }
    return std::move(steps_);
  }

 private:
  [[nodiscard]] std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(input_.K.width) +
           static_cast<std::size_t>(x);
  }
  [[nodiscard]] bool isInside(int x, int y) const {
    return x >= 0 && y >= 0 && x < input_.K.width && y < input_.K.height;
  }

  void look(int x, int y, int dx, int dy) {
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
    const Eigen::Vector4f& from = input_.vertices_world[here];
    const Eigen::Vector4f& to = input_.vertices_world[there];
    if (!(from.w() > 0) || !(to.w() > 0)) return;
    const float z = input_.segments.depths_m[here];
    const float reach_m = std::max(kDistanceFactor * z / focal_px_, kLeastDistance_m);
    if (!(z > 0) || !((to - from).squaredNorm() < std::pow(reach_m * static_cast<float>(length), 2.0F)))
      return;
    Step step{
        pairKey(parts_[here], parts_[there]), z / focal_px_, z, 0, false, false, Eigen::Vector3f::Zero()};
    // A little off the border: that of the segments and that of the voxels are never quite the same.
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
    steps_.push_back(step);
  }

  void measureBend(std::size_t here, std::size_t there, float gap_m, Step& step) {
    const Eigen::Vector4f& n_a = input_.normals_world[here];
    const Eigen::Vector4f& n_b = input_.normals_world[there];
    if (!(n_a.w() > 0) || !(n_b.w() > 0)) return;
    const Eigen::Vector3f across = (input_.vertices_world[there] - input_.vertices_world[here]).head<3>();
    if (!(across.norm() < gap_m)) return;
    const Eigen::Vector3f turn = (n_b - n_a).head<3>();
    const float angle = 2 * std::asin(std::min(1.0F, turn.norm() / 2));
    step.concavity_rad = across.dot(turn) > 0 ? -angle : angle;
    step.has_bend = true;
  }

  const MergeInput& input_;
  std::span<const FragmentId> parts_;
  float focal_px_;
  std::vector<Step> steps_;
};

FragmentContact summarise(std::span<const Step> steps, bool has_color) {
  FragmentContact contact;
  contact.a.value = static_cast<std::uint32_t>(steps.front().pair >> 32);
  contact.b.value = static_cast<std::uint32_t>(steps.front().pair);
  contact.length_px = static_cast<int>(steps.size());
  Eigen::Vector3f color = Eigen::Vector3f::Zero();
  for (const Step& step : steps) {
    contact.bridged_px += step.bridged ? 1 : 0;
    contact.length_m += step.length_m;
    contact.depth_m += step.depth_m;
    color += step.color;
    if (!step.has_bend) continue;
    ++contact.bends;
    contact.concavity_rad += step.concavity_rad;
    contact.turn_rad += std::abs(step.concavity_rad);
    contact.folded += step.concavity_rad > kClearBend_rad ? 1.0F : 0.0F;
    contact.ridged += step.concavity_rad < -kClearBend_rad ? 1.0F : 0.0F;
  }
  contact.depth_m /= static_cast<float>(contact.length_px);
  if (has_color) contact.color_shift = color.norm() / static_cast<float>(contact.length_px);
  if (contact.bends > 0) {
    contact.concavity_rad /= static_cast<float>(contact.bends);
    contact.turn_rad /= static_cast<float>(contact.bends);
    contact.folded /= static_cast<float>(contact.bends);
    contact.ridged /= static_cast<float>(contact.bends);
  }
  return contact;
}

}  // namespace

std::vector<FragmentContact> findContacts(const MergeInput& input, std::span<const FragmentId> parts) {
  std::vector<Step> steps = StepFinder(input, parts).find();
  std::ranges::stable_sort(steps, {}, &Step::pair);
  std::vector<FragmentContact> contacts;
  for (std::size_t first = 0, next = 0; first < steps.size(); first = next) {
    while (next < steps.size() && steps[next].pair == steps[first].pair) ++next;
    contacts.push_back(summarise(std::span(steps).subspan(first, next - first), !input.color_lab.empty()));
  }
  return contacts;
}

}  // namespace scantrove
