#pragma once
#include <QObject>
#include <QPointer>
#include <QString>
#include <functional>
#include <memory>
#include <vector>

#include "core/editing/operation.h"
#include "ui/bridge/scan_bridge.h"
#include "ui/models/region_proposals.h"
#include "ui/models/region_selection.h"
#include "ui/models/undo_history.h"

class QMessageBox;
class QWidget;

namespace scantrove {

class ScenePane;

/// What is done to the selected regions: posts the operations to the scan, keeps each as a step that can be
/// taken back, and proposes further regions for a name.
class RegionOperations : public QObject {
  Q_OBJECT

 public:
  /// All of these outlive it; questions open in the middle of `window`.
  RegionOperations(ScanBridge& bridge, ScenePane& scene, RegionSelection& selection, UndoHistory& history,
                   QWidget& window);
  ~RegionOperations() override;

  [[nodiscard]] RegionProposals& proposals() { return proposals_; }
  [[nodiscard]] const RegionProposals& proposals() const { return proposals_; }
  void beginScan();
  void showSnapshot(const ScanSnapshot& snapshot);

  /// One operation on all that is selected, or one for each.
  void doOnAll(OperationKind kind, bool on = true);
  void doOnEach(OperationKind kind);
  /// A region that a person named comes first: the others take its name.
  void join();
  /// Names what is selected; asks first where that is background.
  void giveName(const QString& name, const QString& category);
  void acceptFirst();
  void acceptAll();
  void perform(Operation operation);
  void undoNewest();

 signals:
  void nameGiven(const QString& name);
  /// An operation was not done, or is not on disk.
  void failed(const QString& message);

 private:
  class Command;
  friend class Command;

  void nameRegions(const std::vector<RegionId>& regions, const QString& name, const QString& category);
  /// `todo` is done if the person says so before the scan ends.
  void ask(const QString& question, const QString& yes, std::function<void()> todo);
  [[nodiscard]] std::vector<RegionId> backgroundAmong(const std::vector<RegionId>& regions) const;
  /// Operations that a session has from before, so that they can be taken back.
  void updateHistory(const std::vector<DoneOperation>& operations);
  void edited(const Edited& event);
  void editFailed(const EditFailed& event);
  [[nodiscard]] QString inWords(const Operation& operation) const;
  /// What else looks like what was just named.
  void proposeLike(const Operation& naming);
  void accept(const std::vector<Proposal>& accepted);

  ScanBridge& bridge_;
  ScenePane& scene_;
  RegionSelection& selection_;
  UndoHistory& history_;
  QWidget& window_;
  RegionProposals proposals_;
  std::vector<std::shared_ptr<Command>> performed_;  ///< in this scan
  QPointer<QMessageBox> question_;
  int proposal_number_ = 0;  ///< of the proposal that is being made
  bool knows_history_ = false;
};

}  // namespace scantrove
