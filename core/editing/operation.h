#pragma once
#include <Eigen/Core>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/ids.h"
#include "core/base/result.h"
#include "core/editing/frame_review.h"
#include "core/editing/mask_correction.h"

namespace scantrove {

/// A person's edit of a scan: of its regions, or a review of a key frame.
enum class OperationKind {
  name,        ///< sets the region's name and category
  accept,      ///< the same, with the program's proposal
  join,        ///< makes the regions one object, regardless of evidence
  cut,         ///< separates `here` from `there`, along folds and colour edges, regardless of evidence
  finer,       ///< splits this region as the segmentation does at a smaller k, or by colour
  coarser,     ///< joins this region with its most likely neighbour
  background,  ///< wall, floor, table: not an object; by default not in data sets
  object,      ///< an object, complete or not
  reject,      ///< not an object, and not to be proposed again
  paint,       ///< corrects the mask of the region in one image, and the regions behind it
  review,      ///< sets the review state of a key frame; concerns no region
  unpaint      ///< takes away what was painted for the region in one image; the regions behind stay
};

[[nodiscard]] std::string_view toString(OperationKind kind);
/// None if there is no such kind.
[[nodiscard]] std::optional<OperationKind> operationKindOf(std::string_view text);

/// True for name and accept.
[[nodiscard]] bool isNaming(OperationKind kind);

/// Whether an operation was done, undone or redone.
enum class EditDirection { done, undone, redone };

/// An operation as data.
struct Operation {
  OperationKind kind = OperationKind::name;
  std::vector<RegionId> regions = {};    ///< join: the first keeps its identity; cut, (un)paint: the one
  std::string name = {}, category = {};  ///< of name and accept; empty removes it
  bool on = true;                        ///< of background, object and reject; false takes it back
  std::vector<Eigen::Vector3f> here_world = {};  ///< of a cut: places on the surface, metres
  /// Of a cut: places on the other side, metres; none: what surrounds `here` in other colours.
  std::vector<Eigen::Vector3f> there_world = {};
  int frame = -1;                                 ///< number of frames scanned before it
  std::optional<MaskCorrection> correction = {};  ///< of paint; of unpaint without pixels
  std::optional<FrameReview> review = {};         ///< of review

  bool operator==(const Operation&) const = default;
};

/// The operation with names in their stored form, by the catalogue's rule. Empty names, which remove a name,
/// are valid. Error: a name is not allowed.
[[nodiscard]] Result<Operation> withCheckedNames(Operation operation);

}  // namespace scantrove
