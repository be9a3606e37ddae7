#pragma once
#include <map>
#include <span>
#include <vector>

#include "core/base/ids.h"

namespace scantrove::reference {

/// The definition: a flood fill for each piece.
[[nodiscard]] inline std::vector<FragmentId> withoutSmallPieces(std::span<const FragmentId> image, int width,
                                                                int least_px) {
  const int pixels = static_cast<int>(image.size());
  const auto at = [&](int pixel) { return image[static_cast<std::size_t>(pixel)]; };
  std::vector<std::vector<int>> pieces;
  std::vector<bool> is_known(image.size(), false);
  std::map<FragmentId, std::size_t> largest;
  for (int first = 0; first < pixels; ++first) {
    if (is_known[static_cast<std::size_t>(first)] || !at(first)) continue;
    std::vector<int> piece{first};
    is_known[static_cast<std::size_t>(first)] = true;
    for (std::size_t i = 0; i < piece.size(); ++i) {
      const int pixel = piece[i], x = pixel % width;
      for (const int next :
           {x > 0 ? pixel - 1 : -1, x + 1 < width ? pixel + 1 : -1, pixel - width, pixel + width}) {
        if (next < 0 || next >= pixels || is_known[static_cast<std::size_t>(next)] || at(next) != at(first))
          continue;
        is_known[static_cast<std::size_t>(next)] = true;
        piece.push_back(next);
      }
    }
    largest[at(first)] = std::max(largest[at(first)], piece.size());
    pieces.push_back(piece);
  }
  std::vector<FragmentId> clean(image.begin(), image.end());
  for (const std::vector<int>& piece : pieces) {
    if (static_cast<int>(piece.size()) >= least_px || piece.size() >= largest[at(piece.front())]) continue;
    for (const int pixel : piece) clean[static_cast<std::size_t>(pixel)] = {};
  }
  return clean;
}

}  // namespace scantrove::reference
