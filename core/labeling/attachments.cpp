#include "core/labeling/attachments.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>
#include <unordered_map>

#include "core/geometry/camera_depth.h"
#include "core/geometry/surface_step.h"

namespace scantrove {
namespace {

constexpr int kMaxVoxels = 12000;                      // of an object: 0.4 square metres
constexpr int kMinOutline = 20, kMinContact = 6;       // steps
constexpr float kMaxUnseen = 0.35F;                    // of the outline: hidden or cut off
constexpr float kOnlyOne = 0.85F;                      // of its contacts are with the other region
constexpr float kNear_m = 0.03F;                       // reach around the contact on the other's surface
constexpr float kMaxNear_px = 20;                      // bounds the cost where the camera is near
constexpr float kNearest_m = 0.1F;                     // no camera measures nearer depth
constexpr std::size_t kPlaces = 16, kDirections = 24;  // samples: bounds the cost
constexpr std::size_t kMinNormals = 6;                 // fewer give no shape
constexpr float kSameDirection = 0.985F;               // cosine of 10 degrees
// The part of normals with the same direction: at most on a curved surface, at least on a flat one.
constexpr float kMaxCurved = 0.27F, kMinFlat = 0.33F;

/// A step from a pixel of one region to a pixel of a region that it touches.
struct Touch {
  RegionId from, to;
  std::size_t here, there;
};

/// Step counts of a region's outline.
struct Outline {
  int known = 0, unseen = 0, touching = 0;
  [[nodiscard]] bool isSeen() const {
    return known >= kMinOutline && static_cast<float>(unseen) <= kMaxUnseen * static_cast<float>(known);
  }
};

/// Outlines and contacts of a frame's regions that are no larger than objects. Steps are classified as in
/// discovery's RegionOutlines, which has more kinds of contact.
class FrameOutlines {
 public:
  FrameOutlines(const MergeInput& input, std::span<const RegionId> regions, const RegionTable& table)
      : input_(input),
        K_(input.view.K),
        regions_(regions),
        table_(table),
        depth_of_(input.view.T_world_camera) {
    for (int y = 0; y < K_.height; ++y) {
      for (int x = 0; x < K_.width; ++x) {
        if (isWithin(x, y)) continue;
        visit(x, y, 1, 0);
        visit(x, y, 0, 1);
        visit(x, y, -1, 0);
        visit(x, y, 0, -1);
      }
    }
    std::ranges::sort(touches_, {}, [](const Touch& touch) {
      return std::tuple(touch.from, touch.to, touch.here, touch.there);
    });
  }

  [[nodiscard]] const std::vector<Touch>& touches() const { return touches_; }
  [[nodiscard]] const Outline& of(RegionId region) const { return outlines_.at(region).outline; }

  /// The part of the region's surface near the contact that faces the same way; none if too little is seen.
  [[nodiscard]] std::optional<float> flatPart(std::span<const Touch> contact) const {
    std::vector<std::size_t> pixels;
    const std::size_t stride = (contact.size() + kPlaces - 1) / kPlaces;
    for (std::size_t i = 0; i < contact.size(); i += stride) collectNear(contact[i], pixels);
    std::ranges::sort(pixels);
    pixels.erase(std::unique(pixels.begin(), pixels.end()), pixels.end());
    if (pixels.size() < kMinNormals) return std::nullopt;
    const std::size_t each = (pixels.size() + kDirections - 1) / kDirections;
    std::size_t most = 0;
    for (std::size_t i = 0; i < pixels.size(); i += each) {
      const Eigen::Vector4f& direction = input_.view.normals_world[pixels[i]];
      const auto same = static_cast<std::size_t>(std::ranges::count_if(pixels, [&](std::size_t pixel) {
        return input_.view.normals_world[pixel].head<3>().dot(direction.head<3>()) > kSameDirection;
      }));
      most = std::max(most, same);
    }
    return static_cast<float>(most) / static_cast<float>(pixels.size());
  }

 private:
  struct Known {
    bool is_small = false;
    Outline outline;
  };

  /// True if all of the pixel's neighbours belong to its region.
  [[nodiscard]] bool isWithin(int x, int y) const {
    if (x == 0 || y == 0 || x + 1 == K_.width || y + 1 == K_.height) return false;
    const std::size_t here = K_.indexOf(x, y);
    const auto width = static_cast<std::size_t>(K_.width);
    const RegionId region = regions_[here];
    return regions_[here + 1] == region && regions_[here - 1] == region && regions_[here + width] == region &&
           regions_[here - width] == region;
  }

  Known& know(RegionId region) {
    if (known_last_ != nullptr && last_ == region) return *known_last_;
    const auto [entry, is_new] = outlines_.try_emplace(region);
    last_ = region;
    known_last_ = &entry->second;  // stays where it is, whatever else becomes known
    if (!is_new) return entry->second;
    int voxels = 0;
    for (const FragmentId fragment : table_.fragmentsOf(region))
      voxels += fragment.value < input_.voxels.size() ? input_.voxels[fragment.value] : 0;
    entry->second.is_small = voxels <= kMaxVoxels;
    return entry->second;
  }

