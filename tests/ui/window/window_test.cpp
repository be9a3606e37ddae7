#include <QCheckBox>
#include <QComboBox>
#include <QCompleter>
#include <QDir>
#include <QFile>
#include <QLineEdit>
#include <QMimeData>
#include <QPushButton>
#include <algorithm>

#include "core/session/session_store.h"
#include "tests/ui/window/window_fixture.h"
#include "ui/main_window/main_actions.h"
#include "ui/main_window/recent_sources.h"
#include "ui/main_window/region_controller.h"
#include "ui/main_window/scan_controller.h"
#include "ui/main_window/scene_pane.h"
#include "ui/main_window/window_placement.h"
#include "ui/panels/color_panel.h"
#include "ui/panels/export_dialog.h"
#include "ui/panels/frame_panels.h"
#include "ui/panels/message_bar.h"
#include "ui/panels/progress_strip.h"
#include "ui/panels/proposal_bar.h"
#include "ui/panels/views_strip.h"
#include "ui/theme/theme.h"

namespace scantrove {
namespace {

using test::WindowTest;

TEST_F(WindowTest, KeysRenameAndConfirm_AndARestartKeepsBoth) {
  QTest::keyClick(window_.get(), Qt::Key_L, Qt::ControlModifier);
  ASSERT_TRUE(list()->hasFocus());
  list()->setCurrentIndex(rowOf(objects_[1]));
  QTest::keyClick(list(), Qt::Key_F2);
  ASSERT_NE(nameEditor(), nullptr);
  nameEditor()->selectAll();
  QTest::keyClicks(nameEditor(), QStringLiteral("Green cup"));
  QTest::keyClick(nameEditor(), Qt::Key_Return);
  EXPECT_EQ(stored(objects_[1]).name, "Green cup");
  EXPECT_FALSE(stored(objects_[1]).confirmed);

  QTest::keyClick(list(), Qt::Key_Return);
  EXPECT_TRUE(stored(objects_[1]).confirmed);
  EXPECT_GE(worker_->catalogue_changes, 2);

  restart();
  EXPECT_EQ(rowOf(objects_[1]).data(Qt::DisplayRole).toString(), QStringLiteral("Green cup"));
  EXPECT_TRUE(rowOf(objects_[1]).data(ObjectListModel::ConfirmedRole).toBool());
}

TEST_F(WindowTest, MouseRenamesAndConfirms) {
  clickOn(objects_[0]);
  EXPECT_EQ(window_->parts().objects->viewsStrip()->count(), 1U);
  QTest::mouseDClick(list()->viewport(), Qt::LeftButton, {}, list()->visualRect(rowOf(objects_[0])).center());
  ASSERT_NE(nameEditor(), nullptr);
  nameEditor()->selectAll();
  QTest::keyClicks(nameEditor(), QStringLiteral("Red ball"));
  QTest::keyClick(nameEditor(), Qt::Key_Return);
  pressButton(window_->parts().objects->actions().confirm);
  EXPECT_EQ(stored(objects_[0]).name, "Red ball");
  EXPECT_TRUE(stored(objects_[0]).confirmed);
}

TEST_F(WindowTest, KeysDeleteMergeAndUndo) {
  clickOn(objects_[0]);
  QTest::keyClick(list(), Qt::Key_Delete);
  EXPECT_EQ(storedCount(), 2U);
  QTest::keyClick(window_.get(), Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(storedCount(), 3U);
  clickOn(objects_[0]);
  clickOn(objects_[2], Qt::ControlModifier);
  QTest::keyClick(list(), Qt::Key_M);
  EXPECT_EQ(storedCount(), 2U);
  EXPECT_EQ(stored(objects_[0]).views, 2);
  QTest::keyClick(window_.get(), Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(storedCount(), 3U);
  QTest::keyClick(window_.get(), Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
  EXPECT_EQ(storedCount(), 2U);
}

TEST_F(WindowTest, RefusedNameIsReported_AndTheOldOneKept) {
  clickOn(objects_[1]);
  QTest::keyClick(list(), Qt::Key_F2);
  ASSERT_NE(nameEditor(), nullptr);
  nameEditor()->selectAll();
  QTest::keyClicks(nameEditor(), QStringLiteral("12"));  // a number is no name
  QTest::keyClick(nameEditor(), Qt::Key_Return);
  EXPECT_TRUE(window_->parts().messages->isVisible());
  EXPECT_EQ(stored(objects_[1]).name, "Obj_2");
}

TEST_F(WindowTest, MissingPathIsReported_AndAnotherSourceOpens) {
  window_->open(QStringLiteral("/somewhere/missing"));
  ASSERT_TRUE(QTest::qWaitFor([&] { return window_->parts().messages->isVisible(); }, 3000));
  EXPECT_TRUE(window_->parts().messages->text().contains(QStringLiteral("/somewhere/missing")));
  EXPECT_TRUE(window_->parts().messages->text().contains(QStringLiteral("Check the path.")));
  EXPECT_TRUE(window_->onStartPage());
  EXPECT_FALSE(recentSources().contains(QStringLiteral("/somewhere/missing")));
  window_->open(QStringLiteral("demo"));
  worker_->report(snapshotOf(0));
  ASSERT_TRUE(QTest::qWaitFor(
      [&] { return window_->parts().progress->text().startsWith(QStringLiteral("1 of 100")); }, 3000));
  EXPECT_FALSE(window_->onStartPage());
  EXPECT_FALSE(window_->parts().messages->isVisible());
  EXPECT_TRUE(recentSources().contains(QStringLiteral("demo")));
}

TEST_F(WindowTest, ScansAnewWithTheProposedDepthScale_WhenItsButtonIsClicked) {
  SourceOptions options;
  options.stride = 3;
  window_->controller().open(QStringLiteral("/somewhere/recording"), options);
  worker_->report(ScanAdvice{{"The median depth is 18 m.", "Give --depth-scale 10000."}, 10000});
  auto* const button = window_->parts().messages->findChild<QPushButton*>(QStringLiteral("messageButton"));
  ASSERT_NE(button, nullptr);
  ASSERT_TRUE(QTest::qWaitFor([&] { return button->isVisible(); }, 3000));
  EXPECT_EQ(button->text(), QStringLiteral("Use 10000 units per metre"));
  button->click();
  EXPECT_EQ(worker_->last_request.source, "/somewhere/recording");
  EXPECT_EQ(worker_->last_request.source_options.depth_scale, 10000);
  EXPECT_EQ(worker_->last_request.source_options.stride, 3);
  EXPECT_FALSE(window_->parts().messages->isVisible());
}

TEST_F(WindowTest, RemovesTheEmptyFolder_WhenOpeningFails) {
  const auto scans = [this] {
    return QDir(window_->controller().scansFolder()).entryList(QDir::AllEntries | QDir::NoDotAndDotDot);
  };
  const QStringList before = scans();
  window_->open(QStringLiteral("/somewhere/missing"));
  EXPECT_EQ(scans().size(), before.size() + 1) << "the folder for the scan";
  ASSERT_TRUE(QTest::qWaitFor([&] { return window_->parts().messages->isVisible(); }, 3000));
  EXPECT_EQ(scans(), before);
  window_->open(QStringLiteral("/elsewhere/missing"));
  QFile file(QString::fromStdString(worker_->last_request.output_folder->string()) +
             QStringLiteral("/notes.txt"));
  ASSERT_TRUE(file.open(QIODevice::WriteOnly));
  ASSERT_TRUE(QTest::qWaitFor([&] { return window_->parts().messages->text().contains("elsewhere"); }, 3000));
  EXPECT_TRUE(file.exists()) << "a folder with files is kept";
}

TEST_F(WindowTest, OpensASavedScan_WhenItsFolderIsGiven) {
  const QString folder = folder_.filePath(QStringLiteral("scan"));
  ASSERT_TRUE(SessionStore::create(folder.toStdString()));
  window_->open(folder + QLatin1Char('/'));
  EXPECT_EQ(worker_->last_request.source, "") << "nothing is scanned";
  EXPECT_EQ(worker_->last_request.output_folder, folder.toStdString());
}

TEST_F(WindowTest, ProposalCloses_WithItsScanAndAfterAnUndo) {
  RegionAppearance style;
  style.size_m = {0.2F, 0.1F, 0.1F};
  ColorHistogram::Shares shares{};
  shares[7] = 1;
  style.colors = ColorHistogram::ofShares(shares);
  RegionProposals& proposals = window_->regions().operations().proposals();
  const auto propose = [&] {
    proposals.propose(RegionId{1}, QStringLiteral("chair"), {}, {{RegionId{1}, style}, {RegionId{2}, style}});
    return proposals.first() != nullptr;
  };
  auto* const bar = window_->findChild<ProposalBar*>();
  window_->open(QStringLiteral("demo"));
  ASSERT_TRUE(propose());
  EXPECT_TRUE(bar->isVisible());
  worker_->report(Edited{UndoEdit{}, {}});
  EXPECT_TRUE(QTest::qWaitFor([&] { return !bar->isVisible(); }, 3000)) << "the undone step may be the name";
  ASSERT_TRUE(propose());
  window_->closeScan();
  EXPECT_FALSE(bar->isVisible());
  EXPECT_EQ(proposals.first(), nullptr);
}

TEST(WindowPlacement, IsLimitedToTheScreen) {
  const QRect screen(0, 24, 1366, 744);
  EXPECT_EQ(fittedTo({0, 0, 1480, 920}, screen), screen);
  EXPECT_EQ(fittedTo({900, 700, 800, 600}, screen), QRect(566, 168, 800, 600));
  EXPECT_EQ(fittedTo({100, 100, 800, 600}, screen), QRect(100, 100, 800, 600)) << "it fits as it is";
}

TEST_F(WindowTest, ExportDialogFitsASmallScreen) {
  ExportDialog dialog(QStringLiteral("kitchen"), window_.get());
  EXPECT_LT(dialog.minimumSizeHint().height(), 420) << "its choices scroll";
  dialog.resize(560, 420);
  dialog.show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(&dialog));
  for (const QPushButton* button : dialog.findChildren<QPushButton*>()) {
    if (!button->isVisible() || button->parentWidget() != &dialog) continue;
    EXPECT_TRUE(dialog.rect().contains(button->geometry())) << button->text().toStdString();
  }
}

TEST_F(WindowTest, ExportDialogIncludesUnfitFrames_WhenTicked) {
  const ExportDialog dialog(QStringLiteral("kitchen"), window_.get());
  EXPECT_FALSE(dialog.options().include_unfit);
  for (QCheckBox* box : dialog.findChildren<QCheckBox*>())
    box->setChecked(box->text().contains(QStringLiteral("unfit")));
  EXPECT_TRUE(dialog.options().include_unfit);
  EXPECT_FALSE(dialog.options().all_frames);
  EXPECT_FALSE(dialog.options().background);
}

TEST_F(WindowTest, ExportDialogOffersTexturesForMeshes) {
  const ExportDialog dialog(QStringLiteral("kitchen"), window_.get());
  auto* format = dialog.findChild<QComboBox*>();
  for (QCheckBox* box : dialog.findChildren<QCheckBox*>()) {
    if (!box->text().contains(QStringLiteral("Textures"))) continue;
    format->setCurrentIndex(format->findText(QStringLiteral("COCO")));
    EXPECT_TRUE(box->isHidden());
    box->setChecked(true);
    EXPECT_EQ(dialog.options().texture_size_px, 0);
    format->setCurrentIndex(format->findText(QStringLiteral("MESH")));
    EXPECT_FALSE(box->isHidden());
    EXPECT_EQ(dialog.options().texture_size_px, kMaxTexture_px);
    box->setChecked(false);
    EXPECT_EQ(dialog.options().texture_size_px, 0);
    return;
  }
  FAIL() << "no box for textures";
}

TEST_F(WindowTest, ExportDialogOffersEveryFormatAndALicense) {
  const ExportDialog dialog(QStringLiteral("kitchen"), window_.get());
  auto* format = dialog.findChild<QComboBox*>();
  ASSERT_NE(format, nullptr);
  ASSERT_EQ(format->count(), static_cast<int>(datasetFormatNames().size()));
  format->setCurrentIndex(format->findText(QStringLiteral("FOUNDATIONPOSE")));
  EXPECT_EQ(dialog.options().format, DatasetFormat::foundationpose);
  EXPECT_TRUE(dialog.options().license.empty());
  for (QLineEdit* field : dialog.findChildren<QLineEdit*>()) {
    if (field->accessibleName() == QStringLiteral("License")) field->setText(QStringLiteral(" CC BY 4.0 "));
  }
  EXPECT_EQ(dialog.options().license, "CC BY 4.0");
}

TEST_F(WindowTest, CompletionListHasTheColorsOfTheTheme) {
  for (const ThemeChoice choice : {ThemeChoice::light, ThemeChoice::dark}) {
    Theme::instance().choose(choice);
    QLineEdit field;
    QCompleter completer(QStringList{QStringLiteral("mug"), QStringLiteral("muffin")});
    field.setCompleter(&completer);
    field.show();
    completer.setCompletionPrefix(QStringLiteral("mu"));
    completer.complete();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(completer.popup()));
    const QImage shown = completer.popup()->grab().toImage();
    EXPECT_EQ(shown.pixelColor(shown.width() - 2, shown.height() - 2), Theme::instance().colors().surface)
        << static_cast<int>(choice);
  }
}

TEST_F(WindowTest, SnapshotReachesPanelsAndScene) {
  window_->open(QStringLiteral("demo"));
  ScanSnapshot snapshot = snapshotOf(4);
  CloudBrick brick{Eigen::Vector3i(0, 0, 25), 1, {}};
  for (int i = 0; i < 64; ++i) {
    brick.points.push_back(
        {0.006F * static_cast<float>(i % 8), 0.006F * static_cast<float>(i / 8), 1.18F, FragmentId{1}});
  }
  snapshot.changed_bricks.push_back(brick);
  snapshot.changed_regions = {{FragmentId{1}, RegionId{1}}};
  SeenObject seen;
  seen.object = objects_[2];
  seen.name = "Obj_3";
  seen.box = {0.4F, 0.4F, 0.2F, 0.2F};
  snapshot.objects = {seen};
  worker_->report(std::move(snapshot));
  ASSERT_TRUE(
      QTest::qWaitFor([&] { return !window_->parts().frames->colorPanel()->picture().isNull(); }, 3000));
  for (const ImagePanel* panel : window_->parts().frames->panels()) EXPECT_FALSE(panel->picture().isNull());
  EXPECT_EQ(window_->parts().scene->view()->scene().cloud().pointCount(), 64U);
  EXPECT_TRUE(rowOf(objects_[2]).data(ObjectListModel::InViewRole).toBool());
}

TEST_F(WindowTest, KeysPauseStepResumeAndStopTheScan) {
  window_->open(QStringLiteral("demo"));
  ASSERT_TRUE(QTest::qWaitFor([&] { return window_->parts().actions->pause->isEnabled(); }, 3000));
  QTest::keyClick(window_.get(), Qt::Key_Space);
  ASSERT_TRUE(QTest::qWaitFor([&] { return window_->parts().actions->start->isEnabled(); }, 3000));
  QTest::keyClick(window_.get(), Qt::Key_N);
  QTest::keyClick(window_.get(), Qt::Key_Space);
  EXPECT_EQ(worker_->commands, (std::vector<std::string>{"start", "pause", "step", "resume"}));
  ASSERT_TRUE(QTest::qWaitFor([&] { return !window_->parts().actions->start->isEnabled(); }, 3000));
  QTest::keyClick(window_.get(), Qt::Key_Period, Qt::ControlModifier);
  EXPECT_EQ(worker_->commands.back(), "stop");
  EXPECT_EQ(worker_->last_request.database, file_.toStdString());
}

TEST_F(WindowTest, ListShowsAnObject_WhenTheScanAddsIt) {
  window_->open(QStringLiteral("demo"));
  auto database = ObjectDatabase::open(file_.toStdString());
  ASSERT_TRUE(database);
  const auto added = (*database)->addObject(test::discView({0, 200, 255}));
  ASSERT_TRUE(added);
  worker_->report(ObjectAdded{added->id, added->name});
  ASSERT_TRUE(QTest::qWaitFor([&] { return rowOf(added->id).isValid(); }, 3000));
  EXPECT_TRUE(rowOf(added->id).data(ObjectListModel::AddedNowRole).toBool());
}

TEST_F(WindowTest, OpensADroppedFolder) {
  QMimeData data;
  data.setUrls({QUrl::fromLocalFile(folder_.path())});
  QDragEnterEvent enter(QPoint(300, 300), Qt::CopyAction, &data, Qt::LeftButton, {});
  QCoreApplication::sendEvent(window_.get(), &enter);
  EXPECT_TRUE(enter.isAccepted());
  QDropEvent drop(QPointF(300, 300), Qt::CopyAction, &data, Qt::LeftButton, {});
  QCoreApplication::sendEvent(window_.get(), &drop);
  EXPECT_EQ(worker_->last_request.source, folder_.path().toStdString());
}

TEST_F(WindowTest, EveryButtonHasATextForScreenReaders) {
  window_->open(QStringLiteral("demo"));
  for (const QToolButton* button : window_->findChildren<QToolButton*>()) {
    if (!button->isVisible()) continue;
    EXPECT_FALSE(button->text().isEmpty() && button->accessibleName().isEmpty() &&
                 button->toolTip().isEmpty())
        << button->objectName().toStdString();
  }
}

}  // namespace
}  // namespace scantrove
