#include "ui/theme/theme.h"

#include <QApplication>
#include <QStyle>

#include "ui/theme/indicator_style.h"

namespace scantrove {
namespace {

ThemeColors darkColors() {
  ThemeColors c;
  c.dark = true;
  c.surface = QColor(0x22, 0x25, 0x2b);
  c.outline = QColor(0x34, 0x38, 0x41);
  c.muted_text = QColor(0x9a, 0xa2, 0xae);
  c.accent = QColor(0x35, 0xb8, 0xb0);
  c.good = QColor(0x3f, 0xc3, 0x80);
  c.warning = QColor(0xf0, 0xb0, 0x3f);
  c.bad = QColor(0xf5, 0x8b, 0x8f);
  c.info = QColor(0x6d, 0xb3, 0xf2);
  c.scene_top = {43, 48, 58};
  c.scene_bottom = {22, 24, 29};
  c.scene_grid = {60, 66, 77};
  c.scene_trail = {226, 230, 236};
  return c;
}

ThemeColors lightColors() {
  ThemeColors c;
  c.dark = false;
  c.surface = QColor(0xff, 0xff, 0xff);
  c.outline = QColor(0xd8, 0xdc, 0xe2);
  c.muted_text = QColor(0x56, 0x5d, 0x66);
  c.accent = QColor(0x09, 0x62, 0x5f);
  c.good = QColor(0x13, 0x67, 0x3a);
  c.warning = QColor(0x80, 0x4f, 0x00);
  c.bad = QColor(0xab, 0x24, 0x2c);
  c.info = QColor(0x19, 0x5a, 0x9e);
  c.scene_top = {240, 243, 247};
  c.scene_bottom = {208, 214, 223};
  c.scene_grid = {186, 194, 206};
  c.scene_trail = {54, 62, 76};
  return c;
}

QPalette paletteOf(const ThemeColors& c) {
  const QColor window = c.dark ? QColor(0x1a, 0x1c, 0x21) : QColor(0xf1, 0xf3, 0xf6);
  const QColor text = c.dark ? QColor(0xe7, 0xea, 0xee) : QColor(0x1e, 0x23, 0x2b);
  const QColor button = c.dark ? QColor(0x2b, 0x2f, 0x37) : QColor(0xff, 0xff, 0xff);
  const QColor faint = c.dark ? QColor(0x6b, 0x72, 0x7d) : QColor(0xa2, 0xa9, 0xb3);
  QPalette p;
  p.setColor(QPalette::Window, window);
  p.setColor(QPalette::WindowText, text);
  p.setColor(QPalette::Base, c.surface);
  p.setColor(QPalette::AlternateBase, c.dark ? QColor(0x26, 0x29, 0x30) : QColor(0xf7, 0xf8, 0xfa));
  p.setColor(QPalette::Text, text);
  p.setColor(QPalette::PlaceholderText, c.muted_text);
  p.setColor(QPalette::Button, button);
  p.setColor(QPalette::ButtonText, text);
  p.setColor(QPalette::BrightText, c.bad);
  p.setColor(QPalette::ToolTipBase, c.dark ? QColor(0x33, 0x38, 0x42) : QColor(0xff, 0xff, 0xff));
  p.setColor(QPalette::ToolTipText, text);
  p.setColor(QPalette::Highlight, c.accent);
  p.setColor(QPalette::HighlightedText, c.dark ? QColor(0x0a, 0x1c, 0x1b) : QColor(0xff, 0xff, 0xff));
  p.setColor(QPalette::Link, c.accent);
  p.setColor(QPalette::LinkVisited, c.accent);
  p.setColor(QPalette::Light, c.dark ? QColor(0x3b, 0x40, 0x4a) : QColor(0xff, 0xff, 0xff));
  p.setColor(QPalette::Midlight, c.outline);
  p.setColor(QPalette::Mid, c.outline);
  p.setColor(QPalette::Dark, c.dark ? QColor(0x12, 0x14, 0x18) : QColor(0xc3, 0xc9, 0xd2));
  p.setColor(QPalette::Shadow, c.dark ? QColor(0x0b, 0x0c, 0x0f) : QColor(0x9a, 0xa1, 0xab));
  for (const QPalette::ColorRole role : {QPalette::WindowText, QPalette::Text, QPalette::ButtonText}) {
    p.setColor(QPalette::Disabled, role, faint);
  }
  p.setColor(QPalette::Disabled, QPalette::Highlight, c.outline);
  p.setColor(QPalette::Disabled, QPalette::HighlightedText, faint);
  return p;
}

QString styleSheetOf(const ThemeColors& c) {
  const QString outline = c.outline.name();
  const QString surface = c.surface.name();
  const QString hover = c.dark ? QStringLiteral("#343943") : QStringLiteral("#e6eaef");
  const QString pressed = c.dark ? QStringLiteral("#3e4450") : QStringLiteral("#d9dfe6");
  const QString muted = c.muted_text.name();
  return QStringLiteral(R"(
QMainWindow::separator { width: 6px; height: 6px; background: transparent; }
QMainWindow::separator:hover { background: %5; }
QMenuBar { background: palette(window); border-bottom: 1px solid %1; padding: 2px 4px; }
QMenuBar::item { padding: 5px 10px; border-radius: 5px; background: transparent; }
QMenuBar::item:selected { background: %3; }
QMenu { background: %2; border: 1px solid %1; padding: 5px; }
QMenu::item { padding: 6px 28px 6px 12px; border-radius: 5px; }
QMenu::item:selected { background: %3; color: palette(text); }
QMenu::item:disabled { color: %6; }
QMenu::separator { height: 1px; background: %1; margin: 5px 8px; }
QMenu::icon { padding-left: 8px; }
QToolBar { background: palette(window); border: none; border-bottom: 1px solid %1; padding: 6px 8px; spacing: 4px; }
QToolBar::separator { width: 1px; background: %1; margin: 5px 6px; }
QToolButton { border: none; border-radius: 6px; padding: 6px; background: transparent; }
QToolButton:hover { background: %3; }
QToolButton:pressed, QToolButton:checked { background: %4; }
QToolButton:focus { outline: none; border: 1px solid %5; padding: 5px; }
QToolButton[popupMode="2"] { padding-right: 20px; }
QToolButton::menu-indicator { subcontrol-origin: padding; subcontrol-position: right center; right: 5px; }
QPushButton { border: 1px solid %1; border-radius: 6px; padding: 6px 14px; background: palette(button); }
QPushButton:hover { background: %3; }
QPushButton:pressed { background: %4; }
QPushButton:focus { border-color: %5; }
QPushButton:disabled { color: %6; }
QPushButton[primary="true"] { background: %5; border-color: %5; color: palette(highlighted-text); font-weight: 600; }
QPushButton[primary="true"]:disabled { background: %4; border-color: %4; color: %6; }
QDialogButtonBox { dialogbuttonbox-buttons-have-icons: 0; }
QDockWidget { font-weight: 600; }
QDockWidget::title { text-align: left; padding: 8px 10px 6px 10px; background: palette(window); }
QDockWidget::close-button { subcontrol-position: center right; subcontrol-origin: margin; right: 8px; }
QStatusBar { background: palette(window); border-top: 1px solid %1; }
QStatusBar::item { border: none; }
QProgressBar { border: none; border-radius: 4px; background: %4; max-height: 8px; min-height: 8px; }
QProgressBar::chunk { border-radius: 4px; background: %5; }
QListView { border: none; background: %2; outline: none; }
QListView[panel="true"] { background: transparent; }
QLineEdit { border: 1px solid %1; border-radius: 6px; padding: 4px 8px; background: %2; min-height: 18px; }
QLineEdit:focus { border-color: %5; }
QToolTip { border: 1px solid %1; padding: 5px; background: %2; color: palette(text); }
QScrollArea { border: none; background: transparent; }
QLabel[muted="true"] { color: %6; }
QLabel[keys="true"] { color: %5; font-weight: 600; }
QToolButton#startCard { background: %2; border: 1px solid %1; border-radius: 10px; }
QToolButton#startCard:hover, QToolButton#startCard:focus { border-color: %5; }
QScrollBar:vertical { width: 10px; background: transparent; margin: 0; }
QScrollBar:horizontal { height: 10px; background: transparent; margin: 0; }
QScrollBar::handle { background: %4; border-radius: 4px; min-height: 28px; min-width: 28px; margin: 1px; }
QScrollBar::handle:hover { background: %6; }
QScrollBar::add-line, QScrollBar::sub-line { width: 0; height: 0; }
QScrollBar::add-page, QScrollBar::sub-page { background: transparent; }
)")
      .arg(outline, surface, hover, pressed, c.accent.name(), muted);
}

}  // namespace

Theme& Theme::instance() {
  static auto* theme = new Theme;  // never deleted: widgets may use colours in their destructors
  return *theme;
}

Theme::Theme() : colors_(darkColors()) {
  // Read before our palette replaces the desktop's.
  system_is_dark_ = QApplication::palette().color(QPalette::Window).lightness() < 128;
}

void Theme::choose(ThemeChoice choice) {
  choice_ = choice;
  const bool dark = choice == ThemeChoice::dark || (choice == ThemeChoice::system && system_is_dark_);
  colors_ = dark ? darkColors() : lightColors();
  QApplication::setStyle(new IndicatorStyle(colors_.muted_text));
  QApplication::setPalette(paletteOf(colors_));
  qApp->setStyleSheet(styleSheetOf(colors_));
  emit changed();
}

}  // namespace scantrove
