#pragma once
#include <QObject>
#include <QString>
#include <memory>
#include <set>
#include <vector>

#include "core/scan/scan_snapshot.h"

namespace scantrove {

/// The regions of the shown scan, the region under the pointer and the selected regions, shared by all views.
/// If a selected region is merged or split, its fragments decide which region stays selected.
class RegionSelection : public QObject {
  Q_OBJECT

 public:
  explicit RegionSelection(QObject* parent = nullptr) : QObject(parent) {}

  /// Applies the changes of a snapshot.
  void update(const ScanSnapshot& snapshot);
  /// Clears everything for another scan.
  void reset();

  void hover(RegionId region);
  /// Selects only this region; with `also`, adds it to the selection or removes it. No region without `also`:
  /// clears the selection.
  void select(RegionId region, bool also = false);
  void select(const std::vector<RegionId>& regions);
  /// Forward: selects the largest region that this function has not selected yet, and starts again after all.
  /// Backward: selects the previous one.
  void selectBySize(bool forward);

  [[nodiscard]] RegionId hovered() const { return hovered_; }
  /// In the order of selection.
  [[nodiscard]] const std::vector<RegionId>& selected() const { return selected_; }
  [[nodiscard]] bool isSelected(RegionId region) const;

  /// Null if there is no such region.
  [[nodiscard]] const RegionInfo* info(RegionId region) const;
  [[nodiscard]] const RegionInfos& infos() const { return *infos_; }
  [[nodiscard]] std::set<RegionId> background() const;
  /// Regions that look like background and that nobody marked, by rising number.
  [[nodiscard]] std::vector<RegionId> proposedBackground() const;
  /// Its name, or "Region 12".
  [[nodiscard]] QString title(RegionId region) const;
  [[nodiscard]] static QString titleWithoutName(RegionId region) { return tr("Region %1").arg(region.value); }

 signals:
  void hoverChanged();
  void selectionChanged();
  void infosChanged();

 private:
  void applyChanges(const std::vector<RegionChange>& changes);
  /// The region that holds most of these fragments now.
  [[nodiscard]] RegionId currentRegionOf(const std::vector<FragmentId>& fragments) const;
  void storeFragments();

  std::shared_ptr<const RegionInfos> infos_ = std::make_shared<RegionInfos>();
  std::vector<RegionId> region_of_;  // by fragment
  RegionId hovered_;
  std::vector<RegionId> selected_;
  std::vector<RegionId> visited_;                   // by selectBySize(), in order
  std::vector<std::vector<FragmentId>> fragments_;  // of selected_, at the time of selection
};

}  // namespace scantrove
