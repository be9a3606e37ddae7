#include "ui/panels/export_dialog.h"

#include <gtest/gtest.h>

#include <QComboBox>
#include <QLineEdit>
#include <QListWidget>
#include <QPushButton>
#include <QRadioButton>
#include <QSpinBox>
#include <QTableWidget>
#include <QTest>
#include <optional>
#include <vector>

#include "ui/panels/export_scans_panel.h"

namespace scantrove {
namespace {

/// A dialog for a scan of a project with three, and what it posts.
class ExportDialogTest : public testing::Test {
 protected:
  ExportDialogTest() {
    QObject::connect(&dialog_, &ExportDialog::posted, &dialog_,
                     [this](const ScanCommand& command) { posted_.push_back(command); });
    dialog_.setProject(QStringLiteral("rooms"),
                       {QStringLiteral("hall"), QStringLiteral("kitchen"), QStringLiteral("office")});
  }

  template <class Widget>
  Widget* called(const char* name) const {
    for (Widget* widget : dialog_.findChildren<Widget*>()) {
      if (widget->accessibleName() == QLatin1String(name)) return widget;
    }
    ADD_FAILURE() << "no " << name;
    return nullptr;
  }
  QComboBox& format() const { return *called<QComboBox>("Format"); }
  QLineEdit& folder() const { return *called<QLineEdit>("Folder"); }
  void chooseProject() const { dialog_.findChildren<QRadioButton*>().last()->setChecked(true); }
  /// The last command of this type.
  template <class Command>
  std::optional<Command> last() const {
    for (auto command = posted_.rbegin(); command != posted_.rend(); ++command) {
      if (const auto* found = std::get_if<Command>(&*command)) return *found;
    }
    return std::nullopt;
  }

