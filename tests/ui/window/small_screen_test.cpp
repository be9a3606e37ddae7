// A screen of 1600 x 1000 at scale 2, where 800 x 500 remain: all buttons stay in reach.
#include <gtest/gtest.h>

#include <QApplication>
#include <QSplitter>

#include "tests/ui/window/window_fixture.h"
#include "ui/main_window/object_pages.h"
#include "ui/panels/camera_dialog.h"
#include "ui/panels/class_dialog.h"
#include "ui/panels/export_dialog.h"
#include "ui/panels/help_dialog.h"
#include "ui/panels/object_page.h"
#include "ui/panels/server_dialog.h"
#include "ui/panels/source_dialog.h"

namespace scantrove::test {
namespace {

constexpr QSize kHalfScreen(800, 500);
constexpr int kTitleBar_px = 30;

void expectFitsHalfScreen(const QWidget& widget, const char* name) {
  const QSize least = widget.minimumSizeHint().expandedTo(widget.minimumSize());
  EXPECT_LE(least.width(), kHalfScreen.width()) << name;
  EXPECT_LE(least.height(), kHalfScreen.height() - kTitleBar_px) << name;
}

using SmallScreenTest = WindowTest;

TEST_F(SmallScreenTest, WindowFits) {
  expectFitsHalfScreen(*window_, "start page");
  window_->showScene();
  QApplication::processEvents();
  expectFitsHalfScreen(*window_, "scene");
}

TEST_F(SmallScreenTest, DialogsFit) {
  expectFitsHalfScreen(HelpDialog(), "help");
  expectFitsHalfScreen(ClassDialog(window_->editor()), "classes");
  ExportDialog scan_export(QStringLiteral("kitchen"), nullptr);
  scan_export.setProject(QStringLiteral("rooms"), {QStringLiteral("hall"), QStringLiteral("kitchen")});
  expectFitsHalfScreen(scan_export, "export");
  expectFitsHalfScreen(SourceDialog(QString()), "source");
  expectFitsHalfScreen(ServerDialog(QStringList{}), "server");
  const CameraDialog camera([] { return Result<std::vector<CameraInfo>>(std::vector<CameraInfo>{}); });
  expectFitsHalfScreen(camera, "camera");
  const ObjectPage page(window_->editor(), window_->model(), new QWidget);
  expectFitsHalfScreen(page, "object page");
}

}  // namespace
}  // namespace scantrove::test
