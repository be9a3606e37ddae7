#include "core/editing/operation.h"

#include <algorithm>
#include <array>
#include <utility>

#include "core/base/label_name.h"
#include "core/base/text.h"

namespace scantrove {
namespace {

using Kind = OperationKind;
constexpr std::array<std::pair<Kind, std::string_view>, 12> kKinds{{{Kind::name, "name"},
                                                                    {Kind::accept, "accept"},
                                                                    {Kind::join, "join"},
                                                                    {Kind::cut, "cut"},
                                                                    {Kind::finer, "finer"},
                                                                    {Kind::coarser, "coarser"},
                                                                    {Kind::background, "background"},
                                                                    {Kind::object, "object"},
                                                                    {Kind::reject, "reject"},
                                                                    {Kind::paint, "paint"},
                                                                    {Kind::review, "review"},
                                                                    {Kind::unpaint, "unpaint"}}};

}  // namespace

std::string_view toString(OperationKind kind) {
  return std::ranges::find(kKinds, kind, &std::pair<Kind, std::string_view>::first)->second;
}

std::optional<OperationKind> operationKindOf(std::string_view text) {
  const auto found = std::ranges::find(kKinds, text, &std::pair<Kind, std::string_view>::second);
  return found == kKinds.end() ? std::nullopt : std::optional(found->first);
}

bool isNaming(OperationKind kind) { return kind == Kind::name || kind == Kind::accept; }

Result<Operation> withCheckedNames(Operation operation) {
  if (!isNaming(operation.kind)) return operation;
  if (!trimmed(operation.name).empty()) {
    SCANTROVE_TRY(moveInto(operation.name, checkedLabelName(operation.name)));
  } else {
    operation.name.clear();
  }
  SCANTROVE_TRY(moveInto(operation.category, checkedCategoryName(operation.category)));
  return operation;
}

}  // namespace scantrove
