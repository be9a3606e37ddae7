#include "ui/theme/icon.h"

#include <QApplication>
#include <QFile>
#include <QIconEngine>
#include <QPainter>
#include <QPalette>
#include <QPixmap>
#include <QSvgRenderer>

// Outside of the namespace, because the macro declares a global function.
static void initializeScantroveResources() { Q_INIT_RESOURCE(scantrove); }

namespace scantrove {
namespace {

/// Draws an SVG with black replaced by the text colour.
class ThemedIconEngine final : public QIconEngine {
 public:
  ThemedIconEngine(QByteArray svg, const QColor& color) : svg_(std::move(svg)), color_(color) {}

  void paint(QPainter* painter, const QRect& rect, QIcon::Mode mode, QIcon::State /*state*/) override {
    QColor color = color_;
    if (mode == QIcon::Disabled) {
      color = QApplication::palette().color(QPalette::Disabled, QPalette::ButtonText);
    } else if (!color.isValid()) {
      color = QApplication::palette().color(QPalette::ButtonText);
    }
    QByteArray tinted = svg_;
    tinted.replace("#000000", color.name().toLatin1());
    QSvgRenderer(tinted).render(painter, rect);
  }

  QPixmap pixmap(const QSize& size, QIcon::Mode mode, QIcon::State state) override {
    QPixmap result(size);
    result.fill(Qt::transparent);
    QPainter painter(&result);
    paint(&painter, QRect(QPoint(0, 0), size), mode, state);
    return result;
  }

  [[nodiscard]] QIconEngine* clone() const override { return new ThemedIconEngine(*this); }

 private:
  QByteArray svg_;
  QColor color_;
};

}  // namespace

void initializeResources() { initializeScantroveResources(); }

QIcon icon(const QString& name, const QColor& color) {
  QFile file(QStringLiteral(":/icons/%1.svg").arg(name));
  if (!file.open(QIODevice::ReadOnly)) return {};
  return QIcon(new ThemedIconEngine(file.readAll(), color));
}

}  // namespace scantrove
