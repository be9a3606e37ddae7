#include "ui/painting/image_page.h"

#include <QAction>
#include <QVBoxLayout>

#include "ui/painting/image_canvas.h"
#include "ui/painting/image_view_bar.h"
#include "ui/painting/paint_tool_bar.h"

namespace scantrove {

ImagePage::ImagePage(QWidget* parent)
    : QWidget(parent), tools_(new PaintToolBar), view_(new ImageViewBar), canvas_(new ImageCanvas) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  column->addWidget(tools_);
  column->addWidget(view_);
  column->addWidget(canvas_, 1);
  // Keys of tools work in the image alone.
  for (QAction* action : tools_->keyActions() + view_->keyActions()) canvas_->addAction(action);
  canvas_->setEmptyText(tr("There is no such picture of this frame."));
}

}  // namespace scantrove
