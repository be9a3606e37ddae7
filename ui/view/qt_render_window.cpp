#include "ui/view/qt_render_window.h"

#include <vtkCallbackCommand.h>
#include <vtkOpenGLFramebufferObject.h>
#include <vtkOpenGLState.h>

#include <QOpenGLExtraFunctions>
#include <cstring>
#include <vector>

namespace scantrove {
namespace {

/// The OpenGL that VTK needs.
QSurfaceFormat surfaceFormat() {
  QSurfaceFormat format;
  format.setRenderableType(QSurfaceFormat::OpenGL);
  format.setVersion(3, 2);
  format.setProfile(QSurfaceFormat::CoreProfile);
  format.setRedBufferSize(8);
  format.setGreenBufferSize(8);
  format.setBlueBufferSize(8);
  format.setAlphaBufferSize(8);
  format.setDepthBufferSize(24);
  format.setStencilBufferSize(8);
  format.setSamples(0);
  return format;
}

}  // namespace

QtRenderWindow::QtRenderWindow(vtkRenderer* renderer) {
  context_.setFormat(surfaceFormat());
  if (!context_.create()) return;
  surface_.setFormat(context_.format());
  surface_.create();
  if (!context_.makeCurrent(&surface_)) return;
  window_ = vtkSmartPointer<vtkGenericOpenGLRenderWindow>::New();
  window_->SetOwnContext(0);
  window_->SetFrameBlitModeToNoBlit();
  window_->SetMultiSamples(0);
  window_->SetReadyForRendering(true);
  window_->SetMapped(1);
  window_->SetIsDirect(1);
  window_->SetSupportsOpenGL(1);
  observe(vtkCommand::WindowMakeCurrentEvent, onMakeCurrent);
  observe(vtkCommand::WindowIsCurrentEvent, onIsCurrent);
  window_->AddRenderer(renderer);
  window_->OpenGLInitContext();
  draw({16, 16});  // the first drawing is slow, so it is done before the user waits for one
}

QtRenderWindow::~QtRenderWindow() {
  if (!works()) return;
  makeCurrent();
  window_->Finalize();
}

void QtRenderWindow::observe(unsigned long event, Callback callback) {
  const auto command = vtkSmartPointer<vtkCallbackCommand>::New();
  command->SetCallback(callback);
  command->SetClientData(this);
  window_->AddObserver(event, command);
}

void QtRenderWindow::onMakeCurrent(vtkObject* /*caller*/, unsigned long /*event*/, void* client,
                                   void* /*data*/) {
  static_cast<QtRenderWindow*>(client)->makeCurrent();
}

void QtRenderWindow::onIsCurrent(vtkObject* /*caller*/, unsigned long /*event*/, void* client, void* data) {
  *static_cast<bool*>(data) =
      QOpenGLContext::currentContext() == &static_cast<QtRenderWindow*>(client)->context_;
}

void QtRenderWindow::makeCurrent() {
  if (works() && QOpenGLContext::currentContext() != &context_) context_.makeCurrent(&surface_);
}

void QtRenderWindow::draw(const QSize& pixels) {
  if (!works()) return;
  makeCurrent();
  window_->SetSize(pixels.width(), pixels.height());
  window_->SetScreenSize(pixels.width(), pixels.height());
  window_->Render();
}

QImage QtRenderWindow::picture(const QSize& pixels) {
  if (!works() || pixels.isEmpty()) return {};
  makeCurrent();
  vtkOpenGLState* const state = window_->GetState();
  state->PushReadFramebufferBinding();
  vtkOpenGLFramebufferObject* const drawn = window_->GetDisplayFramebuffer();
  drawn->Bind(GL_READ_FRAMEBUFFER);
  drawn->ActivateReadBuffer(0);
  // OpenGL's rows go upwards.
  QImage picture(pixels, QImage::Format_RGB32);
  const auto row_bytes = static_cast<std::size_t>(4) * static_cast<std::size_t>(pixels.width());
  std::vector<uchar> upwards(row_bytes * static_cast<std::size_t>(pixels.height()));
  context_.extraFunctions()->glReadPixels(0, 0, pixels.width(), pixels.height(), GL_BGRA,
                                          GL_UNSIGNED_INT_8_8_8_8_REV, upwards.data());
  for (int row = 0; row < pixels.height(); ++row)
    std::memcpy(picture.scanLine(pixels.height() - 1 - row),
                &upwards[static_cast<std::size_t>(row) * row_bytes], row_bytes);
  state->PopReadFramebufferBinding();
  return picture;
}

}  // namespace scantrove
