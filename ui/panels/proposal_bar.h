#pragma once
#include <QFrame>

class QAction;
class QLabel;

namespace scantrove {

class RegionProposals;

/// Asks, one after the other, whether what looks alike bears the same name. Hidden while there is nothing to
/// ask.
class ProposalBar : public QFrame {
  Q_OBJECT

 public:
  /// `proposals` outlives this. The actions are the bar's buttons.
  ProposalBar(RegionProposals& proposals, QAction* accept, QAction* accept_all, QAction* reject,
              QWidget* parent = nullptr);
  [[nodiscard]] QString text() const;

 private:
  void update();

  RegionProposals& proposals_;
  QLabel* text_;
};

}  // namespace scantrove
