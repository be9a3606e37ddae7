#include "ui/scene/drawing_parts.h"

#include <vtkCuller.h>
#include <vtkObjectFactory.h>
#include <vtkProp.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <optional>
#include <utility>

namespace scantrove {

/// Removes the props of other parts from the renderer's list.
class DrawingParts::Culler final : public vtkCuller {
 public:
  static Culler* New() { return new Culler; }
  vtkTypeMacro(Culler, vtkCuller);
  Culler(const Culler&) = delete;
  void operator=(const Culler&) = delete;

  double Cull(vtkRenderer* /*renderer*/, vtkProp** props, int& count, int& /*initialised*/) override {
    if (drawn_part) {
      const auto isOfOther = [this](vtkProp* prop) {
        const auto found = part_of.find(prop);
        return (found == part_of.end() ? last_part : found->second) != *drawn_part;
      };
      count = static_cast<int>(std::remove_if(props, props + count, isOfOther) - props);
    }
    return count;
  }

  std::map<vtkProp*, std::size_t> part_of;
  std::optional<std::size_t> drawn_part;  ///< none: all
  std::size_t last_part = 0;

 private:
  Culler() = default;
};

DrawingParts::DrawingParts(vtkRenderer* renderer)
    : renderer_(renderer), culler_(vtkSmartPointer<Culler>::New()) {
  renderer_->AddCuller(culler_);
}

DrawingParts::~DrawingParts() { renderer_->RemoveCuller(culler_); }

void DrawingParts::begin(std::map<vtkProp*, std::size_t> part_of, std::size_t parts) {
  culler_->part_of = std::move(part_of);
  parts_ = std::max<std::size_t>(1, parts);
  culler_->last_part = parts_ - 1;
  part_ = 0;
  show();
}

bool DrawingParts::next() {
  if (++part_ >= parts_) {
    end();
    return false;
  }
  show();
  return true;
}

void DrawingParts::show() {
  culler_->drawn_part = part_;
  renderer_->SetPreserveColorBuffer(part_ > 0);
  renderer_->SetPreserveDepthBuffer(part_ > 0);
}

void DrawingParts::end() {
  culler_->drawn_part.reset();
  culler_->part_of.clear();
  renderer_->SetPreserveColorBuffer(false);
  renderer_->SetPreserveDepthBuffer(false);
}

}  // namespace scantrove
