#include "ui/view/qt_render_window.h"

#include <vtkOpenGLFramebufferObject.h>
#include <vtkOpenGLState.h>

#include <QOpenGLExtraFunctions>

namespace scantrove {

void QtRenderWindow::draw(const QSize& pixels) {
  window_->SetSize(pixels.width(), pixels.height());
  window_->SetScreenSize(pixels.width(), pixels.height());
  // Qt changed OpenGL's state behind VTK's back.
  window_->GetState()->Reset();
  window_->GetState()->Push();
  window_->Render();
  window_->GetState()->Pop();
}

void QtRenderWindow::copyToWidget(const QSize& pixels) {
  window_->GetState()->Reset();
  QOpenGLExtraFunctions* gl = QOpenGLContext::currentContext()->extraFunctions();
  vtkOpenGLFramebufferObject* source = window_->GetDisplayFramebuffer();
  source->Bind(GL_READ_FRAMEBUFFER);
  source->ActivateReadBuffer(0);
  gl->glBindFramebuffer(GL_DRAW_FRAMEBUFFER, widget_.defaultFramebufferObject());
  gl->glDisable(GL_SCISSOR_TEST);
  gl->glBlitFramebuffer(0, 0, pixels.width(), pixels.height(), 0, 0, pixels.width(), pixels.height(),
                        GL_COLOR_BUFFER_BIT, GL_NEAREST);
  gl->glBindFramebuffer(GL_FRAMEBUFFER, widget_.defaultFramebufferObject());
  // VTK leaves transparency in the picture; the widget must be opaque.
  gl->glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_TRUE);
  gl->glClearColor(0, 0, 0, 1);
  gl->glClear(GL_COLOR_BUFFER_BIT);
  gl->glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

}  // namespace scantrove