  void visit(int x, int y, int dx, int dy) {
    const std::size_t here = K_.indexOf(x, y);
    const RegionId region = regions_[here];
    if (!region) return;
    const bool is_cut = !K_.isInside(x + dx, y + dy);
    if (!is_cut && regions_[K_.indexOf(x + dx, y + dy)] == region) return;
    Known& known = know(region);
    if (!known.is_small) return;
    Outline& outline = known.outline;
    const int u = x + kBeyondEdge_px * dx, v = y + kBeyondEdge_px * dy;
    if (is_cut || !K_.isInside(u, v)) {
      ++outline.known;
      ++outline.unseen;
      return;
    }
    const std::size_t there = K_.indexOf(u, v);
    const RegionId other = regions_[there];
    const Eigen::Vector4f& from = input_.view.vertices_world[here];
    const Eigen::Vector4f& to = input_.view.vertices_world[there];
    if (other == region || !(from.w() > 0) || !(to.w() > 0)) return;
    ++outline.known;
    const DepthStep step = depthStep(depth_of_(from), depth_of_(to));
    if (step == DepthStep::deeper) return;
    if (step == DepthStep::nearer) {
      ++outline.unseen;
      return;
    }
    ++outline.touching;
    if (other && know(other).is_small) touches_.push_back({region, other, here, there});
  }

  void collectNear(const Touch& touch, std::vector<std::size_t>& pixels) const {
    const Eigen::Vector3f place = input_.view.vertices_world[touch.there].head<3>();
    const float z = std::max(kNearest_m, depth_of_(input_.view.vertices_world[touch.there]));
    const auto reach = static_cast<int>(
        std::min(kMaxNear_px, std::ceil(kNear_m * std::max(input_.view.K.fx, input_.view.K.fy) / z)));
    const int x0 = static_cast<int>(touch.there) % K_.width, y0 = static_cast<int>(touch.there) / K_.width;
    for (int y = std::max(0, y0 - reach); y <= std::min(K_.height - 1, y0 + reach); ++y) {
      for (int x = std::max(0, x0 - reach); x <= std::min(K_.width - 1, x0 + reach); ++x) {
        const std::size_t pixel = K_.indexOf(x, y);
        if (regions_[pixel] != touch.to || !(input_.view.vertices_world[pixel].w() > 0) ||
            !(input_.view.normals_world[pixel].w() > 0))
          continue;
        if ((input_.view.vertices_world[pixel].head<3>() - place).squaredNorm() < kNear_m * kNear_m)
          pixels.push_back(pixel);
      }
    }
  }

  const MergeInput& input_;
  const Intrinsics& K_;
  std::span<const RegionId> regions_;
  const RegionTable& table_;
  CameraDepth depth_of_;
  std::unordered_map<RegionId, Known> outlines_;
  RegionId last_;
  Known* known_last_ = nullptr;  // of last_
  std::vector<Touch> touches_;
};

}  // namespace

std::vector<Attachment> findAttachments(const MergeInput& input, const RegionMerger::Outcome& merged,
                                        const RegionTable& table) {
  const FrameOutlines outlines(input, merged.regions, table);
  const std::span<const Touch> touches = outlines.touches();
  std::map<std::pair<RegionId, RegionId>, Attachment> found;
  for (std::size_t first = 0, next = 0; first < touches.size(); first = next) {
    const auto [part, whole] = std::pair(touches[first].from, touches[first].to);
    while (next < touches.size() && touches[next].from == part && touches[next].to == whole) ++next;
    const std::span<const Touch> contact = touches.subspan(first, next - first);
    const Outline& outline = outlines.of(part);
    if (contact.size() < kMinContact || !outline.isSeen()) continue;
    const bool is_only_one =
        static_cast<float>(contact.size()) >= kOnlyOne * static_cast<float>(outline.touching);
    const std::optional<float> flat = is_only_one ? outlines.flatPart(contact) : 1;
    if (!flat || (*flat > kMaxCurved && *flat < kMinFlat)) continue;
    const auto [low, high] = std::minmax(part, whole);
    const auto [entry, is_new] = found.try_emplace({low, high}, Attachment{low, high, false, {}});
    Attachment& attachment = entry->second;
    attachment.is_attached = attachment.is_attached || *flat <= kMaxCurved;
    for (const Touch& touch : contact) {
      std::pair<FragmentId, FragmentId> border(merged.fragments[touch.here], merged.fragments[touch.there]);
      if (part != low) std::swap(border.first, border.second);
      if (std::ranges::find(attachment.borders, border) == attachment.borders.end())
        attachment.borders.push_back(border);
    }
  }
  std::vector<Attachment> attachments;
  for (auto& [regions, attachment] : found) attachments.push_back(std::move(attachment));
  return attachments;
}

}  // namespace scantrove
