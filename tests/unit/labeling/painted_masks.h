#pragma once
#include <utility>
#include <vector>

#include "core/labeling/mask_evidence.h"
#include "tests/unit/labeling/painted_frame.h"

namespace scantrove::test {

/// The frame's view with these regions; later ones cover earlier ones.
inline RenderedView withRegions(const PaintedFrame& frame,
                                const std::vector<std::pair<Rectangle, RegionId>>& regions) {
  RenderedView view = frame.view;
  view.regions.assign(PaintedFrame::kPixels, RegionId{});
  for (const auto& [where, region] : regions) PaintedFrame::fill(view.regions, where, region);
  return view;
}

/// The rectangle as a mask of a PaintedFrame.
inline PixelMask maskOf(const Rectangle& where) {
  PixelMask mask;
  for (int y = where.top; y <= where.bottom; ++y) {
    for (int x = where.left; x <= where.right; ++x)
      mask.push_back(static_cast<std::uint32_t>(y * PaintedFrame::kWidth + x));
  }
  return mask;
}

}  // namespace scantrove::test
