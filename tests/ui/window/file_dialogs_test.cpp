#include <sys/inotify.h>
#include <unistd.h>

#include <QAbstractItemView>
#include <QCompleter>
#include <QFileDialog>
#include <QFileSystemModel>
#include <QLineEdit>
#include <QMainWindow>
#include <QTest>
#include <QTreeView>
#include <array>
#include <cstdlib>
#include <cstring>

#include "tests/ui/window/catalogue_fixture.h"
#include "ui/panels/file_dialogs.h"
#include "ui/theme/theme.h"

namespace scantrove {
namespace {

using FileDialogsTest = test::CatalogueTest;

/// Records the names of the files in a folder that any process opens.
class OpenedFiles {
 public:
  explicit OpenedFiles(const QString& folder) : watch_(::inotify_init1(IN_NONBLOCK)) {
    EXPECT_GE(::inotify_add_watch(watch_, folder.toLocal8Bit().constData(), IN_OPEN), 0);
  }
  OpenedFiles(const OpenedFiles&) = delete;
  OpenedFiles& operator=(const OpenedFiles&) = delete;
  ~OpenedFiles() { ::close(watch_); }

  std::vector<std::string> names() {
    std::vector<std::string> names;
    std::array<char, 4096> buffer{};
    for (ssize_t size = 0; (size = ::read(watch_, buffer.data(), buffer.size())) > 0;) {
      for (ssize_t at = 0; at < size;) {
        inotify_event event{};
        std::memcpy(&event, buffer.data() + at, sizeof(event));
        if (event.len > 0) names.emplace_back(buffer.data() + at + sizeof(event));
        at += static_cast<ssize_t>(sizeof(event) + event.len);
      }
    }
    return names;
  }

 private:
  int watch_;
};

TEST_F(FileDialogsTest, OpensNoFileOfTheShownFolder) {
  const auto in_use = ObjectDatabase::open(file_.toStdString());
  ASSERT_TRUE(in_use);
  OpenedFiles opened(folder_.path());
  const auto dialog = makeFileDialog(nullptr, QStringLiteral("Catalogue"), file_);
  dialog->setAcceptMode(QFileDialog::AcceptSave);
  dialog->show();
  const auto* model = dialog->findChild<QFileSystemModel*>();
  ASSERT_NE(model, nullptr);
  const auto typeOf = [&] { return model->type(model->index(file_)); };
  ASSERT_TRUE(QTest::qWaitFor([&] { return typeOf() == QStringLiteral("sqlite file"); }, 20000))
      << typeOf().toStdString();
  EXPECT_EQ(dialog->selectedFiles(), QStringList{file_});
  EXPECT_EQ(opened.names(), std::vector<std::string>{});
}

class CompletionListTest : public testing::TestWithParam<ThemeChoice> {};

TEST_P(CompletionListTest, TextContrastsWithAnOpaqueBackground) {
  const ThemeChoice before = Theme::instance().choice();
  Theme::instance().choose(GetParam());
  QMainWindow window;
  auto* field = new QLineEdit;
  window.setCentralWidget(field);
  auto* completer = new QCompleter(QStringList{QStringLiteral("kitchen"), QStringLiteral("kiln")}, field);
  field->setCompleter(completer);
  window.resize(400, 100);
  window.show();
  window.activateWindow();
  ASSERT_TRUE(QTest::qWaitForWindowActive(&window));
  field->setFocus();
  QTest::keyClicks(field, QStringLiteral("ki"));
  QAbstractItemView* const list = completer->popup();
  ASSERT_TRUE(QTest::qWaitFor([list] { return list->isVisible(); }, 4000));
  QTest::qWait(50);
  const QRect row = list->visualRect(list->model()->index(1, 0));
  const QImage image = list->viewport()->grab().toImage().convertToFormat(QImage::Format_ARGB32);
  const QColor background = image.pixelColor(row.right() - 4, row.center().y());
  const int text = list->palette().color(QPalette::Text).lightness();
  EXPECT_EQ(background.alpha(), 255) << "opaque";
  EXPECT_GT(std::abs(background.lightness() - text), 100);
  list->hide();
  Theme::instance().choose(before);
}

INSTANTIATE_TEST_SUITE_P(Themes, CompletionListTest, testing::Values(ThemeChoice::light, ThemeChoice::dark));

}  // namespace
}  // namespace scantrove
