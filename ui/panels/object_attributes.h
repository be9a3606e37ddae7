#pragma once
#include <QWidget>
#include <vector>

#include "core/base/ids.h"
#include "ui/models/object_answers.h"

class QFormLayout;
class QLabel;

namespace scantrove {

/// The questions of an object's class, with fields for the answers.
class ObjectAttributes : public QWidget {
  Q_OBJECT

 public:
  /// `editor` outlives it.
  explicit ObjectAttributes(CatalogueEditor& editor, QWidget* parent = nullptr);

  /// Reads questions and answers; fields stay where the questions do, because the user may be typing in one.
  void showObject(ObjectId object);

 private:
  [[nodiscard]] QWidget* makeField(const ObjectQuestion& question);
  void fill(QWidget& field, const QString& answer);
  void give(const QString& attribute, const QString& answer);

  ObjectAnswers answers_;
  QFormLayout* form_;
  QLabel* note_;
  ObjectId object_;
  std::vector<ObjectQuestion> questions_;
  std::vector<QWidget*> fields_;  ///< of questions_
};

}  // namespace scantrove
