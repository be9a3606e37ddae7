#pragma once
#include <QObject>
#include <QPointer>
#include <QString>
#include <functional>
#include <memory>
#include <vector>

#include "core/editing/operation.h"
#include "ui/bridge/scan_bridge.h"
#include "ui/models/region_names.h"
#include "ui/models/region_proposals.h"
#include "ui/models/region_selection.h"
#include "ui/models/undo_history.h"

class QMessageBox;
class QWidget;

namespace scantrove {

class ScenePane;

/// Edits the selected regions: posts operations to the scan, adds them as undo steps, and suggests further
/// regions for a name.
class RegionOperations : public QObject {
  Q_OBJECT

 public:
  /// All of these outlive it; `window` is the parent of dialogs.
  RegionOperations(ScanBridge& bridge, ScenePane& scene, RegionSelection& selection, UndoHistory& history,
                   QWidget& window);
  ~RegionOperations() override;

  [[nodiscard]] RegionProposals& proposals() { return proposals_; }
  [[nodiscard]] const RegionProposals& proposals() const { return proposals_; }
  void beginScan();
  void showSnapshot(const ScanSnapshot& snapshot);

  /// Performs one operation on the selected regions, or one on each of them.
  void applyToAll(OperationKind kind, bool on = true);
  void applyToEach(OperationKind kind);
  /// Marks all regions that are proposed as background, in one operation.
  void markSupports();
  /// Joins the selected regions; a named one is first, so that its name is used.
  void join();
  /// Names the regions, or removes their names; asks for confirmation if one is background.
  void name(const std::vector<RegionName>& names);
  /// Sets the source of names for similar regions: a name like the given one, for another thing.
  using OtherName = std::function<GivenName(RegionId, const GivenName&)>;
  void setOtherNames(OtherName other_name) { other_name_ = std::move(other_name); }
  void acceptFirst();
  void acceptAll();
  void perform(Operation operation);
  void undoNewest();

 signals:
  void nameGiven(const scantrove::RegionName& name);
  /// An operation other than a split failed or could not be stored.
  void failed(const QString& message);
  /// What the user can do instead.
  void hinted(const QString& message);
  /// A split failed; the region is as it was.
  void splitFailed(const QString& message);

 private:
  class Command;
  friend class Command;

  void nameRegion(OperationKind kind, const RegionName& name);
  /// Runs `action` if the user confirms before the scan ends.
  void confirm(const QString& question, const QString& yes, std::function<void()> action);
  [[nodiscard]] std::vector<RegionId> backgroundAmong(const std::vector<RegionId>& regions) const;
  /// Adds stored operations of a session as undo steps.
  void updateHistory(const std::vector<DoneOperation>& operations);
  void edited(const Edited& event);
  /// Adds an operation that the scan did by itself as an undo step.
  void addStep(const Operation& operation);
  void editFailed(const EditFailed& event);
  /// `title`: of its only region; empty: what the region is called now.
  [[nodiscard]] QString descriptionOf(const Operation& operation, const QString& title = {}) const;
  [[nodiscard]] static QString descriptionOf(const FrameReview& review);
  /// Suggests regions similar to the named one.
  void proposeSimilar(const Operation& naming);
  void accept(const std::vector<Proposal>& accepted);

  ScanBridge& bridge_;
  ScenePane& scene_;
  RegionSelection& selection_;
  UndoHistory& history_;
  QWidget& window_;
  RegionProposals proposals_;
  OtherName other_name_;
  std::vector<std::shared_ptr<Command>> performed_;  ///< in this scan
  QPointer<QMessageBox> confirmation_;
  int proposal_number_ = 0;  ///< of the current computation of suggestions
  bool knows_history_ = false;
};

}  // namespace scantrove
