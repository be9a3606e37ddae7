#pragma once
#include <QWidget>

namespace scantrove {

class ImageCanvas;
class ImageViewBar;
class PaintToolBar;

/// The image mode in the main area: two bars over the image.
class ImagePage : public QWidget {
  Q_OBJECT

 public:
  explicit ImagePage(QWidget* parent = nullptr);

  [[nodiscard]] PaintToolBar& tools() const { return *tools_; }
  [[nodiscard]] ImageViewBar& view() const { return *view_; }
  [[nodiscard]] ImageCanvas& canvas() const { return *canvas_; }

 private:
  PaintToolBar* tools_;
  ImageViewBar* view_;
  ImageCanvas* canvas_;
};

}  // namespace scantrove
