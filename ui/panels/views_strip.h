#pragma once
#include <QImage>
#include <QWidget>
#include <vector>

namespace scantrove {

/// The views of one object side by side, scrolled sideways with wheel or arrow keys.
class ViewsStrip : public QWidget {
  Q_OBJECT

 public:
  explicit ViewsStrip(QWidget* parent = nullptr);
  void setViews(std::vector<QImage> pictures);
  [[nodiscard]] std::size_t count() const { return pictures_.size(); }
  [[nodiscard]] QSize sizeHint() const override { return {240, 92}; }

 protected:
  void paintEvent(QPaintEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;

 private:
  void scrollBy(int pixels);
  [[nodiscard]] int contentWidth() const;

  std::vector<QImage> pictures_;
  int offset_ = 0;
};

}  // namespace scantrove
