#pragma once
#include <QFrame>
#include <QString>
#include <QStringList>

#include "ui/models/typed_name.h"

class QLabel;
class QLineEdit;
class QStringListModel;

namespace scantrove {

class SameNameChoice;

/// A field beside the pointer for naming the selected regions: "red cup", or "cup/red cup" with a class.
/// Completes known names and shows the class. If another object has the name, it offers two answers
/// (SameNameChoice). Return or leaving the field with a changed text applies the name, as another object
/// unless the user answers otherwise; Escape cancels. Not affected by the running scan.
class RegionNameEditor : public QFrame {
  Q_OBJECT

 public:
  explicit RegionNameEditor(QWidget* parent);

  /// What is edited.
  struct Begin {
    QPoint on_screen;  ///< it opens beside this place
    QString text;
    QStringList known;  ///< names for completion
    QString about;
    NameCheck check;
  };
  void begin(Begin what);
  /// As if the user had typed this.
  void type(const QString& text);
  [[nodiscard]] bool isOpen() const { return isVisible(); }
  [[nodiscard]] QLineEdit* field() const { return field_; }
  [[nodiscard]] SameNameChoice* choice() const { return choice_; }

 signals:
  /// An empty text removes the name.
  void accepted(const QString& text, scantrove::TypedName::Answer answer);
  void closed();

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void showClass(const QString& text);
  void uncoverAnswers();
  void place();
  [[nodiscard]] TypedName::Answer answerOf(Qt::KeyboardModifiers modifiers) const;
  void finish(TypedName::Answer answer);
  void cancel();

  QLabel* about_;
  QLineEdit* field_;
  QLabel* class_;
  SameNameChoice* choice_;
  QStringListModel* known_;
  QString before_;
  QPoint on_screen_;
  NameCheck check_;
};

}  // namespace scantrove
