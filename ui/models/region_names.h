#pragma once
#include <QStringList>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/catalogue/catalogue_model.h"
#include "core/editing/operation.h"
#include "ui/models/region_selection.h"
#include "ui/models/typed_name.h"

namespace scantrove {

/// A name that a user gives a region.
struct RegionName {
  RegionId region;
  GivenName given;
};

/// The names of the catalogue and of the scan's regions, to complete what a user types for some regions
/// (completeName). Regions that are no objects of the catalogue yet count as objects of their names.
class RegionNames {
 public:
  /// `selection` outlives this.
  explicit RegionNames(const RegionSelection& selection) : selection_(selection) {}

  /// Prepares the completion of names for `regions`. `catalogue`: as it is now.
  void begin(CatalogueModel catalogue, std::vector<RegionId> regions);

  struct Completion {
    std::vector<RegionName> another;  ///< no other object has one of these names
    std::vector<RegionName> same;     ///< all regions get the name as typed
    TypedName typed;
  };
  /// After begin(). Error: as completeName().
  [[nodiscard]] Result<Completion> complete(const QString& text) const;
  /// Names and classes to offer while the user types.
  [[nodiscard]] QStringList known() const;

  // Names that the scan has not stored yet.

  void noteGiven(const RegionName& name) { given_[name.region] = {name.given, false}; }
  /// The scan has done the operation, or it failed.
  void noteDone(const Operation& operation);
  /// The regions of the selection are up to date: they include all operations that were done.
  void noteUpdated();
  void forgetGiven() { given_.clear(); }

 private:
  struct Given {
    GivenName name;
    bool is_done = false;
  };
  /// The object of the catalogue, or a stand-in for a region that is none.
  [[nodiscard]] ObjectId objectOf(const CatalogueModel& catalogue, RegionId region) const;
  void addNamesOfRegions();

  const RegionSelection& selection_;
  CatalogueModel catalogue_;  // with stand-ins for named regions that are no objects
  std::vector<RegionId> regions_;
  std::map<RegionId, Given> given_;
};

}  // namespace scantrove
