#include "ui/panels/server_dialog.h"

#include <QComboBox>
#include <QDialogButtonBox>
#include <QFormLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QThread>
#include <QVBoxLayout>
#include <algorithm>
#include <memory>
#include <optional>

#include "core/catalogue/catalogue_probe.h"

namespace scantrove {

ServerDialog::ServerDialog(const QStringList& recent, QWidget* parent)
    : QDialog(parent),
      address_(new QComboBox),
      answer_(new QLabel),
      buttons_(new QDialogButtonBox(QDialogButtonBox::Cancel)),
      test_(buttons_->addButton(tr("&Test"), QDialogButtonBox::ActionRole)),
      connect_(buttons_->addButton(tr("&Connect"), QDialogButtonBox::AcceptRole)) {
  setWindowTitle(tr("Connect to catalogue"));
  setMinimumWidth(560);
  address_->setObjectName(QStringLiteral("serverAddress"));
  answer_->setObjectName(QStringLiteral("serverAnswer"));
  test_->setObjectName(QStringLiteral("serverTest"));
  connect_->setObjectName(QStringLiteral("serverConnect"));
  address_->setEditable(true);
  address_->addItems(recent);
  address_->setCurrentText(recent.value(0));
  address_->lineEdit()->setPlaceholderText(QStringLiteral("postgresql://user@host:5432/database"));
  answer_->setTextFormat(Qt::PlainText);
  answer_->setWordWrap(true);
  answer_->setText(
      tr("Several scanners can share a catalogue on a PostgreSQL server. The password does not "
         "belong here: put it into ~/.pgpass."));
  auto* form = new QFormLayout;
  form->addRow(tr("&Address"), address_);
  auto* all = new QVBoxLayout(this);
  all->addLayout(form);
  all->addWidget(answer_);
  all->addWidget(buttons_);
  connect(address_, &QComboBox::editTextChanged, this, &ServerDialog::validate);
  connect(test_, &QPushButton::clicked, this, [this] { probe(Then::show); });
  connect(connect_, &QPushButton::clicked, this, [this] { probe(Then::accept); });
  connect(buttons_, &QDialogButtonBox::rejected, this, &QDialog::reject);
  validate();
}

ServerDialog::~ServerDialog() {
  if (thread_) thread_->wait();  // a few seconds at most
}

QString ServerDialog::address() const { return address_->currentText().trimmed(); }

void ServerDialog::validate() {
  const bool is_ready = !thread_ && !address().isEmpty();
  test_->setEnabled(is_ready);
  connect_->setEnabled(is_ready);
  connect_->setDefault(true);
}

void ServerDialog::probe(Then then) {
  if (thread_ || address().isEmpty()) return;
  auto found = std::make_shared<std::optional<Result<CatalogueProbe>>>();
  thread_.reset(
      QThread::create([found, asked = address().toStdString()] { found->emplace(probeCatalogue(asked)); }));
  connect(thread_.get(), &QThread::finished, this, [this, found, then] {
    thread_->wait();
    // Deleted later, because this is one of its signals.
    thread_.release()->deleteLater();
    const Result<CatalogueProbe>& answer = **found;
    if (!answer) return showAnswer(QString::fromStdString(answer.error().message()), false, then);
    showAnswer(answer->is_new
                   ? tr("The server answers. A new catalogue is created in this database.")
                   : tr("The server answers. The catalogue holds %n objects.", nullptr, answer->objects),
               true, then);
  });
  address_->setEnabled(false);
  answer_->setText(tr("Connecting…"));
  validate();
  thread_->start();
}

void ServerDialog::showAnswer(const QString& text, bool is_usable, Then then) {
  address_->setEnabled(true);
  answer_->setText(text);
  // An answer may have more lines than the hint, and a window keeps its height by itself.
  answer_->setMinimumHeight(answer_->heightForWidth(answer_->width()));
  layout()->activate();
  resize(width(), std::max(height(), layout()->totalMinimumSize().height()));
  validate();
  // The buttons were off, so that the focus went to Cancel.
  (is_usable ? static_cast<QWidget*>(connect_) : address_)->setFocus();
  if (is_usable && then == Then::accept) accept();
}

}  // namespace scantrove
