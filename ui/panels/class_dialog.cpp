#include "ui/panels/class_dialog.h"

#include <QColorDialog>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QInputDialog>
#include <QLabel>
#include <QPushButton>
#include <QScopedValueRollback>
#include <QTableWidget>
#include <QTimer>
#include <QVBoxLayout>
#include <algorithm>
#include <set>

#include "ui/models/attribute_text.h"
#include "ui/models/catalogue_editor.h"
#include "ui/panels/file_dialogs.h"

namespace scantrove {
namespace {

constexpr int kUpdateInterval_ms = 100;  // a running scan changes the catalogue often

QColor colorOf(const ObjectClass& one) { return {one.color[0], one.color[1], one.color[2]}; }

}  // namespace

ClassDialog::ClassDialog(CatalogueEditor& editor, QWidget* parent)
    : QDialog(parent), editor_(editor), table_(new QTableWidget(0, kObjects + 1)), message_(new QLabel) {
  setObjectName(QStringLiteral("classDialog"));
  setWindowTitle(tr("Classes"));
  table_->setHorizontalHeaderLabels(
      {tr("Id"), tr("Colour"), tr("Name"), tr("Supercategory"), tr("Attributes"), tr("Objects")});
  table_->verticalHeader()->hide();
  table_->setSelectionBehavior(QAbstractItemView::SelectRows);
  table_->horizontalHeader()->setSectionResizeMode(kAttributes, QHeaderView::Stretch);
  table_->horizontalHeaderItem(kAttributes)
      ->setToolTip(tr("What the class asks about its objects, such as: material: wood, steel; "
                      "broken: yes/no; remark"));
  table_->setAccessibleName(tr("Classes"));
  message_->setWordWrap(true);
  message_->setTextFormat(Qt::PlainText);
  message_->setProperty("muted", true);
  auto* column = new QVBoxLayout(this);
  column->addWidget(table_, 1);
  column->addWidget(message_);
  column->addWidget(makeButtons());
  connect(table_, &QTableWidget::itemChanged, this, [this](QTableWidgetItem* item) { edited(*item); });
  connect(table_, &QTableWidget::itemSelectionChanged, this, &ClassDialog::updateButtons);
  connect(table_, &QTableWidget::cellDoubleClicked, this, [this](int row, int of_column) {
    if (of_column == kColor) chooseColor(row);
  });
  connect(&editor, &CatalogueEditor::opened, this, &ClassDialog::readClasses);
  connect(&editor, &CatalogueEditor::changed, this, [this] {
    if (isVisible() && !update_timer_.isActive()) update_timer_.start(kUpdateInterval_ms);
  });
  update_timer_.setSingleShot(true);
  connect(&update_timer_, &QTimer::timeout, this, [this] {
    // Rows must not change below a text that is being typed.
    const QWidget* const field = focusWidget();
    const bool is_typing = field != nullptr && field != table_ && table_->isAncestorOf(field);
    return is_typing ? update_timer_.start(kUpdateInterval_ms) : readClasses();
  });
  // A refused text goes back to what the catalogue has.
  connect(&editor, &CatalogueEditor::failed, this, [this](const QString& text) {
    message_->setText(text);
    QTimer::singleShot(0, this, &ClassDialog::readClasses);
  });
  readClasses();
  resize(760, 460);
}

QWidget* ClassDialog::makeButtons() {
  auto* buttons = new QWidget;
  auto* row = new QHBoxLayout(buttons);
  row->setContentsMargins(0, 0, 0, 0);
  const auto make = [this, row](const QString& text, const QString& help, auto&& slot) {
    auto* button = new QPushButton(text);
    button->setToolTip(help);
    button->setAutoDefault(false);  // Return edits cells
    connect(button, &QPushButton::clicked, this, slot);
    row->addWidget(button);
    return button;
  };
  make(tr("&Add…"), tr("Add a class"), [this] {
    auto* dialog = new QInputDialog(this);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setWindowTitle(tr("Add class"));
    dialog->setLabelText(tr("Name of the class"));
    connect(dialog, &QInputDialog::textValueSelected, this,
            [this](const QString& name) { editor_.add(name); });
    dialog->open();
  });
  merge_ = make(tr("&Merge"), tr("The selected classes become the one that is current"),
                [this] { mergeSelected(); });
  hide_ = make(tr("&Delete"), tr("Delete classes that no object has"), [this] { hideSelected(); });
  row->addStretch(1);
  make(tr("&Import…"), tr("Add and update classes from a JSON or CSV file"), [this] {
    const QString file = chooseFile(this, tr("List of classes"), tr("Lists of classes (*.json *.csv)"));
    if (!file.isEmpty()) importFrom(file);
  });
  make(tr("&Export…"), tr("Write all classes to a new JSON or CSV file"), [this] {
    const QString file =
        chooseFileToSave(this, tr("New list of classes"), {}, tr("Lists of classes (*.json *.csv)"));
    if (!file.isEmpty()) exportTo(file);
  });
  make(tr("&Close"), {}, [this] { close(); });
  return buttons;
}

void ClassDialog::readClasses() {
  const QScopedValueRollback filling(is_filling_, true);
  const std::vector<ClassId> selected = selection();
  const auto idsOf = [](const std::vector<ListedClass>& listed) {
    std::vector<ClassId> ids;
    for (const ListedClass& one : listed) ids.push_back(one.object_class.id);
    return ids;
  };
  const std::vector<ClassId> before = idsOf(classes_);
  classes_ = editor_.classes();
  table_->setRowCount(static_cast<int>(classes_.size()));
  for (int row = 0; row < table_->rowCount(); ++row) fillRow(row);
  if (before != idsOf(classes_)) {
    table_->clearSelection();
    for (int row = 0; row < table_->rowCount(); ++row) {
      if (std::ranges::find(selected, classAt(row)->object_class.id) == selected.end()) continue;
      table_->selectionModel()->select(table_->model()->index(row, 0),
                                       QItemSelectionModel::Select | QItemSelectionModel::Rows);
    }
  }
  updateButtons();
}

void ClassDialog::fillRow(int row) {
  // Cells stay where their text does: the user may be typing in one.
  const auto fill = [this, row](Column column, const QString& text) {
    QTableWidgetItem* item = table_->item(row, column);
    if (item == nullptr) {
      const bool is_editable = column == kName || column == kSupercategory || column == kAttributes;
      item = new QTableWidgetItem(text);
      if (!is_editable) item->setFlags(item->flags() & ~Qt::ItemIsEditable);
      table_->setItem(row, column, item);
    } else if (item->text() != text) {
      item->setText(text);
    }
    return item;
  };
  const auto& [one, objects] = classes_[static_cast<std::size_t>(row)];
  fill(kId, QString::number(one.id.value));
  QTableWidgetItem* const color = fill(kColor, QString::fromStdString(hexOf(one.color)));
  color->setBackground(colorOf(one));
  color->setForeground(QColor(colorOf(one).lightness() > 127 ? Qt::black : Qt::white));
  color->setToolTip(tr("Double click to change the colour"));
  fill(kName, QString::fromStdString(one.name));
  fill(kSupercategory, QString::fromStdString(one.supercategory));
  fill(kAttributes, attributesToText(one.attributes));
  fill(kObjects, QString::number(objects));
}

const ListedClass* ClassDialog::classAt(int row) const {
  return row >= 0 && static_cast<std::size_t>(row) < classes_.size()
             ? &classes_[static_cast<std::size_t>(row)]
             : nullptr;
}

void ClassDialog::edited(const QTableWidgetItem& item) {
  const ListedClass* const listed = classAt(item.row());
  if (is_filling_ || listed == nullptr) return;
  ClassDraft draft;
  draft.id = listed->object_class.id;
  const std::string text = item.text().toStdString();
  if (item.column() == kName) {
    draft.name = text;
  } else if (item.column() == kSupercategory) {
    draft.supercategory = text;
  } else if (item.column() == kAttributes) {
    const Result<std::vector<ClassAttribute>> attributes = attributesFromText(item.text());
    if (!attributes) {
      message_->setText(QString::fromStdString(attributes.error().message()));
      QTimer::singleShot(0, this, &ClassDialog::readClasses);
      return;
    }
    draft.attributes = *attributes;
  }
  message_->clear();
  // Later: rows must not change within the signal of one of them.
  QTimer::singleShot(0, this, [this, draft] {
    editor_.edit(draft);
    readClasses();
  });
}

void ClassDialog::chooseColor(int row) {
  const ListedClass* const listed = classAt(row);
  if (listed == nullptr) return;
  auto* dialog = new QColorDialog(colorOf(listed->object_class), this);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setOption(QColorDialog::DontUseNativeDialog);
  connect(dialog, &QColorDialog::colorSelected, this,
          [this, id = listed->object_class.id](const QColor& color) {
            ClassDraft draft;
            draft.id = id;
            draft.color =
                ClassColor{static_cast<std::uint8_t>(color.red()), static_cast<std::uint8_t>(color.green()),
                           static_cast<std::uint8_t>(color.blue())};
            editor_.edit(draft);
          });
  dialog->open();
}

void ClassDialog::showEvent(QShowEvent* event) {
  readClasses();
  QDialog::showEvent(event);
}

std::vector<ClassId> ClassDialog::selection() const {
  std::set<int> rows;
  for (const QModelIndex& index : table_->selectionModel()->selectedIndexes()) rows.insert(index.row());
  std::vector<ClassId> selected;
  for (const int row : rows) {
    if (const ListedClass* listed = classAt(row)) selected.push_back(listed->object_class.id);
  }
  return selected;
}

void ClassDialog::mergeSelected() {
  std::vector<ClassId> from = selection();
  const ListedClass* const current = classAt(table_->currentRow());
  if (from.size() < 2) return;
  const ClassId into = current != nullptr && std::ranges::find(from, current->object_class.id) != from.end()
                           ? current->object_class.id
                           : from.front();
  std::erase(from, into);
  editor_.merge(from, into);
}

void ClassDialog::hideSelected() {
  if (const std::vector<ClassId> selected = selection(); !selected.empty()) editor_.hide(selected);
}

void ClassDialog::importFrom(const QString& file) {
  const std::optional<ClassImport> imported = editor_.importFrom(file);
  if (!imported) return;
  QStringList lines{tr("%1 added, %2 updated, %3 unchanged.")
                        .arg(imported->added)
                        .arg(imported->updated)
                        .arg(imported->unchanged)};
  for (const std::string& conflict : imported->conflicts) lines << QString::fromStdString(conflict);
  message_->setText(lines.join(QLatin1Char('\n')));
}

void ClassDialog::exportTo(const QString& file) {
  if (editor_.exportTo(file))
    message_->setText(tr("%n classes written to %1.", nullptr, static_cast<int>(classes_.size())).arg(file));
}

QString ClassDialog::message() const { return message_->text(); }

void ClassDialog::updateButtons() {
  const std::vector<ClassId> selected = selection();
  merge_->setEnabled(selected.size() > 1);
  hide_->setEnabled(!selected.empty());
}

}  // namespace scantrove
