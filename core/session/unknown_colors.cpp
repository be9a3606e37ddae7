#include "core/session/unknown_colors.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <map>

namespace scantrove {
namespace {

/// Edges of the mesh from a known colour; farther away it says nothing.
constexpr int kFarthest_edges = 64;

struct ColorSum {
  std::array<int, 3> rgb{};
  int count = 0;

  void add(const std::array<std::uint8_t, 3>& color) {
    for (std::size_t i = 0; i < rgb.size(); ++i) rgb[i] += color[i];
    ++count;
  }
  [[nodiscard]] std::array<std::uint8_t, 3> mean() const {
    std::array<std::uint8_t, 3> color{};
    for (std::size_t i = 0; i < rgb.size(); ++i)
      color[i] = static_cast<std::uint8_t>((rgb[i] + count / 2) / count);
    return color;
  }
};

}  // namespace

void fillUnknownColors(LabeledMesh& mesh, std::vector<bool> is_known) {
  if (std::find(is_known.begin(), is_known.end(), true) == is_known.end()) return;
  const auto isOpen = [&](const std::array<std::uint32_t, 3>& face) {
    return !std::ranges::all_of(face, [&](std::uint32_t vertex) { return is_known[vertex]; });
  };
  std::vector<std::array<std::uint32_t, 3>> open;
  std::ranges::copy_if(mesh.faces, std::back_inserter(open), isOpen);
  for (int edges = 0; edges < kFarthest_edges && !open.empty(); ++edges) {
    std::map<std::uint32_t, ColorSum> found;
    for (const auto& face : open) {
      for (const std::uint32_t unknown : face) {
        if (is_known[unknown]) continue;
        for (const std::uint32_t other : face) {
          if (is_known[other]) found[unknown].add(mesh.vertices[other].rgb);
        }
      }
    }
    if (found.empty()) break;
    for (const auto& [vertex, sum] : found) {
      mesh.vertices[vertex].rgb = sum.mean();
      is_known[vertex] = true;
    }
    std::erase_if(open, [&](const auto& face) { return !isOpen(face); });
  }
  for (std::size_t vertex = 0; vertex < mesh.vertices.size(); ++vertex) {
    if (!is_known[vertex]) mesh.vertices[vertex].rgb = kUnknownColor;
  }
}

}  // namespace scantrove
