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

/// A region that looks like one that was just named.
struct Proposal {
  RegionId region;
  QString name, category;
  float likeness = 0;  ///< 0 .. 1
  Eigen::Vector3f size_m = Eigen::Vector3f::Zero();
};

/// What else may bear a name that was given: name once. Likest first, one after the other. What a person
/// rejects is not proposed under that name again, nor is what looks the same, in this scan and in later ones.
class RegionProposals : public QObject {
  Q_OBJECT

 public:
  using Appearances = std::map<RegionId, RegionAppearance>;

  explicit RegionProposals(QObject* parent = nullptr);

  /// `named` got a name; `looks`: of all that may get it too, and of `named`.
  void propose(RegionId named, const QString& name, const QString& category, const Appearances& looks);
  /// Nothing is asked any more; what was rejected stays rejected.
  void withdraw();
  /// Another scan begins: withdraws, and forgets what was rejected for regions of this one.
  void clear();

  [[nodiscard]] const std::vector<Proposal>& open() const { return open_; }
  [[nodiscard]] const Proposal* first() const { return open_.empty() ? nullptr : &open_.front(); }
  /// Takes the first one, or all, away: they are given their name.
  [[nodiscard]] std::vector<Proposal> acceptFirst();
  [[nodiscard]] std::vector<Proposal> acceptAll();
  void rejectFirst();
  /// The region is something else by now.
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
  Appearances observations_;                         // of open_
  std::set<std::pair<RegionId, QString>> rejected_;  // in this scan
  std::vector<Rejection> rejections_;                // for ever, oldest first
};

/// "87 %, 11 x 9 x 8 cm"
[[nodiscard]] QString reasonOf(const Proposal& proposal);

}  // namespace scantrove
