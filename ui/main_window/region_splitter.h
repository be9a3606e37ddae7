#pragma once
#include <QColor>
#include <QObject>

#include "core/editing/operation.h"
#include "ui/common/region_point.h"

namespace scantrove {

class FramePanels;
class RegionSelection;
class ScenePane;

/// Splits a region by two strokes that the user draws in any view, first over the part to split off, then
/// over the rest. Return instead of the second stroke splits by colour. A click is a stroke of one point;
/// Shift adds further strokes of the same part. The strokes stay marked in all views until the split is
/// accepted or cancelled. Use from the window's thread.
class RegionSplitter : public QObject {
  Q_OBJECT

 public:
  /// All of these outlive it.
  RegionSplitter(ScenePane& scene, FramePanels& frames, const RegionSelection& selection, QObject* parent);

  void begin();
  /// Clears the strokes; a split that was made remains.
  void end();
  /// For Return: accepts the shown split, or ends the strokes of a part. False if not active.
  bool accept();
  /// The split failed: asks for the second stroke again.
  void repeat();
  void click(const RegionPoint& at, Qt::KeyboardModifiers modifiers);

  /// From begin() until the split is accepted or undone.
  [[nodiscard]] bool isActive() const { return step_ != Step::no; }
  [[nodiscard]] bool expectsStroke() const { return step_ == Step::here || step_ == Step::there; }
  /// The split was requested and can be undone.
  [[nodiscard]] bool isSplit() const { return step_ == Step::shown; }
  /// Instruction for the tag beside the pointer; may be empty.
  [[nodiscard]] QString instruction() const;

  /// Stroke colours of the part to split off and of the rest.
  static const QColor kHereColor, kThereColor;

 signals:
  void changed();
  void regionChosen(scantrove::RegionId region);
  void splitRequested(const scantrove::Operation& cut);
  void failed(const QString& message);

 private:
  enum class Step { no, here, there, shown };

  void addPoint(const RegionPoint& at);
  void endStroke(Qt::KeyboardModifiers modifiers);
  void advance();
  void setStep(Step step);
  void showMarks();
  void placeMarksInScene();
  [[nodiscard]] std::vector<Eigen::Vector3f>& side();
  [[nodiscard]] const QColor& color() const { return step_ == Step::there ? kThereColor : kHereColor; }

  ScenePane& scene_;
  FramePanels& frames_;
  const RegionSelection& selection_;
  Step step_ = Step::no;
  Operation split_;
  bool has_added_ = false;  ///< whether the current stroke has a point
  RegionId other_region_;   ///< another region that the current stroke touched
};

}  // namespace scantrove
