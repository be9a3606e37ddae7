#include "ui/scene/on_top.h"

#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkShaderProperty.h>

namespace scantrove {

vtkSmartPointer<vtkActor> addOnTop(vtkRenderer* renderer, vtkPolyData* data) {
  auto actor = vtkSmartPointer<vtkActor>::New();
  const auto mapper = vtkSmartPointer<vtkPolyDataMapper>::New();
  mapper->SetInputData(data);
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  actor->GetProperty()->SetLineWidth(3);
  actor->PickableOff();
  actor->VisibilityOff();
  // Depth nearer than everything else, but still ordered among these actors.
  actor->GetShaderProperty()->AddFragmentShaderReplacement(
      "//VTK::Depth::Impl", true, "  gl_FragDepth = 0.001 * gl_FragCoord.z;\n", false);
  renderer->AddActor(actor);
  return actor;
}

}  // namespace scantrove
