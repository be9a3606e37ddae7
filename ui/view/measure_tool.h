#pragma once
#include <Eigen/Core>
#include <QObject>
#include <QPointF>
#include <optional>
#include <vector>

class QMouseEvent;

namespace scantrove {

class SceneView;
class ViewLabel;

/// Measures: while on, a click on the surface sets one end of a line, the next the other, and a third begins
/// anew. The length stands beside the line. Drags turn the view as ever; Escape ends it.
class MeasureTool : public QObject {
  Q_OBJECT

 public:
  explicit MeasureTool(SceneView* view);

  void setActive(bool active);
  [[nodiscard]] bool active() const { return active_; }
  /// Of the line that is shown; none before its second end is.
  [[nodiscard]] std::optional<float> length() const;

  /// As a person reads it: centimetres below a metre.
  [[nodiscard]] static QString lengthText(float meters);

 signals:
  void ended();

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  bool press(const QMouseEvent& event);
  bool release(const QMouseEvent& event);
  void hover(const QPointF& at);
  void forget();
  void showLine();
  void placeLabels();
  [[nodiscard]] std::optional<Eigen::Vector3f> surfaceAt(const QPointF& at) const;

  SceneView* view_;
  ViewLabel* hint_;
  ViewLabel* length_label_;
  std::vector<Eigen::Vector3f> ends_;
  std::optional<Eigen::Vector3f> under_mouse_;  ///< where the second end would be
  std::optional<QPointF> pressed_at_;
  bool active_ = false;
};

}  // namespace scantrove
