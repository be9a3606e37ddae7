#pragma once
#include <QObject>

namespace scantrove {

class SceneView;
class ViewLabel;

/// Looks inside: while on, the view leaves out what is nearer than a plane, which Ctrl + wheel or Ctrl + up
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
  /// By so many steps, away from the viewer.
  void move(float steps);
  void showLabel();

  SceneView* view_;
  ViewLabel* label_;
  float behind_target_m_ = 0;
  bool active_ = false;
};

}  // namespace scantrove
