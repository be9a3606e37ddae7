#pragma once
#include <QFrame>
#include <QString>
#include <QStringList>

class QLabel;
class QLineEdit;
class QStringListModel;

namespace scantrove {

/// A field beside the pointer in which what is selected gets a name: "red cup", or "cup/red cup" with its
/// category. Offers the names that are known. Return gives the name, Escape gives it up; leaving the field
/// gives it too, when something was typed. What is typed stays whatever the scan does.
class RegionNameEditor : public QFrame {
  Q_OBJECT

 public:
  explicit RegionNameEditor(QWidget* parent);

  /// `on_screen`: beside which it opens. `known`: names to offer.
  void begin(const QPoint& on_screen, const QString& text, const QStringList& known, const QString& about);
  [[nodiscard]] bool isOpen() const { return isVisible(); }
  [[nodiscard]] QLineEdit* field() const { return field_; }

 signals:
  /// Empty: it has none any more.
  void named(const QString& name, const QString& category);
  void closed();

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void finish();
  void cancel();

  QLabel* about_;
  QLineEdit* field_;
  QStringListModel* known_;
  QString before_;
};

}  // namespace scantrove
