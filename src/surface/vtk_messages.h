#pragma once

#include <string>

#include <vtkSmartPointer.h>

class vtkOutputWindow;

namespace hexwall {

/// Collects what VTK reports between construction and destruction, which otherwise goes to the
/// console. It replaces VTK's global message window and silences its log: one at a time, in one
/// thread.
class VtkMessages {
 public:
  VtkMessages();
  ~VtkMessages();
  VtkMessages(const VtkMessages&) = delete;
  VtkMessages& operator=(const VtkMessages&) = delete;

  /// The first error so far; empty if there was none.
  const std::string& error() const;

 private:
  vtkSmartPointer<vtkOutputWindow> previous_;
  vtkSmartPointer<vtkOutputWindow> collector_;
  int verbosity_;  ///< of VTK's log
};

}  // namespace hexwall
