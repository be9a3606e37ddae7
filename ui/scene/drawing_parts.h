#pragma once
#include <vtkSmartPointer.h>

#include <cstddef>
#include <map>

class vtkProp;
class vtkRenderer;

namespace scantrove {

/// Lets a renderer draw some of its props now and others later, over what is there already: so that a drawing
/// that takes long need not be made at once. One thread.
class DrawingParts {
 public:
  explicit DrawingParts(vtkRenderer* renderer);
  ~DrawingParts();
  DrawingParts(const DrawingParts&) = delete;
  DrawingParts& operator=(const DrawingParts&) = delete;

  /// From now on each drawing is of one part, the first to begin with. Props that are not in `part_of` are
  /// drawn with the last one.
  void begin(std::map<vtkProp*, std::size_t> part_of, std::size_t parts);
  /// The next drawing is of the next part. False: that was the last one, and from now on all is drawn at
  /// once.
  bool next();
  /// All is drawn at once again.
  void end();

 private:
  class Culler;
  void show();

  vtkRenderer* renderer_;
  vtkSmartPointer<Culler> culler_;
  std::size_t part_ = 0, parts_ = 1;
};

}  // namespace scantrove
