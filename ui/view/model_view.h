#pragma once
#include <QImage>
#include <QPoint>
#include <QTimer>
#include <QWidget>
#include <memory>
#include <span>

#include "ui/scene/object_model_scene.h"

namespace scantrove {

class QtRenderWindow;

/// A 3D model of one object that turns slowly. Drag or arrow keys turn it by hand, which ends that; Space
/// starts and stops it; wheel, plus and minus zoom; Home shows all.
class ModelView : public QWidget {
  Q_OBJECT

 public:
  explicit ModelView(QWidget* parent = nullptr);
  ~ModelView() override;

  /// As ObjectModelScene::setPoints(). `is_same`: the model has more or other points of the same object, so
  /// the viewpoint stays.
  void setModel(std::span<const ViewPoint> points, float spacing_m, const Eigen::Vector3f& up, bool is_same);
  [[nodiscard]] std::size_t pointCount() const { return scene_.pointCount(); }
  void setColors(const Rgb& top, const Rgb& bottom);
  [[nodiscard]] bool isTurning() const { return is_turning_; }
  void setTurning(bool turning);
  /// Direction from the eye to the model, unit.
  [[nodiscard]] Eigen::Vector3f viewDirection() { return scene_.viewpoint().forward(); }
  [[nodiscard]] QSize sizeHint() const override { return {380, 320}; }

 protected:
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void showEvent(QShowEvent* event) override;
  void hideEvent(QHideEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;

 private:
  void turnByHand(float yaw, float pitch);
  void zoom(float factor);
  void fit();
  void redraw();
  void updateTimer();

  ObjectModelScene scene_;
  std::unique_ptr<QtRenderWindow> window_;  ///< null until the first drawing
  QImage picture_;                          ///< the last drawing; null: to be drawn
  QTimer timer_;
  bool is_turning_ = true;
  QPoint dragged_from_;
};

}  // namespace scantrove
