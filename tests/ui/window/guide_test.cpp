#include "ui/main_window/guide_opener.h"

#include <QAction>
#include <QDesktopServices>
#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QTemporaryDir>
#include <QTextBrowser>
#include <QUrl>

#include "tests/ui/window/window_fixture.h"
#include "ui/panels/message_bar.h"

namespace scantrove::test {
namespace {

/// Takes the place of the user's browser: a widget that has a slot for an address.
class GuideReader {
 public:
  GuideReader() { QDesktopServices::setUrlHandler(QStringLiteral("file"), &browser_, "setSource"); }
  ~GuideReader() { QDesktopServices::unsetUrlHandler(QStringLiteral("file")); }
  GuideReader(const GuideReader&) = delete;
  GuideReader& operator=(const GuideReader&) = delete;
  [[nodiscard]] QUrl page() const { return browser_.source(); }

 private:
  QTextBrowser browser_;
};

class GuideTest : public WindowTest {
 protected:
  /// Makes a folder for the program and a page at `place` beside it; returns the folder.
  QString programWithPage(const QString& program, const QString& place) {
    EXPECT_TRUE(QDir(tree_.path()).mkpath(program));
    const QString page = tree_.filePath(place);
    EXPECT_TRUE(QDir().mkpath(QFileInfo(page).path()));
    QFile file(page);
    EXPECT_TRUE(file.open(QIODevice::WriteOnly));
    file.write("<p>Guide</p>");
    return tree_.filePath(program);
  }
  GuideOpener& opener() { return *window_->findChild<GuideOpener*>(); }

  QTemporaryDir tree_;
};

TEST_F(GuideTest, IsFoundBesideAnInstalledProgram) {
  const QString place = QStringLiteral("usr/share/doc/scantrove/guide/index.html");
  const QString program = programWithPage(QStringLiteral("usr/bin"), place);
  EXPECT_EQ(guidePage(program), tree_.filePath(place));
}

TEST_F(GuideTest, IsFoundBesideABuiltProgram) {
  const QString place = QStringLiteral("build/guide/index.html");
  const QString program = programWithPage(QStringLiteral("build/release/app"), place);
  EXPECT_EQ(guidePage(program), tree_.filePath(place));
}

TEST_F(GuideTest, OpensAsAFile) {
  GuideReader reader;
  const QString place = QStringLiteral("a b/share/doc/scantrove/guide/index.html");
  opener().open(programWithPage(QStringLiteral("a b/bin"), place));
  EXPECT_TRUE(reader.page().isLocalFile());
  EXPECT_EQ(reader.page().toLocalFile(), tree_.filePath(place));
  EXPECT_EQ(window_->parts().messages->text(), QString());
}

TEST_F(GuideTest, SaysWhereItIs_WhenItIsNotInstalled) {
  GuideReader reader;
  opener().open(tree_.filePath(QStringLiteral("bin")));
  EXPECT_TRUE(reader.page().isEmpty());
  EXPECT_TRUE(window_->parts().messages->text().contains(QStringLiteral("docs/guide/index.md")));
}

TEST_F(GuideTest, HasAKeyOfItsOwn) {
  EXPECT_EQ(opener().action()->shortcut(), QKeySequence(Qt::CTRL | Qt::Key_F1));
}

}  // namespace
}  // namespace scantrove::test
