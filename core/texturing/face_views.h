#pragma once
#include <vector>

#include "core/texturing/face_neighbors.h"
#include "core/texturing/view_ratings.h"

namespace scantrove {

/// Chooses a view for each face: a good one, and that of its neighbours, so that patches of one view are
/// large. Minimises locally, first face by face, then patch by patch, the sum of 1 - quality / best quality
/// over faces and a quarter for each edge between two views. kNoView: no view shows the face.
[[nodiscard]] std::vector<ViewNumber> chooseFaceViews(const ViewRatings& ratings,
                                                      const FaceNeighbors& neighbors);

}  // namespace scantrove
