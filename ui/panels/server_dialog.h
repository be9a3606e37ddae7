#pragma once
#include <QDialog>
#include <QString>
#include <QStringList>
#include <memory>

class QComboBox;
class QDialogButtonBox;
class QLabel;
class QPushButton;
class QThread;

namespace scantrove {

/// Dialog for connecting to a catalogue on a PostgreSQL server. It tries the address on a thread of its own,
/// and closes with Connect only when a catalogue can be opened there.
class ServerDialog : public QDialog {
  Q_OBJECT

 public:
  /// `recent`: addresses to choose from, the newest first.
  explicit ServerDialog(const QStringList& recent, QWidget* parent = nullptr);
  ~ServerDialog() override;

  [[nodiscard]] QString address() const;

 private:
  enum class Then { show, accept };
  void probe(Then then);
  /// Shows the answer of a probe.
  void showAnswer(const QString& text, bool is_usable, Then then);
  void validate();

  QComboBox* address_;
  QLabel* answer_;
  QDialogButtonBox* buttons_;
  QPushButton* test_;
  QPushButton* connect_;
  std::unique_ptr<QThread> thread_;  // of the probe; null: none runs
};

}  // namespace scantrove
