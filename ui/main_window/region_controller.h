#pragma once
#include <QObject>
#include <QPointer>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "ui/common/region_point.h"
#include "ui/main_window/region_actions.h"
#include "ui/main_window/region_operations.h"
#include "ui/main_window/region_splitter.h"
#include "ui/models/region_selection.h"
#include "ui/panels/region_name_editor.h"

namespace scantrove {

class FramePanels;
class ScenePane;

/// Pointing at regions: ties the views to the selection, and the actions to what they do with it
/// (RegionOperations).
class RegionController : public QObject {
  Q_OBJECT

 public:
  /// All of these outlive the controller; `window` is whose middle the name editor opens in.
  RegionController(ScanBridge& bridge, ScenePane& scene, FramePanels& frames, UndoHistory& history,
                   QWidget& window);

  [[nodiscard]] RegionActions& actions() { return actions_; }
  [[nodiscard]] RegionSelection& selection() { return selection_; }
  [[nodiscard]] RegionOperations& operations() { return operations_; }
  [[nodiscard]] RegionNameEditor& nameEditor() { return *name_editor_; }
  /// Names that the catalogue has, for completion.
  void setKnownNames(std::function<QStringList()> known_names) { known_names_ = std::move(known_names); }

  void beginScan();
  void showSnapshot(const ScanSnapshot& snapshot);
  /// Finishes a name that is being typed.
  void finishEditing();

 signals:
  void failed(const QString& message);

 private:
  void connectFrames();
  void connectScene();
  void connectActions();

  void point(const RegionPoint& point);
  void click(const RegionPoint& point, Qt::KeyboardModifiers modifiers);
  void openMenu(const RegionPoint& point, const QPoint& on_screen);
  void editName(const QPoint& on_screen);
  void connectSplitter();
  void deselect();

  /// Under the pointer; or what is proposed, while that is nowhere or on what is selected.
  [[nodiscard]] RegionId pointedOut() const;
  void light();
  void lightScene();
  void updateActions();
  [[nodiscard]] QStringList tagOf(RegionId region);
  [[nodiscard]] QString sizeOf(RegionId region);
  void rememberName(const QString& name);

  void showProposal();

  ScenePane& scene_;
  FramePanels& frames_;
  RegionSelection selection_;
  RegionActions actions_;
  RegionOperations operations_;
  RegionSplitter* splitter_;
  RegionNameEditor* name_editor_;
  QPointer<QWidget> focus_before_name_;
  std::function<QStringList()> known_names_;
  std::set<RegionId> background_;
  std::map<RegionId, QString> sizes_;  ///< as they were asked for since the last news
  std::optional<QPointF> pointer_in_scene_;
  QPoint last_place_;  ///< on the screen, that was clicked or pointed at
};

}  // namespace scantrove
