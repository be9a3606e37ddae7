#pragma once
#include <QAction>
#include <QList>
#include <QObject>

namespace scantrove {

/// Actions on the selected regions, with keys that work while the 3D view or a picture has the focus.
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
  QAction* mark_supports;  ///< all that are proposed as background
  QAction* next;
  QAction* previous;
  QAction* fit;
  QAction* deselect;
  QList<QAction*> recent;  ///< names on 1 to 9

  /// All actions on the selection, in menu order.
  [[nodiscard]] QList<QAction*> onSelection() const;
  [[nodiscard]] QList<QAction*> all() const;
  /// Enables actions for `count` regions; the states are those of the first region.
  void enableFor(std::size_t count, bool is_background, bool is_rejected);
  /// `any`: there are suggestions.
  void enableProposals(bool any);
  /// `any`: there are supports that nobody marked.
  void enableSupports(bool any) { mark_supports->setEnabled(any); }
  void setRecentNames(const QStringList& names);

 private:
  QAction* make(const char* picture, const QString& text, const QList<QKeySequence>& keys,
                const QString& help);
};

}  // namespace scantrove
