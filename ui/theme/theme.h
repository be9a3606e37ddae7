#pragma once
#include <QColor>
#include <QObject>
#include <QPalette>

#include "core/exchange/region_palette.h"

namespace scantrove {

/// The user's choice; `system` follows the desktop.
enum class ThemeChoice { system, light, dark };

/// Colours that a QPalette has no role for.
struct ThemeColors {
  bool dark = true;
  QColor surface;  ///< panels and cards, on the window's background
  QColor outline;  ///< hairlines between them
  QColor muted_text;
  QColor accent;
  QColor good, warning, bad, info;
  Rgb scene_top{}, scene_bottom{}, scene_grid{}, scene_trail{};
};

/// The application's style: Fusion with our dark or light palette.
class Theme : public QObject {
  Q_OBJECT

 public:
  static Theme& instance();

  void choose(ThemeChoice choice);
  [[nodiscard]] ThemeChoice choice() const { return choice_; }
  [[nodiscard]] const ThemeColors& colors() const { return colors_; }

 signals:
  void changed();

 private:
  Theme();
  ThemeChoice choice_ = ThemeChoice::system;
  ThemeColors colors_;
  bool system_is_dark_ = false;
};

}  // namespace scantrove
