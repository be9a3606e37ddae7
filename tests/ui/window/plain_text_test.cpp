// Names that look like HTML are shown as they were typed.
#include "ui/models/plain_text.h"

#include <gtest/gtest.h>

#include <QAction>
#include <QLabel>
#include <QTextDocument>

#include "tests/ui/window/window_fixture.h"
#include "ui/models/catalogue_editor.h"

namespace scantrove::test {
namespace {

TEST(PlainTip, ShowsATagAsText) {
  QTextDocument shown;
  shown.setHtml(plainTip(QStringLiteral("Open <b>mug</b> & cup")));
  EXPECT_EQ(shown.toPlainText(), QStringLiteral("Open <b>mug</b> & cup"));
}

TEST(PlainTip, LeavesOtherTextsAlone) {
  EXPECT_EQ(plainTip(QStringLiteral("cups & 3 < 4")), QStringLiteral("cups & 3 < 4"));
}

class PlainTextTest : public WindowTest {
 protected:
  /// Whether Qt would draw the tag in `text` rather than show it.
  static bool hidesTag(const QString& text) {
    return text.contains(QStringLiteral("<i>mug</i>")) && Qt::mightBeRichText(text);
  }
};

TEST_F(PlainTextTest, NoLabelOrTooltipHidesATagInAName) {
  const ObjectId object{list()->model()->index(0, 0).data(ObjectListModel::ObjectIdRole).toUInt()};
  ASSERT_TRUE(window_->editor().rename(object, QStringLiteral("<i>mug</i>")));
  clickOn(object);
  QTest::qWait(50);
  int named = 0;
  for (const QLabel* label : window_->findChildren<QLabel*>()) {
    const bool is_rich = label->textFormat() != Qt::PlainText;
    EXPECT_FALSE(is_rich && hidesTag(label->text())) << label->text().toStdString();
  }
  for (const QWidget* widget : window_->findChildren<QWidget*>())
    EXPECT_FALSE(hidesTag(widget->toolTip())) << widget->toolTip().toStdString();
  for (const QAction* action : window_->findChildren<QAction*>()) {
    EXPECT_FALSE(hidesTag(action->toolTip())) << action->toolTip().toStdString();
    named += action->text().contains(QStringLiteral("mug")) ? 1 : 0;
  }
  EXPECT_GT(named, 0) << "the undo step has the name";
  EXPECT_FALSE(hidesTag(list()->model()->index(0, 0).data(Qt::ToolTipRole).toString()));
}

}  // namespace
}  // namespace scantrove::test