  ExportDialog dialog_{QStringLiteral("kitchen"), nullptr};
  std::vector<ScanCommand> posted_;
};

TEST_F(ExportDialogTest, ProposesAFolderForEachFormat) {
  format().setCurrentIndex(format().findText(QStringLiteral("COCO")));
  EXPECT_TRUE(folder().text().endsWith(QStringLiteral("kitchen-coco"))) << folder().text().toStdString();
  format().setCurrentIndex(format().findText(QStringLiteral("YOLO")));
  EXPECT_TRUE(folder().text().endsWith(QStringLiteral("kitchen-yolo")));
}

TEST_F(ExportDialogTest, KeepsATypedFolder_WhenTheFormatChanges) {
  folder().clear();
  QTest::keyClicks(&folder(), QStringLiteral("/somewhere/new"));
  format().setCurrentIndex(format().findText(QStringLiteral("VOC")));
  format().setCurrentIndex(format().findText(QStringLiteral("BOP")));
  EXPECT_EQ(dialog_.options().folder, "/somewhere/new");
}

TEST_F(ExportDialogTest, ExportsTheTickedScansOfTheProject) {
  chooseProject();
  auto* scans = called<QListWidget>("Scans");
  ASSERT_EQ(scans->count(), 3);
  scans->item(1)->setCheckState(Qt::Unchecked);
  called<QSpinBox>("validation")->setValue(30);
  called<QSpinBox>("test")->setValue(20);
  called<QSpinBox>("Draw")->setValue(7);
  dialog_.begin();
  const auto command = last<ExportProject>();
  ASSERT_TRUE(command);
  EXPECT_EQ(command->scans, (std::vector<std::string>{"hall", "office"}));
  ASSERT_TRUE(command->split.shares);
  EXPECT_DOUBLE_EQ((*command->split.shares)[0], 0.5);
  EXPECT_DOUBLE_EQ((*command->split.shares)[1], 0.3);
  EXPECT_EQ(command->split.seed, 7U);
  EXPECT_FALSE(command->options.dry_run);
  EXPECT_FALSE(last<ExportDataset>());
}

TEST_F(ExportDialogTest, SaysWhatIsMissing_WithoutScansOrWithTooLargeShares) {
  chooseProject();
  called<QSpinBox>("validation")->setValue(60);
  called<QSpinBox>("test")->setValue(60);
  dialog_.begin();
  EXPECT_FALSE(dialog_.isWorking());
  EXPECT_FALSE(dialog_.message().isEmpty());
  called<QSpinBox>("test")->setValue(0);
  auto* scans = called<QListWidget>("Scans");
  for (int row = 0; row < scans->count(); ++row) scans->item(row)->setCheckState(Qt::Unchecked);
  dialog_.begin();
  EXPECT_FALSE(dialog_.isWorking());
  EXPECT_FALSE(last<ExportProject>());
}

TEST_F(ExportDialogTest, AppliesTheChoicesOfLabels) {
  ExportPreview preview;
  preview.classes = {"cup", "plate"};
  dialog_.handleEvent(ExportPreviewed{preview});
  called<QListWidget>("Classes")->item(1)->setCheckState(Qt::Checked);
  called<QComboBox>("Labels")->setCurrentIndex(2);
  called<QComboBox>("Objects without a label")->setCurrentIndex(1);
  called<QSpinBox>("Validation")->setValue(35);
  const ExportChoices choices = dialog_.options().choices;
  EXPECT_EQ(choices.classes, std::vector<std::string>{"plate"});
  EXPECT_EQ(choices.labels, ExportedLabels::confirmed);
  EXPECT_EQ(choices.unlabeled, UnlabeledObjects::ignore);
  EXPECT_DOUBLE_EQ(choices.validation_share, 0.35);
  preview.classes = {"bowl", "cup", "plate"};
  dialog_.handleEvent(ExportPreviewed{preview});
  EXPECT_EQ(dialog_.options().choices.classes, std::vector<std::string>{"plate"}) << "ticks stay";
}

TEST_F(ExportDialogTest, ShowsCounts_WithoutExporting) {
  dialog_.count();
  const auto command = last<ExportDataset>();
  ASSERT_TRUE(command);
  EXPECT_TRUE(command->options.dry_run);
  EXPECT_TRUE(dialog_.isWorking());
  ExportSummary summary;
  summary.images = 4;
  summary.classes = {{"cup", 4, 6, 1200}};
  summary.splits = {{DatasetSplit::train, 1, 3, {{"cup", 3, 5, 1000}}},
                    {DatasetSplit::val, 1, 1, {{"cup", 1, 1, 200}}}};
  dialog_.handleEvent(ExportFinished{summary});
  EXPECT_FALSE(dialog_.isWorking());
  const auto* table = called<QTableWidget>("Counts of classes");
  ASSERT_EQ(table->rowCount(), 3);
  EXPECT_EQ(table->item(1, 0)->text(), QStringLiteral("val"));
  EXPECT_EQ(table->item(0, 3)->text(), QStringLiteral("5"));
  EXPECT_TRUE(dialog_.message().contains(QStringLiteral("4 images")));
}

TEST_F(ExportDialogTest, FailedPreviewEndsNoExport) {
  dialog_.handleEvent(ExportFailed{{"No image can be read.", ""}, true});
  EXPECT_EQ(dialog_.message(), QStringLiteral("No image can be read."));
  dialog_.count();
  dialog_.handleEvent(ExportFailed{{"No image can be read.", ""}, true});
  EXPECT_TRUE(dialog_.isWorking()) << "the image was asked for before";
  dialog_.handleEvent(ExportFailed{{"The disk is full.", ""}});
  EXPECT_FALSE(dialog_.isWorking());
  EXPECT_EQ(dialog_.message(), QStringLiteral("The disk is full."));
}

// A screen of 1366 x 768 at scale 2.
TEST_F(ExportDialogTest, FitsASmallScreen_WithAllItsParts) {
  chooseProject();
  ExportSummary summary;
  summary.classes = {{"cup", 4, 6, 1200}};
  dialog_.count();
  dialog_.handleEvent(ExportFinished{summary});
  EXPECT_LE(dialog_.minimumSizeHint().height(), 384 - 40);
  EXPECT_LE(dialog_.minimumSizeHint().width(), 683);
}

}  // namespace
}  // namespace scantrove
