#include "core/editing/operation.h"

#include <algorithm>
#include <array>
#include <utility>

namespace scantrove {
namespace {

using Kind = OperationKind;
constexpr std::array<std::pair<Kind, std::string_view>, 9> kKinds{{{Kind::name, "name"},
                                                                   {Kind::accept, "accept"},
                                                                   {Kind::join, "join"},
                                                                   {Kind::cut, "cut"},
                                                                   {Kind::finer, "finer"},
                                                                   {Kind::coarser, "coarser"},
                                                                   {Kind::background, "background"},
                                                                   {Kind::object, "object"},
                                                                   {Kind::reject, "reject"}}};

}  // namespace

std::string_view toString(OperationKind kind) {
  return std::ranges::find(kKinds, kind, &std::pair<Kind, std::string_view>::first)->second;
}

std::optional<OperationKind> operationKindOf(std::string_view text) {
  const auto found = std::ranges::find(kKinds, text, &std::pair<Kind, std::string_view>::second);
  return found == kKinds.end() ? std::nullopt : std::optional(found->first);
}

bool isNaming(OperationKind kind) { return kind == Kind::name || kind == Kind::accept; }

}  // namespace scantrove
