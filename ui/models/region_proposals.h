#pragma once
#include <QObject>
#include <QString>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "core/base/ids.h"
#include "core/discovery/region_appearance.h"

namespace scantrove {

/// A region similar to one that was just named.
struct Proposal {
  RegionId region;
  QString name, category;
  float likeness = 0;  ///< 0 .. 1
  Eigen::Vector3f size_m = Eigen::Vector3f::Zero();
};

/// Proposes regions similar to a named one for the same name, most similar first. If the user rejects a
/// region, neither it nor regions of the same appearance are proposed for that name again, in this or later
/// scans.
class RegionProposals : public QObject {
  Q_OBJECT

 public:
  using Appearances = std::map<RegionId, RegionAppearance>;

  explicit RegionProposals(QObject* parent = nullptr);

  /// `named` got a name; `appearances`: of the regions that may get it too, and of `named`.
  void propose(RegionId named, const QString& name, const QString& category, const Appearances& appearances);
  /// Removes all open proposals; rejections remain.
  void withdraw();
  /// For a new scan: removes open proposals and the rejections of regions of the old scan.
  void clear();

  [[nodiscard]] const std::vector<Proposal>& open() const { return open_; }
  [[nodiscard]] const Proposal* first() const { return open_.empty() ? nullptr : &open_.front(); }
  /// Removes and returns the first proposal, or all; the caller names them.
  [[nodiscard]] std::vector<Proposal> acceptFirst();
  [[nodiscard]] std::vector<Proposal> acceptAll();
  void rejectFirst();
  /// Removes the proposal of a region that changed.
  void drop(RegionId region);

 signals:
  void changed();

 private:
  struct Rejection {
    QString name;
    RegionAppearance appearance;
  };
  [[nodiscard]] bool isRejected(const QString& name, RegionId region, const RegionAppearance& appearance,
                                float likeness_to_named) const;
  void load();
  void save() const;

  std::vector<Proposal> open_;
  Appearances observations_;                         // appearances of open_
  std::set<std::pair<RegionId, QString>> rejected_;  // regions of this scan
  std::vector<Rejection> rejections_;                // stored between runs, oldest first
};

/// "87 %, 11 x 9 x 8 cm"
[[nodiscard]] QString reasonOf(const Proposal& proposal);

}  // namespace scantrove
