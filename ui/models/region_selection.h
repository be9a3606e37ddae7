#pragma once
#include <QObject>
#include <QString>
#include <memory>
#include <set>
#include <vector>

#include "core/scan/scan_snapshot.h"

namespace scantrove {

/// The regions of the scan that is shown, and which of them a person points at: one is under the pointer,
/// some are selected. All views show the same. A region that is joined with another, or parts, while it is
/// selected is followed by its fragments.
class RegionSelection : public QObject {
  Q_OBJECT

 public:
  explicit RegionSelection(QObject* parent = nullptr) : QObject(parent) {}

  /// Takes over what is new in the snapshot.
  void update(const ScanSnapshot& snapshot);
  /// Another scan.
  void reset();

  void hover(RegionId region);
  /// Selects the region alone; with `also`, in addition to the others, or no longer when it was. None,
  /// without `also`: nothing.
  void select(RegionId region, bool also = false);
  void select(const std::vector<RegionId>& regions);
  /// Selects the largest region that was not walked to yet, whatever grows meanwhile; or goes back to the one
  /// before. When all were walked to, it begins again.
  void walk(bool forward);

  [[nodiscard]] RegionId hovered() const { return hovered_; }
  /// In the order in which they were selected.
  [[nodiscard]] const std::vector<RegionId>& selected() const { return selected_; }
  [[nodiscard]] bool isSelected(RegionId region) const;

  /// Null: there is no such region.
  [[nodiscard]] const RegionInfo* info(RegionId region) const;
  [[nodiscard]] const RegionInfos& infos() const { return *infos_; }
  [[nodiscard]] std::set<RegionId> background() const;
  /// Its name, or "Region 12".
  [[nodiscard]] QString title(RegionId region) const;

 signals:
  void hoverChanged();
  void selectionChanged();
  void infosChanged();

 private:
  void takeChanges(const std::vector<RegionChange>& changes);
  /// What the fragments that were selected as one region are now.
  [[nodiscard]] RegionId nowOf(const std::vector<FragmentId>& fragments) const;
  void keepFragments();

  std::shared_ptr<const RegionInfos> infos_ = std::make_shared<RegionInfos>();
  std::vector<RegionId> region_of_;  // by fragment
  RegionId hovered_;
  std::vector<RegionId> selected_;
  std::vector<RegionId> walked_;                    // in order
  std::vector<std::vector<FragmentId>> fragments_;  // of selected_, when they were selected
};

}  // namespace scantrove
