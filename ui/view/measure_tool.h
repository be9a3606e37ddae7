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

/// Measuring tool: while active, two clicks on the surface set the ends of a line, and a third click starts a
/// new one. Shows the length beside the line. Drags still turn the view; Escape ends the tool.
class MeasureTool : public QObject {
  Q_OBJECT

 public:
  explicit MeasureTool(SceneView* view);

  void setActive(bool active);
  [[nodiscard]] bool active() const { return active_; }
  /// Length of the line in metres; none before its second end is set.
  [[nodiscard]] std::optional<float> length() const;

  /// Length as text, in centimetres below a metre.
  [[nodiscard]] static QString lengthText(float meters);

 signals:
  void ended();

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  bool press(const QMouseEvent& event);
  bool release(const QMouseEvent& event);
  void hover(const QPointF& at);
  void clear();
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
