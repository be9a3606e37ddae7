#include "core/labeling/support_recorder.h"

#include <utility>

#include "core/base/check.h"

namespace scantrove {

void SupportRecorder::record(const SegmentMap& segments, const RenderedView& view, RegionTable& table) {
  SCANTROVE_CHECK(segments.ids.size() == view.fragments.size());
  const Intrinsics& K = view.K;
  constexpr int kStep = 2;          // pixels, both ways
  constexpr double kReference = 4;  // pixels of 640 x 480 in one of 320 x 240
  const auto weight = static_cast<float>(kStep * kStep / (kReference * K.pixelScale()));
  pixels_.resize(table.regions().size());
  in_view_.clear();
  for (int v = 0; v < K.height; v += kStep) {
    for (int u = 0; u < K.width; u += kStep) {
      const std::size_t at = K.indexOf(u, v);
      const FragmentId fragment = view.fragments[at];
      if (!fragment || segments.ids[at] == 0) continue;
      SupportPixels& pixels = pixels_[fragment.value];
      if (pixels.seen == 0) in_view_.push_back(fragment);
      const SegmentRole::Kind role = segments.roleOf(segments.ids[at]).kind;
      pixels.seen += weight;
      pixels.support += role == SegmentRole::Kind::support ? weight : 0;
      pixels.carried += role == SegmentRole::Kind::carried || role == SegmentRole::Kind::carrier ? weight : 0;
    }
  }
  for (const FragmentId fragment : in_view_)
    table.addSupportPixels(fragment, std::exchange(pixels_[fragment.value], {}));
}

}  // namespace scantrove
