#pragma once
#include <vtkSmartPointer.h>

#include <cstddef>
#include <map>

class vtkProp;
class vtkRenderer;

namespace scantrove {

/// Splits a long drawing into parts: a renderer draws some of its props now and the others later, over the
/// previous parts. One thread.
class DrawingParts {
 public:
  explicit DrawingParts(vtkRenderer* renderer);
  ~DrawingParts();
  DrawingParts(const DrawingParts&) = delete;
  DrawingParts& operator=(const DrawingParts&) = delete;

  /// Starts with the first part; each drawing draws one part. Props missing in `part_of` belong to the last
  /// part.
  void begin(std::map<vtkProp*, std::size_t> part_of, std::size_t parts);
  /// Continues with the next part. False after the last part: drawings draw everything again.
  bool next();
  /// Drawings draw everything again.
  void end();

 private:
  class Culler;
  void show();

  vtkRenderer* renderer_;
  vtkSmartPointer<Culler> culler_;
  std::size_t part_ = 0, parts_ = 1;
};

}  // namespace scantrove
