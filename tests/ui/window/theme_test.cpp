#include "ui/theme/theme.h"

#include <gtest/gtest.h>

#include <QApplication>
#include <algorithm>
#include <cmath>

namespace scantrove::test {
namespace {

/// Contrast of WCAG 2: (L1 + 0.05) / (L2 + 0.05), of relative luminances.
double luminanceOf(const QColor& color) {
  const auto linear = [](double c) { return c <= 0.03928 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); };
  return 0.2126 * linear(color.redF()) + 0.7152 * linear(color.greenF()) + 0.0722 * linear(color.blueF());
}

double contrastOf(const QColor& a, const QColor& b) {
  const double lighter = std::max(luminanceOf(a), luminanceOf(b)),
               darker = std::min(luminanceOf(a), luminanceOf(b));
  return (lighter + 0.05) / (darker + 0.05);
}

class ThemeContrast : public testing::TestWithParam<ThemeChoice> {
 protected:
  void SetUp() override {
    before_ = Theme::instance().choice();
    Theme::instance().choose(GetParam());
  }
  void TearDown() override { Theme::instance().choose(before_); }

 private:
  ThemeChoice before_ = ThemeChoice::system;
};
INSTANTIATE_TEST_SUITE_P(BothThemes, ThemeContrast, testing::Values(ThemeChoice::light, ThemeChoice::dark));

// WCAG 2 asks 4.5 : 1 for small text.
TEST_P(ThemeContrast, IsEnoughForSmallText) {
  const ThemeColors& colors = Theme::instance().colors();
  const QPalette palette = QApplication::palette();
  for (const QColor& text : {palette.color(QPalette::WindowText), colors.muted_text, colors.accent,
                             colors.good, colors.warning, colors.bad, colors.info}) {
    for (const QPalette::ColorRole role : {QPalette::Window, QPalette::Base, QPalette::AlternateBase,
                                           QPalette::Button, QPalette::ToolTipBase}) {
      const QColor below = palette.color(role);
      EXPECT_GE(contrastOf(text, below), 4.5)
          << text.name().toStdString() << " on " << below.name().toStdString();
    }
  }
  EXPECT_GE(contrastOf(palette.color(QPalette::HighlightedText), palette.color(QPalette::Highlight)), 4.5);
}

}  // namespace
}  // namespace scantrove::test
