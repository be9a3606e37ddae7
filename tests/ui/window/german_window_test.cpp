#include <QAbstractButton>
#include <QAction>
#include <QApplication>
#include <QCheckBox>
#include <QDialog>
#include <QLabel>
#include <QMenu>
#include <QMenuBar>
#include <QPushButton>
#include <QRadioButton>
#include <QScrollArea>
#include <QToolButton>
#include <map>

#include "tests/ui/window/window_fixture.h"
#include "ui/language/window_language.h"
#include "ui/main_window/main_actions.h"
#include "ui/main_window/window_dialogs.h"
#include "ui/panels/camera_dialog.h"
#include "ui/panels/class_dialog.h"
#include "ui/panels/elided_label.h"
#include "ui/panels/export_dialog.h"
#include "ui/panels/help_dialog.h"
#include "ui/panels/message_bar.h"
#include "ui/panels/server_dialog.h"
#include "ui/panels/source_dialog.h"

namespace scantrove {
namespace {

using test::WindowTest;

constexpr QSize kSmallScreen(1366, 768);
constexpr int kRoomForTitleBar_px = 40;

class GermanWindowTest : public WindowTest {
 protected:
  const WindowLanguage german_{LanguageChoice::german};
};

/// "z" for "&Zoom"; nothing without a mark.
QString acceleratorOf(const QString& text) {
  for (qsizetype i = 0; i + 1 < text.size(); ++i) {
    if (text[i] != QLatin1Char('&')) continue;
    if (text[i + 1] != QLatin1Char('&')) return text.mid(i + 1, 1).toLower();
    ++i;
  }
  return {};
}

void expectDifferentAccelerators(const QString& where, const QList<QAction*>& actions) {
  std::map<QString, QString> texts;
  for (const QAction* action : actions) {
    const QString key = acceleratorOf(action->text());
    if (key.isEmpty() || !action->isVisible()) continue;
    const auto [known, is_new] = texts.emplace(key, action->text());
    EXPECT_TRUE(is_new) << where.toStdString() << ": " << known->second.toStdString() << ", "
                        << action->text().toStdString();
  }
}

void expectDifferentAccelerators(const MainWindow& window) {
  expectDifferentAccelerators(QStringLiteral("menu bar"), window.menuBar()->actions());
  int menus = 0;
  for (const QMenu* menu : window.menuBar()->findChildren<QMenu*>()) {
    ++menus;
    expectDifferentAccelerators(menu->title(), menu->actions());
  }
  EXPECT_GT(menus, 8);
}

bool hasRoom(const QLabel& label) {
  if (label.text().isEmpty() || dynamic_cast<const ElidedLabel*>(&label) != nullptr) return true;
  if (label.wordWrap()) return label.height() >= label.heightForWidth(label.width());
  return label.width() >= label.sizeHint().width();
}

bool hasRoom(const QAbstractButton& button) {
  const bool shows_text = qobject_cast<const QPushButton*>(&button) != nullptr ||
                          qobject_cast<const QCheckBox*>(&button) != nullptr ||
                          qobject_cast<const QRadioButton*>(&button) != nullptr;
  return !shows_text || button.text().isEmpty() || button.width() >= button.sizeHint().width();
}

/// All visible texts of `window` have their full size, also what scrolls vertically.
void expectNothingCutOff(const QWidget& window) {
  const std::string title = window.windowTitle().toStdString();
  int texts = 0;
  for (const QLabel* label : window.findChildren<QLabel*>()) {
    if (!label->isVisible()) continue;
    ++texts;
    EXPECT_TRUE(hasRoom(*label)) << title << ": " << label->text().toStdString();
  }
  for (const QAbstractButton* button : window.findChildren<QAbstractButton*>()) {
    if (!button->isVisible()) continue;
    ++texts;
    EXPECT_TRUE(hasRoom(*button)) << title << ": " << button->text().toStdString();
  }
  for (const QScrollArea* scroll : window.findChildren<QScrollArea*>()) {
    if (!scroll->isVisible() || scroll->widget() == nullptr) continue;
    if (scroll->horizontalScrollBarPolicy() != Qt::ScrollBarAlwaysOff) continue;
    EXPECT_GE(scroll->viewport()->width(), scroll->widget()->minimumSizeHint().width()) << title;
  }
  EXPECT_GT(texts, 0) << title;
}

void expectDialogFits(QDialog& dialog) {
  dialog.show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(&dialog));
  dialog.resize(dialog.size().boundedTo(kSmallScreen - QSize(0, kRoomForTitleBar_px)));
  QApplication::processEvents();
  EXPECT_LE(dialog.minimumSizeHint().width(), kSmallScreen.width());
  EXPECT_LE(dialog.minimumSizeHint().height(), kSmallScreen.height() - kRoomForTitleBar_px);
  expectNothingCutOff(dialog);
}

TEST_F(WindowTest, MenusHaveDifferentAccelerators) { expectDifferentAccelerators(*window_); }

TEST_F(GermanWindowTest, MenusHaveDifferentAccelerators) {
  EXPECT_EQ(window_->menuBar()->actions().front()->text(), QStringLiteral("&Datei"));
  expectDifferentAccelerators(*window_);
}

TEST_F(GermanWindowTest, ShortcutsStayTheSame) {
  EXPECT_EQ(window_->parts().actions->export_data->shortcut(), QKeySequence(Qt::CTRL | Qt::Key_E));
  EXPECT_EQ(window_->parts().actions->pause->shortcut(), QKeySequence(Qt::Key_Space));
  EXPECT_EQ(window_->parts().actions->frame_on->shortcut(), QKeySequence(Qt::Key_PageDown));
}

TEST_F(GermanWindowTest, StartPageAndScanFitASmallScreen) {
  window_->resize(kSmallScreen);
  QApplication::processEvents();
  EXPECT_LE(window_->minimumSizeHint().width(), kSmallScreen.width());
  EXPECT_LE(window_->minimumSizeHint().height(), kSmallScreen.height());
  expectNothingCutOff(*window_);
  window_->showScene();
  QApplication::processEvents();
  EXPECT_LE(window_->minimumSizeHint().width(), kSmallScreen.width());
  EXPECT_LE(window_->minimumSizeHint().height(), kSmallScreen.height());
}

TEST_F(GermanWindowTest, DialogsCutOffNoText) {
  HelpDialog help;
  expectDialogFits(help);
  ClassDialog classes(window_->editor());
  expectDialogFits(classes);
  ExportDialog scan_export(QStringLiteral("kitchen"), nullptr);
  scan_export.setProject(QStringLiteral("rooms"), {QStringLiteral("hall"), QStringLiteral("kitchen")});
  expectDialogFits(scan_export);
  SourceDialog source{QString()};
  expectDialogFits(source);
  source.askToContinue(QStringLiteral("kitchen"));
  expectDialogFits(source);
  ServerDialog server(QStringList{});
  expectDialogFits(server);
  CameraDialog camera([] { return Result<std::vector<CameraInfo>>(std::vector<CameraInfo>{}); });
  expectDialogFits(camera);
}

TEST_F(WindowTest, LanguageMenuStoresTheChoice_AndSaysWhenItHolds) {
  const auto* menu = window_->findChild<QMenu*>(QStringLiteral("languageMenu"));
  ASSERT_NE(menu, nullptr);
  ASSERT_EQ(menu->actions().size(), 3);
  EXPECT_TRUE(menu->actions().front()->isChecked()) << "that of the desktop";
  menu->actions().last()->trigger();
  EXPECT_EQ(chosenLanguage(), LanguageChoice::german);
  EXPECT_TRUE(window_->parts().messages->text().contains(QStringLiteral("started again")));
  restart();
  EXPECT_TRUE(window_->findChild<QMenu*>(QStringLiteral("languageMenu"))->actions().last()->isChecked());
}

}  // namespace
}  // namespace scantrove
