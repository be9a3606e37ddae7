#pragma once
#include <QAction>
#include <QList>
#include <QObject>

namespace scantrove {

/// What a person does to the regions that are selected, each with its key. The keys hold while the 3D view or
/// the pictures have the focus.
class RegionActions : public QObject {
  Q_OBJECT

 public:
  explicit RegionActions(QObject* parent);

  QAction* name;
  QAction* join;
  QAction* cut;
  QAction* finer;
  QAction* coarser;
  QAction* background;
  QAction* object;
  QAction* reject;
  QAction* accept;
  QAction* accept_all;
  QAction* not_this;
  QAction* next;
  QAction* previous;
  QAction* fit;
  QAction* deselect;
  QList<QAction*> recent;  ///< names on 1 to 9

  /// All that are about the selection, in the order of a menu.
  [[nodiscard]] QList<QAction*> onSelection() const;
  [[nodiscard]] QList<QAction*> all() const;
  /// What can be done with `count` regions; of the states those of the first.
  void enableFor(std::size_t count, bool is_background, bool is_rejected);
  /// Something is proposed.
  void enableProposals(bool any);
  void setRecentNames(const QStringList& names);

 private:
  QAction* make(const char* picture, const QString& text, const QList<QKeySequence>& keys,
                const QString& help);
};

}  // namespace scantrove
