#pragma once
#include <QObject>

namespace scantrove {

class SceneView;
class ViewLabel;

/// Clip plane: while active, the view hides everything in front of a plane, which Ctrl + wheel or Ctrl + up
/// and down move.
class ClipTool : public QObject {
  Q_OBJECT

 public:
  explicit ClipTool(SceneView* view);

  void setActive(bool active);
  [[nodiscard]] bool active() const { return active_; }

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  /// Moves the plane by `steps` away from the viewer.
  void move(float steps);
  void showLabel();

  SceneView* view_;
  ViewLabel* label_;
  float behind_target_m_ = 0;
  bool active_ = false;
};

}  // namespace scantrove
