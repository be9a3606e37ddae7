#include "ui/models/next_steps.h"

#include <QCoreApplication>
#include <set>

namespace scantrove {

int countUnnamed(const RegionInfos& regions) {
  std::set<ObjectId> objects;
  int without_entry = 0;
  for (const RegionInfo& region : regions) {
    const RegionLabel label = region.label.value_or(RegionLabel{});
    const bool is_aside =
        label.background || label.rejected || region.note.background || region.note.rejected;
    if (is_aside || !region.name().empty()) continue;
    if (region.object) {
      objects.insert(region.object);
    } else if (label.is_object || region.note.object) {
      ++without_entry;
    }
  }
  return static_cast<int>(objects.size()) + without_entry;
}

std::vector<NextStep> nextStepsOf(const WorkLeft& work) {
  std::vector<NextStep> steps;
  if (work.unnamed_objects > 0) steps.push_back({NextStep::Kind::name, work.unnamed_objects});
  if (work.key_frames.open > 0) steps.push_back({NextStep::Kind::check, work.key_frames.open});
  steps.push_back({NextStep::Kind::export_data, 0});
  steps.front().is_next = true;
  return steps;
}

QString textOf(const NextStep& step) {
  switch (step.kind) {
    case NextStep::Kind::name:
      return QCoreApplication::translate("NextSteps", "Name %n found objects", nullptr, step.left);
    case NextStep::Kind::check:
      return QCoreApplication::translate("NextSteps", "Check %n key frames", nullptr, step.left);
    case NextStep::Kind::export_data:
      return QCoreApplication::translate("NextSteps", "Export data set");
  }
  return {};
}

}  // namespace scantrove
