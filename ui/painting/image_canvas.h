#pragma once
#include <QImage>
#include <QPolygonF>
#include <QStringList>
#include <QWidget>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "ui/painting/canvas_zoom.h"
#include "ui/painting/mask_picture.h"

class QPainter;

namespace scantrove {

/// An image that fills the widget, with zoom and pan: wheel, middle drag, Space + drag, Ctrl+0, Ctrl++,
/// Ctrl+-. Pixels stay sharp when they are large. Positions in signals are pixels of the image, pixel centres
/// at integers; they may lie outside of it. More than thirty functions, because a widget that draws and
/// reports input has a handler of each event.
class ImageCanvas : public QWidget {
  Q_OBJECT

 public:
  explicit ImageCanvas(QWidget* parent = nullptr);

  /// The layers, from below. Each is drawn over the whole image, whatever its size; null: none.
  struct Layers {
    QImage picture;
    QImage second;  ///< for comparison
    QImage masks;
    QImage highlight = {};  ///< kept by setLayers()
    double second_opacity = 0, masks_opacity = 1;
  };
  /// `size`: of the image whose pixels the signals count.
  void setLayers(const Layers& layers, const QSize& size);
  [[nodiscard]] const Layers& layers() const { return layers_; }
  void setHighlight(const QImage& highlight);

  /// Draws the changed part of a tool's draft (CV_8UC1 of the image's size) in a colour.
  void showDraft(const cv::Mat& draft, const QRect& changed, const QColor& color);
  [[nodiscard]] const QImage& draft() const { return draft_; }
  /// An outline in progress, in pixels of the image as signals have them; empty: none.
  void setOutline(const QPolygonF& outline);
  void setNames(std::vector<MaskName> names);
  /// The circle around the pointer; none: no circle.
  void setBrushRadius(std::optional<double> radius_px);
  /// Text beside the pointer.
  void setTag(const QStringList& tag);
  /// Text shown while there is no picture.
  void setEmptyText(const QString& text);
  /// Keys that a tool needs now, which are then not shortcuts of the window: Escape, Return and Backspace.
  void setKeysTaken(bool taken) { are_keys_taken_ = taken; }
  /// The second click of a double click is a press like the first one.
  void setDoubleClicksDraw(bool draws) { do_double_clicks_draw_ = draws; }

  [[nodiscard]] const CanvasZoom& zoom() const { return zoom_; }
  /// Zooms around a position of the widget.
  void zoomAt(const QPointF& at, double factor);
  void fit();
  /// Position in the widget of a place as signals have it.
  [[nodiscard]] QPointF positionOf(const QPointF& in_image) const {
    return zoom_.toView(in_image + QPointF(0.5, 0.5));
  }

 signals:
  void pressed(const QPointF& at);
  void dragged(const QPointF& at);
  void released(const QPointF& at, Qt::KeyboardModifiers modifiers);
  void doubleClicked(const QPointF& at, const QPoint& on_screen);
  void menuRequested(const QPointF& at, const QPoint& on_screen);
  void pointedAt(const QPointF& at);  ///< the pointer moved, or rests while the image does
  void pointerLeft();
  void brushStepped(int steps);  ///< Ctrl + wheel
  void cancelled();              ///< Escape, while keys are taken
  void completed();              ///< Return
  void steppedBack();            ///< Backspace
  void nextPictureRequested();   ///< V

 protected:
  bool event(QEvent* event) override;
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void contextMenuEvent(QContextMenuEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void keyReleaseEvent(QKeyEvent* event) override;
  void leaveEvent(QEvent* event) override;
  void focusOutEvent(QFocusEvent* event) override;

 private:
  [[nodiscard]] QPointF pixelAt(const QPointF& in_widget) const;
  [[nodiscard]] bool takes(const QKeyEvent& key) const;
  void paintPointer(QPainter& painter);
  void showCursor();

  Layers layers_;
  QSize size_;
  QImage draft_;
  QPolygonF outline_;
  std::vector<MaskName> names_;
  std::optional<double> brush_px_;
  QStringList tag_;
  QString empty_text_;
  CanvasZoom zoom_;
  std::optional<QPointF> pointer_;
  std::optional<QPointF> panned_from_;  ///< while panning
  bool is_space_down_ = false;
  bool is_drawing_ = false;  ///< the left button is held down
  bool are_keys_taken_ = false;
  bool do_double_clicks_draw_ = false;
};

}  // namespace scantrove
