#include "app/session_arguments.h"

#include "core/base/text.h"

namespace scantrove {
namespace {

/// "N:x,y" or "x,y".
struct PixelOfFrame {
  int frame = 0, x = 0, y = 0;
};

std::optional<PixelOfFrame> parsePixel(const std::string& text, int frame) {
  PixelOfFrame pixel{.frame = frame};
  std::string rest = text;
  if (const std::size_t colon = text.find(':'); colon != std::string::npos) {
    const auto number = parseNumbers(text.substr(0, colon));
    if (!number || number->size() != 1) return std::nullopt;
    pixel.frame = static_cast<int>(number->front());
    rest = text.substr(colon + 1);
  }
  const auto numbers = parseNumbers(rest);
  if (!numbers || numbers->size() != 2) return std::nullopt;
  pixel.x = static_cast<int>((*numbers)[0]);
  pixel.y = static_cast<int>((*numbers)[1]);
  return pixel;
}

}  // namespace

Result<OpenSession::SurfacePoint> surfacePointAt(OpenSession& session, const std::string& text, int frame) {
  const auto pixel = parsePixel(text, frame);
  if (!pixel)
    return fail("'" + text + "' is not a pixel.",
                "Write N:x,y (frame, column, row), for example 120:320,200.");
  return session.at(pixel->frame, pixel->x, pixel->y);
}

}  // namespace scantrove
