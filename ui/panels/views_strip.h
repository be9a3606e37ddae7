#pragma once
#include <QImage>
#include <QWidget>
#include <vector>

namespace scantrove {

/// The views of one object side by side, newest first, scrolled sideways with wheel or arrow keys.
class ViewsStrip : public QWidget {
  Q_OBJECT

 public:
  explicit ViewsStrip(QWidget* parent = nullptr);
  /// Shows the views of another object; `note` if it has none.
  void setViews(std::vector<QImage> pictures, const QString& note);
  /// Updates the views of the same object and keeps the scroll position.
  void updateViews(std::vector<QImage> pictures);
  [[nodiscard]] std::size_t count() const { return pictures_.size(); }
  [[nodiscard]] int offset() const { return offset_; }  ///< scroll position in pixels
  [[nodiscard]] QSize sizeHint() const override { return {240, 92}; }

 protected:
  void paintEvent(QPaintEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;

 private:
  void scrollTo(int offset);
  [[nodiscard]] int contentWidth() const;

  std::vector<QImage> pictures_;
  QString note_;
  int offset_ = 0;
};

}  // namespace scantrove
