#pragma once
#include <Eigen/Core>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/ids.h"

namespace scantrove {

/// Something that a person does to the regions of a scan.
enum class OperationKind {
  name,        ///< the region is called so, and is of that category
  accept,      ///< the same, as the program proposed
  join,        ///< the regions are one thing, whatever is seen
  cut,         ///< what lies here and what lies there are two things, whatever is seen
  finer,       ///< this region only: what the segmentation would take apart at a smaller k
  coarser,     ///< this region and the neighbour that it most likely belongs to are one
  background,  ///< wall, floor, table: not an object, left out of data sets unless asked for
  object,      ///< an object, whole or not
  reject       ///< not an object, and not to be proposed again
};

[[nodiscard]] std::string_view toString(OperationKind kind);
/// None: there is no such kind.
[[nodiscard]] std::optional<OperationKind> operationKindOf(std::string_view text);

/// name and accept.
[[nodiscard]] bool isNaming(OperationKind kind);

/// How an operation came to hold, or not to.
enum class EditDirection { done, undone, redone };

/// An operation as data: what on which regions.
struct Operation {
  OperationKind kind = OperationKind::name;
  std::vector<RegionId> regions;  ///< of a join the first keeps its identity; of a cut the one that is cut
  std::string name = {}, category = {};           ///< of name and accept; empty takes it away
  bool on = true;                                 ///< of background, object and reject: or no longer
  std::vector<Eigen::Vector3f> here_world = {};   ///< of a cut: places on the surface, metres
  std::vector<Eigen::Vector3f> there_world = {};  ///< of a cut: places that are something else
  int frame = -1;                                 ///< how many frames the scan had seen by then

  bool operator==(const Operation&) const = default;
};

}  // namespace scantrove
