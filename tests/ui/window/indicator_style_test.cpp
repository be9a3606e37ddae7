#include <gtest/gtest.h>

#include <QApplication>
#include <QCheckBox>
#include <QImage>
#include <QStyle>
#include <QStyleOptionButton>
#include <algorithm>
#include <cstdlib>

#include "ui/theme/theme.h"

namespace scantrove {
namespace {

/// Less is hard to tell from the window, 0 .. 255.
constexpr int kLeastDifference = 60;

TEST(IndicatorStyle, OutlineOfACheckBoxIsSeenInBothThemes) {
  for (const ThemeChoice choice : {ThemeChoice::light, ThemeChoice::dark}) {
    Theme::instance().choose(choice);
    QCheckBox box(QStringLiteral("New region"));
    box.resize(box.sizeHint());
    QImage picture(box.size(), QImage::Format_RGB32);
    const QColor window = QApplication::palette().color(QPalette::Window);
    picture.fill(window);
    box.render(&picture);
    QStyleOptionButton option;
    option.initFrom(&box);
    const QRect indicator = box.style()->subElementRect(QStyle::SE_CheckBoxIndicator, &option, &box);
    int most = 0;
    for (int x = indicator.left(); x <= indicator.right(); ++x) {
      const int lightness = picture.pixelColor(x, indicator.top()).lightness();
      most = std::max(most, std::abs(lightness - window.lightness()));
    }
    EXPECT_GE(most, kLeastDifference) << (choice == ThemeChoice::dark ? "dark" : "light");
  }
  Theme::instance().choose(ThemeChoice::system);
}

}  // namespace
}  // namespace scantrove
