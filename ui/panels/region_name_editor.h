#pragma once
#include <QFrame>
#include <QString>
#include <QStringList>

class QLabel;
class QLineEdit;
class QStringListModel;

namespace scantrove {

/// A field beside the pointer for naming the selected regions: "red cup", or "cup/red cup" with a category.
/// Completes known names. Return or leaving the field with a changed text applies the name; Escape cancels.
/// Not affected by the running scan.
class RegionNameEditor : public QFrame {
  Q_OBJECT

 public:
  explicit RegionNameEditor(QWidget* parent);

  /// Opens beside `on_screen`. `known`: names for completion.
  void begin(const QPoint& on_screen, const QString& text, const QStringList& known, const QString& about);
  [[nodiscard]] bool isOpen() const { return isVisible(); }
  [[nodiscard]] QLineEdit* field() const { return field_; }

 signals:
  /// An empty name removes the name.
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
