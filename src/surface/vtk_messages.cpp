#include "surface/vtk_messages.h"

#include <string_view>

#include <vtkLogger.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>

namespace hexwall {
namespace {

// "ERROR: In file.cxx, line 7\nvtkReader (0x1234): message\n\n" -> "message", and
// "Generic Warning: In file.cxx, line 7\nmessage\n\n" -> "message". The address would
// make every run's message different.
std::string_view strip_origin(std::string_view text) {
  const bool is_generic = text.starts_with("Generic Warning");
  const std::string_view end_of_origin = is_generic ? "\n" : "): ";
  const std::size_t origin = text.find(end_of_origin);
  if (origin != std::string_view::npos) text.remove_prefix(origin + end_of_origin.size());
  const std::size_t last = text.find_last_not_of(" \n\r\t");
  return text.substr(0, last == std::string_view::npos ? 0 : last + 1);
}

class Collector : public vtkOutputWindow {
 public:
  static Collector* New() { VTK_STANDARD_NEW_BODY(Collector); }

  void DisplayErrorText(const char* text) override { add(text); }
  void DisplayWarningText(const char*) override {}
  // Code without an object to report an error with gives a generic warning.
  void DisplayGenericWarningText(const char* text) override { add(text); }
  void DisplayDebugText(const char*) override {}
  void DisplayText(const char*) override {}

  const std::string& error() const { return error_; }

 private:
  // What follows the first error are its echoes from the pipeline.
  void add(const char* text) {
    if (error_.empty()) error_ = strip_origin(text);
  }

  std::string error_;
};

}  // namespace

VtkMessages::VtkMessages()
    : previous_(vtkOutputWindow::GetInstance()),
      collector_(vtkSmartPointer<Collector>::New()),
      verbosity_(vtkLogger::GetCurrentVerbosityCutoff()) {
  vtkOutputWindow::SetInstance(collector_);
  // Every message goes to the log as well, whatever the window.
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
}

VtkMessages::~VtkMessages() {
  vtkLogger::SetStderrVerbosity(static_cast<vtkLogger::Verbosity>(verbosity_));
  vtkOutputWindow::SetInstance(previous_);
}

const std::string& VtkMessages::error() const {
  return static_cast<const Collector*>(collector_.Get())->error();
}

}  // namespace hexwall
