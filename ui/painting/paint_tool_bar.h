#pragma once
#include <QList>
#include <QToolBar>

#include "ui/painting/mask_tool.h"

class QAction;
class QCheckBox;
class QSpinBox;

namespace scantrove {

/// Tools of the image mode, the size of the brush, and what a stroke changes.
class PaintToolBar : public QToolBar {
  Q_OBJECT

 public:
  explicit PaintToolBar(QWidget* parent = nullptr);

  [[nodiscard]] PaintTool tool() const { return tool_; }
  [[nodiscard]] QAction* toolAction(PaintTool tool) const { return tools_[static_cast<int>(tool)]; }
  [[nodiscard]] QAction* resetAction() const { return reset_; }
  [[nodiscard]] QCheckBox* newRegionBox() const { return new_region_; }
  [[nodiscard]] QCheckBox* thisImageBox() const { return this_image_; }
  /// Diameter of the brush, pixels of the image.
  [[nodiscard]] int brushSize() const;
  void setBrushSize(int pixels);
  /// Next larger or smaller sizes.
  void stepBrush(int steps);
  /// Actions whose keys work while a widget has the focus that has them.
  [[nodiscard]] QList<QAction*> keyActions() const;
  /// Without a key frame, only the tool select.
  void setCanPaint(bool can_paint);

 signals:
  void toolChosen(scantrove::PaintTool tool);
  void brushSizeChanged(int pixels);

 private:
  QAction* addTool(PaintTool tool, const char* picture, const QString& text, Qt::Key key,
                   const QString& help);
  void choose(PaintTool tool);

  QList<QAction*> tools_;  ///< in the order of PaintTool
  QAction *smaller_, *larger_, *toggle_new_, *reset_;
  QSpinBox* size_;
  QCheckBox *new_region_, *this_image_;
  PaintTool tool_ = PaintTool::select;
};

}  // namespace scantrove
