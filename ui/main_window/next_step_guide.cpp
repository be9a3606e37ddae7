#include "ui/main_window/next_step_guide.h"

#include "ui/main_window/main_actions.h"
#include "ui/main_window/main_window.h"
#include "ui/main_window/region_controller.h"
#include "ui/main_window/review_controller.h"
#include "ui/main_window/scan_controller.h"
#include "ui/panels/next_step_strip.h"
#include "ui/panels/object_list_view.h"
#include "ui/panels/object_panel.h"
#include "ui/panels/time_line.h"

namespace scantrove {

NextStepGuide::NextStepGuide(MainWindow& window) : QObject(&window), window_(window) {
  ScanBridge& bridge = window_.controller().bridge();
  connect(&window_.controller(), &ScanController::opening, this, &NextStepGuide::end);
  bridge.on<ReviewOpened>(this, [this] {
    is_open_ = !window_.onStartPage();
    update();
  });
  connect(&window_.regions().selection(), &RegionSelection::infosChanged, this, &NextStepGuide::update);
  connect(&window_.parts().time_line->reviews(), &KeyFrameReviews::changed, this, &NextStepGuide::update);
  connect(window_.parts().next_steps, &NextStepStrip::requested, this, &NextStepGuide::perform,
          Qt::QueuedConnection);  // the step may replace the button that was clicked
}

void NextStepGuide::end() {
  is_open_ = false;
  window_.parts().next_steps->beginScan();
}

void NextStepGuide::update() {
  if (!is_open_) return;
  if (window_.onStartPage()) return end();
  WorkLeft work;
  work.unnamed_objects = countUnnamed(window_.regions().selection().infos());
  work.key_frames = window_.parts().time_line->reviews().counts();
  window_.parts().next_steps->showSteps(nextStepsOf(work));
}

void NextStepGuide::perform(NextStep::Kind step) {
  switch (step) {
    case NextStep::Kind::name:
      return goToUnnamed();
    case NextStep::Kind::check: {
      const FrameReview* const shown =
          window_.parts().time_line->reviews().at(window_.parts().time_line->current());
      if (shown == nullptr || shown->state != ReviewState::open) window_.parts().review->goToNextOpen();
      return;
    }
    case NextStep::Kind::export_data:
      return window_.parts().actions->export_data->trigger();
  }
}

void NextStepGuide::goToUnnamed() {
  const RegionInfo* largest = nullptr;
  for (const RegionInfo& region : window_.regions().selection().infos()) {
    if (countUnnamed({region}) > 0 && (largest == nullptr || region.voxels > largest->voxels))
      largest = &region;
  }
  if (largest == nullptr) return;
  const RegionId region = largest->region;
  const ObjectId object = largest->object;
  window_.parts().actions->focus_objects->trigger();
  const QModelIndex row = window_.model().indexOf(object);
  if (row.isValid()) window_.parts().objects->list()->setCurrentIndex(row);
  window_.regions().selection().select(region);
}

}  // namespace scantrove
