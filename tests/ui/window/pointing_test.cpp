// Pointing at regions in the window, with real events.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QAbstractButton>
#include <QCursor>
#include <QMenu>
#include <QMessageBox>
#include <QSlider>

#include "tests/ui/window/pointing_fixture.h"
#include "ui/main_window/main_actions.h"
#include "ui/main_window/window_dialogs.h"
#include "ui/panels/export_dialog.h"
#include "ui/panels/export_sample_view.h"
#include "ui/panels/message_bar.h"
#include "ui/panels/scene_overlay.h"
#include "ui/panels/time_line.h"

namespace scantrove::test {
namespace {

TEST_F(PointingTest, HoverHighlightsARegionInAllViews_AndShowsItsName) {
  ASSERT_TRUE(QTest::qWaitFor([&] { return !pixelInScene(RegionId{7}).isNull(); }, kPatience_ms));
  ASSERT_TRUE(hoverOver(0, {0.8, 0.3}, RegionId{7}));
  EXPECT_EQ(panel(0)->tag().value(0), QStringLiteral("red cup"));
  EXPECT_TRUE(panel(0)->tag().value(1).contains(QStringLiteral("cup")));
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_FALSE(panel(i)->highlight().isNull()) << i;
    EXPECT_GT(qAlpha(panel(i)->highlight().pixel(250, 100)), 0) << i;
    EXPECT_EQ(qAlpha(panel(i)->highlight().pixel(50, 100)), 0) << i;
  }
  EXPECT_FALSE(window_->parts().scene->overlay()->highlight().isNull()) << "the 3D view";
}

TEST_F(PointingTest, SceneClicksSelectRegions_AsInThePictures) {
  view()->fitAll();
  ASSERT_TRUE(QTest::qWaitFor([&] { return !pixelInScene(RegionId{5}).isNull(); }, kPatience_ms));
  QTest::mouseMove(view(), pixelInScene(RegionId{5}));
  EXPECT_TRUE(QTest::qWaitFor([&] { return selection().hovered() == RegionId{5}; }, kPatience_ms));
  QTest::mouseClick(view(), Qt::LeftButton, {}, pixelInScene(RegionId{7}));
  EXPECT_EQ(selection().selected(), std::vector{RegionId{7}});
  QTest::mouseClick(view(), Qt::LeftButton, Qt::ControlModifier, pixelInScene(RegionId{5}));
  EXPECT_EQ(selection().selected(), (std::vector{RegionId{7}, RegionId{5}}));
  const RegionPoint at = view()->at(pixelInScene(RegionId{5}));
  ASSERT_TRUE(at.point_world);
  EXPECT_NEAR(at.point_world->z(), 256.5F * 3 / 512, 0.01F);
  EXPECT_LT(at.point_world->x(), 0) << "region 5 is on the left";
  QTest::mouseClick(view(), Qt::LeftButton, {}, QPoint(3, 3));
  EXPECT_TRUE(selection().selected().empty()) << "no region there";
}

TEST_F(PointingTest, DragInTheSceneKeepsTheSelection) {
  clickPicture(0, 0.2);
  QTest::mousePress(view(), Qt::LeftButton, {}, QPoint(100, 100));
  QTest::mouseMove(view(), QPoint(160, 120));
  QTest::mouseRelease(view(), Qt::LeftButton, {}, QPoint(160, 120));
  EXPECT_EQ(selection().selected(), std::vector{RegionId{5}});
}

TEST_F(PointingTest, TypedNameIsKept_WhileFramesArrive) {
  clickPicture(0, 0.2);
  QTest::keyClick(panel(0), Qt::Key_Return);
  ASSERT_TRUE(nameField()->isVisible());
  QTest::keyClicks(nameField(), QStringLiteral("tool/ham"));
  worker_->report(twoRegions(5));
  QTest::qWait(150);
  QTest::keyClicks(nameField(), QStringLiteral("mer j"));  // J is a letter here, no shortcut
  EXPECT_EQ(nameField()->text(), QStringLiteral("tool/hammer j"));
  EXPECT_TRUE(worker_->edits.empty());
  QTest::keyClick(nameField(), Qt::Key_Return);
  ASSERT_NE(lastOperation(), nullptr);
  EXPECT_EQ(lastOperation()->kind, OperationKind::name);
  EXPECT_EQ(lastOperation()->regions, std::vector{RegionId{5}});
  EXPECT_EQ(lastOperation()->name, "hammer j");
  EXPECT_EQ(lastOperation()->category, "tool");
  EXPECT_FALSE(nameField()->isVisible());
  // The digit 1 gives the newest name: here to another thing.
  clickPicture(0, 0.8);
  QTest::keyClick(panel(0), Qt::Key_1);
  EXPECT_EQ(worker_->edits.size(), 1U) << "region 5 has the name";
  QTest::keyClick(nameField(), Qt::Key_Return);
  EXPECT_EQ(worker_->edits.size(), 2U);
  EXPECT_EQ(lastOperation()->name, "hammer j 2");
  EXPECT_EQ(lastOperation()->regions, std::vector{RegionId{7}});
}

TEST_F(PointingTest, EscapeCancelsANaming) {
  QTest::mouseDClick(panel(0), Qt::LeftButton, {}, panel(0)->positionOf({0.8, 0.3}).toPoint());
  ASSERT_TRUE(nameField()->isVisible());
  EXPECT_EQ(nameField()->text(), QStringLiteral("cup/red cup"));
  QTest::keyClicks(nameField(), QStringLiteral("xy"));
  QTest::keyClick(nameField(), Qt::Key_Escape);
  EXPECT_FALSE(nameField()->isVisible());
  EXPECT_TRUE(worker_->edits.empty());
}

TEST_F(PointingTest, KeysEditTheSelectedRegions) {
  clickPicture(0, 0.2);
  clickPicture(0, 0.8, Qt::ControlModifier);
  const std::vector both{RegionId{5}, RegionId{7}};
  for (const auto& [key, kind] :
       {std::pair(Qt::Key_J, OperationKind::join), std::pair(Qt::Key_B, OperationKind::background),
        std::pair(Qt::Key_O, OperationKind::object), std::pair(Qt::Key_Delete, OperationKind::reject)}) {
    worker_->edits.clear();
    QTest::keyClick(panel(0), key);
    ASSERT_EQ(worker_->edits.size(), 1U) << toString(kind);
    EXPECT_EQ(lastOperation()->kind, kind);
    EXPECT_THAT(lastOperation()->regions, testing::UnorderedElementsAreArray(both));
  }
  clickPicture(0, 0.2);
  for (const auto& [key, kind] :
       {std::pair(Qt::Key_Plus, OperationKind::finer), std::pair(Qt::Key_Minus, OperationKind::coarser)}) {
    QTest::keyClick(panel(0), key);
    EXPECT_EQ(lastOperation()->kind, kind);
    EXPECT_EQ(lastOperation()->regions, std::vector{RegionId{5}});
  }
}

TEST_F(PointingTest, TwoClicksCutARegion_AndEscapeUndoesIt) {
  QTest::keyClick(panel(0), Qt::Key_C);
  EXPECT_FALSE(window_->parts().scene->overlay()->hint().isEmpty());
  clickPicture(0, 0.1);
  clickPicture(0, 0.8);
  EXPECT_TRUE(worker_->edits.empty()) << "the clicks are in two regions";
  ASSERT_TRUE(QTest::qWaitFor([&] { return window_->parts().messages->isVisible(); }, kPatience_ms));
  clickPicture(0, 0.4);
  ASSERT_NE(lastOperation(), nullptr);
  EXPECT_EQ(lastOperation()->kind, OperationKind::cut);
  ASSERT_EQ(lastOperation()->here_world.size(), 1U);
  ASSERT_EQ(lastOperation()->there_world.size(), 1U);
  // x = (u - 160) * 1.5 / 290 at u = 0.1 and 0.4 of 320 pixels
  EXPECT_NEAR(lastOperation()->here_world[0].x(), (32 - 160) * 1.5 / 290, 0.01);
  EXPECT_NEAR(lastOperation()->there_world[0].x(), (128 - 160) * 1.5 / 290, 0.01);
  worker_->storeEdit({RegionId{5}, RegionId{9}});
  ASSERT_TRUE(QTest::qWaitFor([&] { return selection().selected().size() == 2; }, kPatience_ms));
  QTest::keyClick(panel(0), Qt::Key_Escape);
  ASSERT_EQ(worker_->edits.size(), 2U);
  EXPECT_TRUE(std::holds_alternative<UndoEdit>(worker_->edits.back()));
}

TEST_F(PointingTest, CtrlZAndCtrlYUndoAndRedoAnEdit) {
  clickPicture(0, 0.2);
  QTest::keyClick(panel(0), Qt::Key_B);
  EXPECT_EQ(window_->history().stack().undoText(), QStringLiteral("Region 5: background"));
  QTest::keyClick(window_.get(), Qt::Key_Z, Qt::ControlModifier);
  ASSERT_EQ(worker_->edits.size(), 2U);
  EXPECT_TRUE(std::holds_alternative<UndoEdit>(worker_->edits[1]));
  QTest::keyClick(window_.get(), Qt::Key_Y, Qt::ControlModifier);
  ASSERT_EQ(worker_->edits.size(), 3U);
  EXPECT_TRUE(std::holds_alternative<RedoEdit>(worker_->edits[2]));
}

TEST_F(PointingTest, UndoIsChronological_WhateverHasTheFocus) {
  clickPicture(0, 0.2);
  QTest::keyClick(panel(0), Qt::Key_B);
  ASSERT_TRUE(window_->editor().rename(objects_[1], QStringLiteral("cup")));
  QTest::keyClick(panel(0), Qt::Key_O);
  EXPECT_EQ(window_->parts().actions->undo->text(), QStringLiteral("Undo Region 5: an object"));
  list()->setFocus();
  QTest::keyClick(window_.get(), Qt::Key_Z, Qt::ControlModifier);
  ASSERT_EQ(worker_->edits.size(), 3U);
  EXPECT_TRUE(std::holds_alternative<UndoEdit>(worker_->edits.back()));
  EXPECT_EQ(stored(objects_[1]).name, "cup");
  panel(0)->setFocus();
  EXPECT_EQ(window_->parts().actions->undo->text(), QStringLiteral("Undo Rename “Obj_2” to “cup”"));
  QTest::keyClick(window_.get(), Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(stored(objects_[1]).name, "Obj_2");
  EXPECT_EQ(worker_->edits.size(), 3U);
  QTest::keyClick(window_.get(), Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(worker_->edits.size(), 4U);
  EXPECT_FALSE(window_->parts().actions->undo->isEnabled());
  EXPECT_EQ(window_->parts().actions->redo->text(), QStringLiteral("Redo Region 5: background"));
}

TEST_F(PointingTest, NewScanKeepsCatalogueStepsOnly) {
  ASSERT_TRUE(window_->editor().rename(objects_[1], QStringLiteral("cup")));
  clickPicture(0, 0.2);
  QTest::keyClick(panel(0), Qt::Key_B);
  window_->open(QStringLiteral("demo"));
  EXPECT_EQ(window_->history().stack().undoText(), QStringLiteral("Rename “Obj_2” to “cup”"));
  EXPECT_EQ(window_->history().stack().count(), 1);
}

/// The open question about a background region; null: none.
QMessageBox* questionOf(const QWidget& window) {
  return window.findChild<QMessageBox*>(QStringLiteral("backgroundQuestion"));
}

void answer(const QMessageBox& question, bool yes) {
  for (QAbstractButton* button : question.buttons()) {
    if ((question.buttonRole(button) == QMessageBox::AcceptRole) == yes) {
      QTest::mouseClick(button, Qt::LeftButton);
      return;
    }
  }
}

class BackgroundTest : public PointingTest {
 protected:
  void SetUp() override {
    PointingTest::SetUp();
    ScanSnapshot snapshot = twoRegions(5);
    RegionInfos infos = *snapshot.region_infos;
    infos[0].note.background = true;  // region 5
    snapshot.region_infos = std::make_shared<const RegionInfos>(std::move(infos));
    worker_->report(std::move(snapshot));
    ASSERT_TRUE(QTest::qWaitFor([&] { return !selection().background().empty(); }, kPatience_ms));
  }
};

TEST_F(BackgroundTest, JoinAsksFirst) {
  clickPicture(0, 0.2);
  clickPicture(0, 0.8, Qt::ControlModifier);
  QTest::keyClick(panel(0), Qt::Key_J);
  EXPECT_TRUE(worker_->edits.empty());
  ASSERT_NE(questionOf(*window_), nullptr);
  EXPECT_TRUE(questionOf(*window_)->text().startsWith(QStringLiteral("Region 5 is background")));
  answer(*questionOf(*window_), false);
  EXPECT_TRUE(worker_->edits.empty());
  QTest::keyClick(panel(0), Qt::Key_J);
  answer(*questionOf(*window_), true);
  ASSERT_NE(lastOperation(), nullptr);
  EXPECT_EQ(lastOperation()->kind, OperationKind::join);
  EXPECT_EQ(lastOperation()->regions, (std::vector{RegionId{7}, RegionId{5}}))
      << "the named region comes first and keeps its name";
}

TEST_F(PointingTest, JoinOfOneRegionSaysHowToJoin) {
  clickPicture(0, 0.2);
  QTest::keyClick(panel(0), Qt::Key_J);
  EXPECT_TRUE(worker_->edits.empty());
  EXPECT_TRUE(window_->parts().messages->text().contains(QStringLiteral("Ctrl+click")));
}

TEST_F(BackgroundTest, NamingAsksFirst) {
  clickPicture(0, 0.2);
  const auto giveName = [this] {
    QTest::keyClick(panel(0), Qt::Key_Return);
    QTest::keyClicks(nameField(), QStringLiteral("magazine"));
    QTest::keyClick(nameField(), Qt::Key_Return);
  };
  giveName();
  EXPECT_TRUE(worker_->edits.empty());
  ASSERT_NE(questionOf(*window_), nullptr);
  answer(*questionOf(*window_), true);
  ASSERT_EQ(worker_->edits.size(), 2U);
  const auto& first = std::get<Operation>(worker_->edits[0]);
  EXPECT_EQ(first.kind, OperationKind::background);
  EXPECT_FALSE(first.on);
  EXPECT_EQ(lastOperation()->kind, OperationKind::name);
  EXPECT_EQ(lastOperation()->name, "magazine");
}

TEST_F(BackgroundTest, QuestionCloses_WithItsScan) {
  clickPicture(0, 0.2);
  clickPicture(0, 0.8, Qt::ControlModifier);
  QTest::keyClick(panel(0), Qt::Key_J);
  ASSERT_NE(questionOf(*window_), nullptr);
  window_->closeScan();
  EXPECT_EQ(questionOf(*window_), nullptr);
  EXPECT_TRUE(worker_->edits.empty());
}

TEST_F(PointingTest, FailedEditIsReported_AndIsNoUndoStep) {
  clickPicture(0, 0.2);
  QTest::keyClick(panel(0), Qt::Key_Plus);
  worker_->report(EditFailed{worker_->edits.back(), {"Region 5 has no parts.", ""}});
  ASSERT_TRUE(QTest::qWaitFor([&] { return window_->parts().messages->isVisible(); }, kPatience_ms));
  EXPECT_EQ(window_->parts().messages->text(), QStringLiteral("Region 5 has no parts."));
  EXPECT_FALSE(window_->history().stack().canUndo());
  EXPECT_EQ(worker_->edits.size(), 1U) << "no undo is sent to the scan";
}

TEST_F(PointingTest, TabSelectsTheNextRegion_AndEscapeDeselects) {
  panel(0)->setFocus();
  QTest::keyClick(panel(0), Qt::Key_Tab);
  EXPECT_EQ(selection().selected(), std::vector{RegionId{5}});
  QTest::keyClick(panel(0), Qt::Key_Tab);
  EXPECT_EQ(selection().selected(), std::vector{RegionId{7}});
  QTest::keyClick(panel(0), Qt::Key_Escape);
  EXPECT_TRUE(selection().selected().empty());
}

TEST_F(PointingTest, RightClickOpensTheRegionMenu) {
  ASSERT_TRUE(hoverOver(0, {0.8, 0.3}, RegionId{7}));
  const QPoint place = panel(0)->positionOf({0.8, 0.3}).toPoint();
  QContextMenuEvent event(QContextMenuEvent::Mouse, place, panel(0)->mapToGlobal(place));
  QApplication::sendEvent(panel(0), &event);
  auto* menu = window_->findChild<QMenu*>(QStringLiteral("regionMenu"));
  ASSERT_NE(menu, nullptr);
  EXPECT_TRUE(menu->actions().contains(window_->regions().actions().cut));
  EXPECT_EQ(selection().selected(), std::vector{RegionId{7}});
  menu->close();
}

TEST_F(PointingTest, EndedScanShowsKeyFrames_AndExportsADataSet) {
  EXPECT_FALSE(window_->parts().actions->export_data->isEnabled());
  worker_->finish();
  ScanSnapshot snapshot = twoRegions(90);
  snapshot.state = ScanState::finished;
  snapshot.key_frames = std::make_shared<const std::vector<int>>(std::vector{0, 30, 90});
  snapshot.shown_key_frame = 2;
  worker_->report(std::move(snapshot));
  worker_->report(ReviewOpened{});
  ASSERT_TRUE(QTest::qWaitFor([&] { return window_->parts().time_line->isVisible(); }, kPatience_ms));
  EXPECT_TRUE(window_->parts().time_line->text().contains(QStringLiteral("frame 90")));
  QTest::keyClick(window_.get(), Qt::Key_PageUp);
  EXPECT_EQ(worker_->key_frames_shown, std::vector{1});
  EXPECT_TRUE(window_->parts().time_line->text().contains(QStringLiteral("frame 30")));
  ASSERT_TRUE(
      QTest::qWaitFor([&] { return window_->parts().actions->export_data->isEnabled(); }, kPatience_ms));
  window_->parts().actions->export_data->trigger();
  ASSERT_NE(window_->dialogs().exportDialog(), nullptr);
  ASSERT_TRUE(QTest::qWaitFor([&] { return !worker_->previews.empty(); }, kPatience_ms));
  worker_->report(ExportPreviewed{{.images = 12, .regions = 3, .megabytes = 40, .classes = {}}});
  ASSERT_TRUE(QTest::qWaitFor(
      [&] { return window_->dialogs().exportDialog()->message().contains(QStringLiteral("12 images")); },
      kPatience_ms));
  // The dialog shows a sample, and the page keys change it.
  ASSERT_FALSE(worker_->samples.empty());
  EXPECT_FALSE(worker_->samples.back().second) << "the worker chooses the first sample";
  ExportSample sample;
  sample.index = 1;
  sample.count = 3;
  sample.frame = 30;
  sample.masks = 2;
  sample.picture = cv::Mat(240, 320, CV_8UC3, cv::Scalar(40, 80, 120));
  worker_->report(ExportSampled{sample});
  const ExportSampleView* const shown = window_->dialogs().exportDialog()->sampleView();
  ASSERT_TRUE(QTest::qWaitFor([&] { return shown->hasPicture(); }, kPatience_ms));
  EXPECT_TRUE(shown->caption().contains(QStringLiteral("2 of 3")));
  QTest::keyClick(window_->dialogs().exportDialog(), Qt::Key_PageDown);
  EXPECT_EQ(worker_->samples.back().second, 2);
  QTest::keyClick(window_->dialogs().exportDialog(), Qt::Key_PageDown);
  QTest::keyClick(window_->dialogs().exportDialog(), Qt::Key_PageUp);
  EXPECT_EQ(worker_->samples.back().second, 1) << "three samples only";
  window_->dialogs().exportDialog()->begin();
  ASSERT_EQ(worker_->exports.size(), 1U);
  EXPECT_FALSE(worker_->exports[0].folder.empty());
  worker_->report(ExportFailed{{"The disk is full.", ""}});
  ASSERT_TRUE(QTest::qWaitFor(
      [&] { return window_->dialogs().exportDialog()->message() == QStringLiteral("The disk is full."); },
      kPatience_ms));
}

TEST_F(PointingTest, ScansOfTheWindowAreSaved) {
  EXPECT_TRUE(worker_->last_request.output_folder.has_value());
  EXPECT_TRUE(worker_->last_request.review);
  EXPECT_FALSE(worker_->last_request.results);
}

}  // namespace
}  // namespace scantrove::test
