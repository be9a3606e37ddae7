#pragma once
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/catalogue/object_class.h"
#include "core/dataset/export_instances.h"
#include "core/dataset/labeled_scan.h"

namespace scantrove {

/// A category of a data set.
struct DatasetCategory {
  std::uint32_t id = 0;  ///< of the class in the catalogue, or a later one
  std::string name;      ///< valid UTF-8
  std::string supercategory = {};
  ClassColor color{};  ///< of the class, or the usual one of its id

  bool operator==(const DatasetCategory&) const = default;
};

/// The categories of a data set. Ids of classes are those of the catalogue, in each export:
/// - All visible classes of the catalogue, used or not, and hidden ones that a region has.
/// - Regions without class in the catalogue have the visible class of the name that classOf() gives. Other
///   such names follow in alphabetical order, with ids after the largest one of the catalogue.
class CategoryList {
 public:
  /// `classes`: LabeledScan::classes().
  CategoryList(const std::vector<ObjectClass>& classes, const std::vector<LabeledRegion>& regions);

  /// Ascending by id.
  [[nodiscard]] const std::vector<DatasetCategory>& all() const { return categories_; }
  /// Index into all() of the category of one of the regions, or of an instance of them.
  [[nodiscard]] std::size_t indexOf(const LabeledRegion& region) const;
  [[nodiscard]] std::size_t indexOf(const ExportInstance& instance) const {
    return indexOf(instance.class_id, instance.class_name);
  }
  [[nodiscard]] std::uint32_t idOf(const LabeledRegion& region) const {
    return categories_[indexOf(region)].id;
  }

 private:
  [[nodiscard]] std::size_t indexOf(ClassId id, const std::string& name) const;

  std::vector<DatasetCategory> categories_;
  std::map<std::uint32_t, std::size_t> by_id_;
  std::map<std::string, std::size_t> by_name_;  // of visible classes and of other names
};

}  // namespace scantrove
