#pragma once
#include <QColor>
#include <QObject>

#include "core/editing/operation.h"
#include "ui/common/region_point.h"

namespace scantrove {

class FramePanels;
class RegionSelection;
class ScenePane;

/// Cuts a region in two by what a person draws on it, in any view: a stroke over what is to come off, then
/// one over what stays; a click is a stroke of one place. With Shift, more of the same side follows. What was
/// drawn stays marked in all views until the cut is accepted or given up. The window's thread.
class RegionSplitter : public QObject {
  Q_OBJECT

 public:
  /// All of these outlive it.
  RegionSplitter(ScenePane& scene, FramePanels& frames, const RegionSelection& selection, QObject* parent);

  void begin();
  /// Forgets what was drawn; a cut that was made stays.
  void end();
  /// Return: keeps the cut that is shown, or goes on where Shift has waited for more. False: nothing is cut.
  bool accept();
  void click(const RegionPoint& at, Qt::KeyboardModifiers modifiers);

  /// From begin() until the cut is kept or taken back.
  [[nodiscard]] bool isActive() const { return step_ != Step::no; }
  [[nodiscard]] bool expectsStroke() const { return step_ == Step::here || step_ == Step::there; }
  /// The cut was asked for, and can be taken back.
  [[nodiscard]] bool isShown() const { return step_ == Step::shown; }
  /// What to do now, for the tag beside the pointer; empty: nothing.
  [[nodiscard]] QString nextInWords() const;

  /// Of what comes off, and of what stays.
  static const QColor kHereColor, kThereColor;

 signals:
  void changed();
  void regionChosen(scantrove::RegionId region);
  void splitRequested(const scantrove::Operation& cut);
  void failed(const QString& message);

 private:
  enum class Step { no, here, there, shown };

  void addPlace(const RegionPoint& at);
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
  bool has_added_ = false;  ///< the present stroke, to its side
  RegionId strayed_;        ///< where the present stroke left the region that is cut
};

}  // namespace scantrove
