#include "ui/panels/proposal_bar.h"

#include <QAction>
#include <QHBoxLayout>
#include <QLabel>
#include <QToolButton>

#include "ui/models/region_proposals.h"

namespace scantrove {

ProposalBar::ProposalBar(RegionProposals& proposals, QAction* accept, QAction* accept_all, QAction* reject,
                         QWidget* parent)
    : QFrame(parent), proposals_(proposals), text_(new QLabel) {
  setObjectName(QStringLiteral("proposalBar"));
  setFrameShape(QFrame::StyledPanel);
  setAutoFillBackground(true);
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(12, 6, 8, 6);
  row->setSpacing(8);
  text_->setTextFormat(Qt::PlainText);
  row->addWidget(text_, 1);
  for (QAction* action : {accept, accept_all, reject}) {
    auto* button = new QToolButton;
    button->setDefaultAction(action);
    button->setToolButtonStyle(Qt::ToolButtonTextOnly);
    row->addWidget(button);
  }
  connect(&proposals_, &RegionProposals::changed, this, &ProposalBar::update);
  update();
}

QString ProposalBar::text() const { return text_->text(); }

void ProposalBar::update() {
  const Proposal* const first = proposals_.first();
  setVisible(first != nullptr);
  if (first == nullptr) return;
  const auto others = proposals_.open().size() - 1;
  QString text = tr("Is this a “%1” too? (%2)").arg(first->name, reasonOf(*first));
  if (others > 0) text += tr("  and %n more", nullptr, static_cast<int>(others));
  text_->setText(text);
}

}  // namespace scantrove
