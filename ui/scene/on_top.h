#pragma once
#include <vtkActor.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

class vtkRenderer;

namespace scantrove {

/// Adds an unlit, initially hidden actor that is drawn on top of everything.
[[nodiscard]] vtkSmartPointer<vtkActor> addOnTop(vtkRenderer* renderer, vtkPolyData* data);

}  // namespace scantrove
