#pragma once
#include <QFrame>

class QAction;
class QLabel;

namespace scantrove {

class RegionProposals;

/// Shows name suggestions for similar regions, one at a time. Hidden while there are none.
class ProposalBar : public QFrame {
  Q_OBJECT

 public:
  /// `proposals` outlives the bar. The actions are its buttons.
  ProposalBar(RegionProposals& proposals, QAction* accept, QAction* accept_all, QAction* reject,
              QWidget* parent = nullptr);
  [[nodiscard]] QString text() const;

 private:
  void update();

  RegionProposals& proposals_;
  QLabel* text_;
};

}  // namespace scantrove
