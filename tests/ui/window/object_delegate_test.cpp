#include <gtest/gtest.h>

#include <QPainter>
#include <QStandardItemModel>
#include <algorithm>

#include "tests/ui/window/panel_pixels.h"
#include "ui/models/object_list_model.h"
#include "ui/panels/object_delegate.h"
#include "ui/theme/theme.h"

namespace scantrove {
namespace {

using test::countPixels;

TEST(ObjectDelegate, TagFitsInANarrowList_AndDoesNotShortenTheName) {
  QStandardItemModel model(1, 1);
  model.setItem(0, new QStandardItem(QStringLiteral("an object with a name of many letters")));
  const ObjectDelegate delegate;
  const auto paint = [&](bool added, int width) {
    model.setData(model.index(0, 0), added, ObjectListModel::AddedNowRole);
    QImage image(width, delegate.sizeHint({}, {}).height(), QImage::Format_RGB32);
    image.fill(Qt::black);
    QPainter painter(&image);
    QStyleOptionViewItem option;
    option.rect = image.rect();
    delegate.paint(&painter, option, model.index(0, 0));
    return image;
  };
  const auto tagPixels = [&](int width) {
    return countPixels(paint(true, width), QRect(0, 0, width, 70), Theme::instance().colors().warning);
  };
  EXPECT_GT(tagPixels(400), 5);
  EXPECT_EQ(tagPixels(200), tagPixels(400));
  const auto textWidth = [](const QImage& image, int rows) {
    int right = 0;
    for (int y = 0; y < rows; ++y) {
      for (int x = 0; x < image.width(); ++x) {
        if (image.pixelColor(x, y).lightness() > 60) right = std::max(right, x);
      }
    }
    return right;
  };
  EXPECT_NEAR(textWidth(paint(true, 200), 22), textWidth(paint(false, 200), 30), 2);
}

}  // namespace
}  // namespace scantrove
