#pragma once
#include <vtkActor.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

class vtkRenderer;

namespace scantrove {

/// Adds an actor that is seen through everything, unlit, not yet visible.
[[nodiscard]] vtkSmartPointer<vtkActor> addOnTop(vtkRenderer* renderer, vtkPolyData* data);

}  // namespace scantrove
