#include "ui/theme/indicator_style.h"

#include <QStyleOptionButton>

namespace scantrove {

IndicatorStyle::IndicatorStyle(const QColor& outline)
    : QProxyStyle(QStringLiteral("Fusion")), outline_(outline) {}

void IndicatorStyle::drawPrimitive(PrimitiveElement element, const QStyleOption* option, QPainter* painter,
                                   const QWidget* widget) const {
  const bool is_indicator = element == PE_IndicatorCheckBox || element == PE_IndicatorRadioButton;
  const auto* button = is_indicator ? qstyleoption_cast<const QStyleOptionButton*>(option) : nullptr;
  if (button == nullptr) return QProxyStyle::drawPrimitive(element, option, painter, widget);
  QStyleOptionButton outlined(*button);
  outlined.palette.setColor(QPalette::Window, outline_);
  QProxyStyle::drawPrimitive(element, &outlined, painter, widget);
}

}  // namespace scantrove
