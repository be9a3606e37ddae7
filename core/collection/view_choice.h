#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

namespace scantrove {

/// How well a view shows its object.
struct ViewQuality {
  float pixels = 0;     ///< of the object in the colour image
  float sharpness = 0;  ///< of the colour image around it (sharpnessOf); 0: unknown
  float outline = 0;    ///< Candidate::outline; 0: unknown
  float hidden = 0;     ///< Candidate::hidden
};

/// A view of an object that is stored or could be.
struct OfferedView {
  Eigen::Vector3f direction = Eigen::Vector3f::UnitZ();  ///< unit, from the object to the camera, world
  ViewQuality quality;
};

/// Angle between the views of an object. Smaller angles follow while it has fewer than kEnoughViews.
inline constexpr float kViewAngle_deg = 15;
inline constexpr std::size_t kEnoughViews = 8;

/// The indices of the best of one object's views, at most `most`, spread over directions. The first `kept`
/// views are chosen in any case. The best views are large, sharp, little hidden, and have an outline of their
/// own, compared with the object's other views. A view that lacks one of these is not chosen, unless no view
/// is better. If any eight views are kViewAngle_deg apart, and all have these, at least eight are chosen.
[[nodiscard]] std::vector<std::size_t> chooseViews(std::span<const OfferedView> views, std::size_t kept,
                                                   std::size_t most);

}  // namespace scantrove
