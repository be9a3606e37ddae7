#pragma once
#include <QObject>
#include <QPoint>
#include <QPointer>
#include <functional>

#include "ui/bridge/scan_bridge.h"
#include "ui/models/region_names.h"
#include "ui/panels/region_name_editor.h"

namespace scantrove {

class RegionActions;
class RegionOperations;

/// Naming of the selected regions: the field beside the pointer, recent names on 1 to 9, and the names for
/// similar regions. A name is completed to a name and a class. If another object has the name, the user
/// answers whether it is the same one.
class RegionNaming : public QObject {
  Q_OBJECT

 public:
  /// All of these outlive it; `window` is the parent of the field.
  RegionNaming(ScanBridge& bridge, RegionSelection& selection, RegionOperations& operations,
               RegionActions& actions, QWidget& window);

  /// Sets the source of the catalogue's present state.
  void setCatalogue(std::function<CatalogueModel()> catalogue) { catalogue_ = std::move(catalogue); }
  [[nodiscard]] RegionNameEditor& editor() { return *editor_; }

  void beginScan() { names_.forgetGiven(); }
  /// Opens the field for the selected regions.
  void edit(const QPoint& on_screen);
  /// Gives a recent name. If another object has it, the field opens with the question.
  void give(const QString& name, const QPoint& on_screen);
  /// Applies a name that is being typed.
  void finishEditing();

 private:
  void beginNames();
  void accept(const QString& text, TypedName::Answer answer);
  /// A name like `given` for another thing.
  [[nodiscard]] GivenName anotherName(RegionId region, const GivenName& given);
  void remember(const QString& name);

  RegionSelection& selection_;
  RegionOperations& operations_;
  RegionActions& actions_;
  RegionNames names_;
  RegionNameEditor* editor_;
  std::function<CatalogueModel()> catalogue_;
  std::vector<RegionId> regions_;  ///< that the field names
  QPointer<QWidget> focus_before_;
};

}  // namespace scantrove
