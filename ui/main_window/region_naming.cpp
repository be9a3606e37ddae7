#include "ui/main_window/region_naming.h"

#include <QApplication>
#include <QLineEdit>
#include <QSettings>
#include <algorithm>
#include <utility>

#include "ui/main_window/region_actions.h"
#include "ui/main_window/region_operations.h"

namespace scantrove {
namespace {

const QString kRecentNamesKey = QStringLiteral("names/recent");
constexpr int kRecentNames = 9;

/// "chair" of "seat/chair".
QString withoutClass(const QString& text) {
  const auto slash = text.indexOf(QLatin1Char('/'));
  const bool has_class = slash > 0 && slash + 1 < text.size();
  return has_class ? text.mid(slash + 1).trimmed() : text;
}

}  // namespace

RegionNaming::RegionNaming(ScanBridge& bridge, RegionSelection& selection, RegionOperations& operations,
                           RegionActions& actions, QWidget& window)
    : QObject(&window),
      selection_(selection),
      operations_(operations),
      actions_(actions),
      names_(selection),
      editor_(new RegionNameEditor(&window)) {
  connect(editor_, &RegionNameEditor::accepted, this, &RegionNaming::accept);
  connect(editor_, &RegionNameEditor::closed, this, [this] {
    if (focus_before_ != nullptr) focus_before_->setFocus(Qt::OtherFocusReason);
  });
  connect(&operations_, &RegionOperations::nameGiven, this,
          [this](const RegionName& name) { names_.noteGiven(name); });
  operations_.setOtherNames(
      [this](RegionId region, const GivenName& given) { return anotherName(region, given); });
  const auto noteDone = [this](const ScanEdit& edit) {
    if (const auto* const operation = std::get_if<Operation>(&edit)) names_.noteDone(*operation);
  };
  bridge.on<Edited>(this, [noteDone](const Edited& event) { noteDone(event.edit); });
  bridge.on<EditFailed>(this, [noteDone](const EditFailed& event) { noteDone(event.edit); });
  connect(&selection_, &RegionSelection::infosChanged, this, [this] { names_.noteUpdated(); });
  actions_.setRecentNames(QSettings().value(kRecentNamesKey).toStringList());
}

void RegionNaming::beginNames() {
  regions_ = selection_.selected();
  names_.begin(catalogue_ ? catalogue_() : CatalogueModel(), regions_);
}

void RegionNaming::edit(const QPoint& on_screen) {
  if (selection_.selected().empty()) return;
  if (editor_->isOpen()) finishEditing();
  beginNames();
  const RegionId region = regions_.front();
  const RegionInfo* const info = selection_.info(region);
  QString text;
  if (info != nullptr) {
    text = QString::fromStdString(info->name());
    if (!info->category().empty()) text = QString::fromStdString(info->category()) + QLatin1Char('/') + text;
  }
  QStringList known = QSettings().value(kRecentNamesKey).toStringList() + names_.known();
  known.removeDuplicates();
  focus_before_ = QApplication::focusWidget();
  const auto check = [this](const QString& typed) -> std::optional<TypedName> {
    const Result<RegionNames::Completion> completion = names_.complete(typed);
    return completion ? std::optional(completion->typed) : std::nullopt;
  };
  const auto count = static_cast<int>(regions_.size());
  editor_->begin(
      {on_screen, text, known,
       count > 1 ? tr("Name of %n regions", nullptr, count) : tr("Name of %1").arg(selection_.title(region)),
       check});
}

void RegionNaming::give(const QString& name, const QPoint& on_screen) {
  if (selection_.selected().empty() || name.isEmpty()) return;
  beginNames();
  const Result<RegionNames::Completion> completion = names_.complete(name);
  if (!completion || !completion->typed.is_taken) return accept(name, TypedName::Answer::another);
  edit(on_screen);
  editor_->type(name);
}

void RegionNaming::finishEditing() {
  if (editor_->isOpen()) editor_->field()->clearFocus();
}

void RegionNaming::accept(const QString& text, TypedName::Answer answer) {
  // If frames merged a region away meanwhile, the selection has followed.
  const bool is_any_gone =
      std::ranges::any_of(regions_, [this](RegionId region) { return selection_.info(region) == nullptr; });
  if (is_any_gone) beginNames();
  if (regions_.empty()) return;
  const Result<RegionNames::Completion> completion = names_.complete(text);
  std::vector<RegionName> names;
  if (completion) {
    names = answer == TypedName::Answer::same ? completion->same : completion->another;
  } else {
    // An empty name removes the name; for others the scan says what is wrong.
    for (const RegionId region : regions_) names.push_back({region, {text.trimmed().toStdString()}});
  }
  operations_.name(names);
  if (completion) remember(withoutClass(text.trimmed()));
}

GivenName RegionNaming::anotherName(RegionId region, const GivenName& given) {
  RegionNames names = names_;  // the field may be open
  names.begin(catalogue_ ? catalogue_() : CatalogueModel(), {region});
  const std::string text = given.class_name.empty() ? given.name : given.class_name + '/' + given.name;
  const Result<RegionNames::Completion> completion = names.complete(QString::fromStdString(text));
  return completion ? completion->another.front().given : given;
}

void RegionNaming::remember(const QString& name) {
  QStringList names = QSettings().value(kRecentNamesKey).toStringList();
  if (names.contains(name)) return;  // so that names keep their keys
  names.prepend(name);
  names = names.mid(0, kRecentNames);
  QSettings().setValue(kRecentNamesKey, names);
  actions_.setRecentNames(names);
  const std::vector<RegionId>& selected = selection_.selected();
  for (QAction* action : actions_.recent)
    action->setEnabled(!selected.empty() && !action->data().toString().isEmpty());
}

}  // namespace scantrove
