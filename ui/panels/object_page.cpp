#include "ui/panels/object_page.h"

#include <QLabel>
#include <QListWidget>
#include <QPushButton>
#include <QScrollArea>
#include <QSplitter>
#include <QVBoxLayout>

#include "ui/models/object_list_model.h"
#include "ui/models/plain_text.h"
#include "ui/panels/object_attributes.h"
#include "ui/panels/object_head.h"

namespace scantrove {
namespace {

constexpr int kViewPicture_px = 110;

QLabel* headingOf(const QString& text) {
  auto* label = new QLabel(QStringLiteral("<b>%1</b>").arg(text));
  label->setContentsMargins(0, 10, 0, 0);
  return label;
}

}  // namespace

ObjectPage::ObjectPage(CatalogueEditor& editor, ObjectListModel& model, QWidget* model_view, QWidget* parent)
    : QDialog(parent),
      model_(model),
      head_(new ObjectHead(editor, model)),
      attributes_(new ObjectAttributes(editor)),
      scans_(new ScanLinks),
      alike_(new AlikeList),
      views_(new QListWidget),
      model_view_(model_view),
      model_note_(new QLabel),
      open_(new QPushButton) {
  setObjectName(QStringLiteral("objectPage"));
  auto* column = new QVBoxLayout(this);
  auto* parts = new QSplitter;
  parts->setChildrenCollapsible(false);
  parts->addWidget(makeTexts());
  parts->addWidget(makePictures(model_view));
  parts->setStretchFactor(1, 1);
  column->addWidget(parts);
  connect(&model_, &ObjectListModel::updated, this, &ObjectPage::readRow);
  connect(&model_, &QAbstractItemModel::modelReset, this, &ObjectPage::readRow);
  connect(&model_, &ObjectListModel::merged, this, [this](ObjectId into, ObjectId from) {
    if (object_ && object_ == from) setObject(into);
  });
  connect(scans_, &ScanLinks::requested, this, &ObjectPage::scanRequested);
  connect(open_, &QPushButton::clicked, this, [this] { emit scanRequested(folder_); });
  resize(900, 640);
}

QWidget* ObjectPage::makeTexts() {
  auto* texts = new QWidget;
  auto* column = new QVBoxLayout(texts);
  column->addWidget(head_);
  column->addWidget(headingOf(tr("Perhaps the same object")));
  column->addWidget(alike_);
  column->addWidget(headingOf(tr("Seen in")));
  column->addWidget(scans_);
  column->addWidget(headingOf(tr("Attributes")));
  column->addWidget(attributes_);
  column->addStretch(1);
  auto* scroll = new QScrollArea;
  scroll->setFrameShape(QFrame::NoFrame);
  scroll->setWidgetResizable(true);
  scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  scroll->setWidget(texts);
  scroll->setMinimumWidth(400);
  return scroll;
}

QWidget* ObjectPage::makePictures(QWidget* model_view) {
  auto* pictures = new QWidget;
  auto* column = new QVBoxLayout(pictures);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(model_view, 1);
  model_note_->setWordWrap(true);
  model_note_->setTextFormat(Qt::PlainText);
  model_note_->setProperty("muted", true);
  column->addWidget(model_note_);
  open_->setAutoDefault(false);
  open_->setText(tr("Open a scan with it"));
  column->addWidget(open_, 0, Qt::AlignLeft);
  views_->setViewMode(QListView::IconMode);
  views_->setIconSize({kViewPicture_px, kViewPicture_px});
  views_->setResizeMode(QListView::Adjust);
  views_->setMovement(QListView::Static);
  views_->setSpacing(4);
  views_->setMinimumHeight(kViewPicture_px / 2);
  views_->setAccessibleName(tr("Views of the object"));
  column->addWidget(views_, 1);
  return pictures;
}

void ObjectPage::setObject(ObjectId object) {
  const bool is_other = object != object_;
  object_ = object;
  if (is_other) {
    setViews({});
    scans_->setEntries({});
    alike_->setSearching();
    head_->showSides(std::nullopt, {});
    setModelNote(false, {}, {});
  }
  readRow();
}

void ObjectPage::readRow() {
  const ObjectRecord* const record = model_.record(object_);
  if (record == nullptr) {
    if (isVisible()) close();
    return;
  }
  setWindowTitle(tr("Object: %1").arg(QString::fromStdString(record->name)));
  head_->showObject(object_);
  attributes_->showObject(object_);
}

void ObjectPage::setViews(const std::vector<QImage>& pictures) {
  views_->clear();
  for (const QImage& picture : pictures) {
    // Crops of small things are enlarged: they are there to be judged.
    const QImage shown =
        picture.scaled(kViewPicture_px, kViewPicture_px, Qt::KeepAspectRatio, Qt::SmoothTransformation);
    auto* item = new QListWidgetItem(QIcon(QPixmap::fromImage(shown)), QString());
    item->setData(Qt::AccessibleTextRole, tr("View %1").arg(views_->count() + 1));
    views_->addItem(item);
  }
}

void ObjectPage::setModelNote(bool has_model, const QString& note, const QString& folder) {
  model_view_->setVisible(has_model);
  model_note_->setText(note);
  model_note_->setVisible(!note.isEmpty());
  folder_ = folder;
  open_->setVisible(!folder.isEmpty());
  open_->setToolTip(plainTip(folder));
}

QString ObjectPage::modelNote() const { return model_note_->text(); }

void ObjectPage::done(int result) {
  head_->finish();
  QDialog::done(result);
}

}  // namespace scantrove
