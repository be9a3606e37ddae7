#pragma once
#include <QObject>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "ui/common/region_point.h"
#include "ui/main_window/region_actions.h"
#include "ui/main_window/region_naming.h"
#include "ui/main_window/region_operations.h"
#include "ui/main_window/region_splitter.h"
#include "ui/models/region_selection.h"

namespace scantrove {

class FramePanels;
class ImageMode;
class ScenePane;

/// Connects the views with the selection of regions, and the actions with RegionOperations.
class RegionController : public QObject {
  Q_OBJECT

 public:
  /// All of these outlive the controller; `window` is the parent of the name editor.
  RegionController(ScanBridge& bridge, ScenePane& scene, FramePanels& frames, UndoHistory& history,
                   QWidget& window);

  [[nodiscard]] RegionActions& actions() { return actions_; }
  [[nodiscard]] RegionSelection& selection() { return selection_; }
  [[nodiscard]] RegionOperations& operations() { return operations_; }
  [[nodiscard]] RegionNaming& naming() { return *naming_; }
  [[nodiscard]] RegionNameEditor& nameEditor() { return naming_->editor(); }

  /// Makes the image mode one more view of the regions; what is painted there becomes undo steps.
  void connectImage(ImageMode& image);

  void beginScan();
  void showSnapshot(const ScanSnapshot& snapshot);
  /// Applies a name that is being typed.
  void finishEditing();

 signals:
  void failed(const QString& message);
  void hinted(const QString& message);

 private:
  void connectFrames();
  void connectScene();
  void connectActions();

  void point(const RegionPoint& point);
  void click(const RegionPoint& point, Qt::KeyboardModifiers modifiers);
  void openMenu(const RegionPoint& point, const QPoint& on_screen);
  void connectSplitter();
  void deselect();

  /// The region under the pointer; or the suggested one, if the pointer is on none or on a selected region.
  [[nodiscard]] RegionId highlightedRegion() const;
  void updateHighlight();
  void highlightScene();
  /// Opens the field for the selected regions, or for the one that is pointed at.
  void editName();
  void updateActions();
  [[nodiscard]] QStringList tagOf(RegionId region);
  [[nodiscard]] QString sizeOf(RegionId region);

  void showProposal();

  ScenePane& scene_;
  FramePanels& frames_;
  RegionSelection selection_;
  RegionActions actions_;
  RegionOperations operations_;
  RegionSplitter* splitter_;
  RegionNaming* naming_;
  std::set<RegionId> background_;
  std::map<RegionId, QString> sizes_;  ///< cache, cleared when regions change
  std::optional<QPointF> pointer_in_scene_;
  QPoint last_position_;  ///< of the last click, screen coordinates
};

}  // namespace scantrove
