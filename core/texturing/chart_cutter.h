#pragma once
#include <span>
#include <vector>

#include "core/texturing/face_neighbors.h"

namespace scantrove {

/// A connected patch of faces with one view.
struct TextureChart {
  ViewNumber view = kNoView;
  std::vector<std::uint32_t> faces;
  Eigen::AlignedBox2f box_px;  ///< of their corners, in the image of the view
};

struct TextureCharts {
  std::vector<TextureChart> charts;
  std::vector<std::uint32_t> without_view;  ///< faces
};

/// A surface with the choice of a view for each face.
struct ViewedSurface {
  const TextureSurface& surface;
  std::span<const TextureView> views;
  const FaceNeighbors& neighbors;
  std::vector<ViewNumber> face_views;
};

/// The charts of some `faces` of the surface. Faces of patches with fewer than `min_faces` count as faces
/// without a view.
[[nodiscard]] TextureCharts cutCharts(const ViewedSurface& viewed, std::span<const std::uint32_t> faces,
                                      std::size_t min_faces = 1);

}  // namespace scantrove
