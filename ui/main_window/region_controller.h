#pragma once
#include <QObject>
#include <QPointer>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "ui/bridge/scan_bridge.h"
#include "ui/common/region_point.h"
#include "ui/main_window/region_actions.h"
#include "ui/main_window/region_splitter.h"
#include "ui/models/region_proposals.h"
#include "ui/models/region_selection.h"
#include "ui/models/undo_history.h"
#include "ui/panels/region_name_editor.h"

class QMessageBox;

namespace scantrove {

class FramePanels;
class ScenePane;

/// Pointing at regions and what is done to them: ties the views to the selection, and the selection to the
/// scan. Every operation is a step that can be taken back.
class RegionController : public QObject {
  Q_OBJECT

 public:
  /// All of these outlive the controller; `window` is whose middle the name editor opens in.
  RegionController(ScanBridge& bridge, ScenePane& scene, FramePanels& frames, UndoHistory& history,
                   QWidget& window);

  [[nodiscard]] RegionActions& actions() { return actions_; }
  [[nodiscard]] RegionSelection& selection() { return selection_; }
  [[nodiscard]] RegionProposals& proposals() { return proposals_; }
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
  class Command;
  friend class Command;

  void connectFrames();
  void connectScene();
  void connectActions();
  void connectBridge();

  void point(const RegionPoint& point);
  void click(const RegionPoint& point, Qt::KeyboardModifiers modifiers);
  void openMenu(const RegionPoint& point, const QPoint& on_screen);
  void editName(const QPoint& on_screen);
  /// What is selected; asks first where that is background.
  void giveName(const QString& name, const QString& category);
  void nameRegions(const std::vector<RegionId>& regions, const QString& name, const QString& category);

  void connectCutter();
  void deselect();

  /// One operation on all that is selected, or one for each.
  void doOnAll(OperationKind kind, bool on = true);
  void doOnEach(OperationKind kind);
  /// A region that a person named comes first: the others take its name.
  void join();
  /// `todo` is done if the person says so before the scan ends.
  void ask(const QString& question, const QString& yes, std::function<void()> todo);
  [[nodiscard]] std::vector<RegionId> backgroundAmong(const std::vector<RegionId>& regions) const;
  void perform(Operation operation);
  /// Operations that a session has from before, so that they can be taken back.
  void updateHistory(const std::vector<DoneOperation>& operations);
  void edited(const Edited& event);
  void editFailed(const EditFailed& event);
  [[nodiscard]] QString inWords(const Operation& operation) const;

  /// Under the pointer; or what is proposed, while that is nowhere or on what is selected.
  [[nodiscard]] RegionId pointedOut() const;
  void light();
  void lightScene();
  void updateActions();
  [[nodiscard]] QStringList tagOf(RegionId region);
  [[nodiscard]] QString sizeOf(RegionId region);
  void rememberName(const QString& name);

  /// What else looks like what was just named.
  void proposeLike(const Operation& naming);
  void accept(const std::vector<Proposal>& accepted);
  void showProposal();

  ScanBridge& bridge_;
  ScenePane& scene_;
  FramePanels& frames_;
  RegionSelection selection_;
  RegionProposals proposals_;
  RegionActions actions_;
  UndoHistory& history_;
  std::vector<std::shared_ptr<Command>> performed_;  ///< in this scan
  RegionSplitter* cutter_;
  RegionNameEditor* name_editor_;
  QPointer<QWidget> focus_before_name_;
  QPointer<QMessageBox> question_;
  std::function<QStringList()> known_names_;
  std::set<RegionId> background_;
  std::map<RegionId, QString> sizes_;  ///< as they were asked for since the last news
  std::optional<QPointF> pointer_in_scene_;
  QPoint last_place_;        ///< on the screen, that was clicked or pointed at
  int proposal_number_ = 0;  ///< of the proposal that is being made
  bool knows_history_ = false;
};

}  // namespace scantrove
