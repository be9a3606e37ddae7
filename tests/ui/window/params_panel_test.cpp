#include <gtest/gtest.h>

#include <QSignalSpy>
#include <QSlider>

#include "ui/panels/params_panel.h"

namespace scantrove {
namespace {

TEST(ParamsPanel, SliderChangesK_AndDefaultsRestoreIt) {
  ParamsPanel panel{ScanParams{}};
  QSignalSpy changes(&panel, &ParamsPanel::changed);
  auto* slider = panel.findChild<QSlider*>();
  slider->setValue(slider->maximum());
  EXPECT_NEAR(panel.params().segmentation.k, 10.0F, 1e-2F);
  EXPECT_EQ(changes.count(), 1);
  panel.setDefaults();
  EXPECT_EQ(panel.params().segmentation.k, ScanParams{}.segmentation.k);
  EXPECT_EQ(changes.count(), 2);
}

}  // namespace
}  // namespace scantrove
