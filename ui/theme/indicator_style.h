#pragma once
#include <QColor>
#include <QProxyStyle>

namespace scantrove {

/// Fusion with outlines of check boxes and radio buttons that are seen on a dark window. Fusion makes them
/// from the window's colour, only darker.
class IndicatorStyle : public QProxyStyle {
 public:
  /// `outline`: colour to make the outlines from.
  explicit IndicatorStyle(const QColor& outline);

  void drawPrimitive(PrimitiveElement element, const QStyleOption* option, QPainter* painter,
                     const QWidget* widget) const override;

 private:
  QColor outline_;
};

}  // namespace scantrove
