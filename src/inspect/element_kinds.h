#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "inspect/any_mesh.h"
#include "surface/counted.h"

namespace hexwall {

/// Collects elements of a file whose kinds are numbers or words, and counts what is left out.
class ElementCollector {
 public:
  explicit ElementCollector(AnyMesh& mesh) : mesh_(mesh) {}

  /// Adds the corners of an element that may have further nodes behind them.
  /// \returns false if there are too few.
  bool add(ElementShape shape, std::span<const int> nodes, std::int64_t label) {
    const int expected = corner_count(shape);
    const std::size_t corners = expected == 0 ? nodes.size() : static_cast<std::size_t>(expected);
    if (nodes.size() < corners || corners < 3) return false;
    if (nodes.size() > corners) ++curved_;
    mesh_.add(shape, nodes.first(corners), label);
    return true;
  }
  void leave_out_lower() { ++lower_; }
  void leave_out_unknown() { ++unknown_; }

  /// Adds notes to the mesh.
  void finish() {
    if (curved_ > 0) {
      mesh_.notes.push_back(counted(curved_, "element", "elements") +
                            " of higher order: judged by the corners");
    }
    if (lower_ > 0) {
      mesh_.notes.push_back(counted(lower_, "point or line element was ignored",
                                    "point and line elements were ignored"));
    }
    if (unknown_ > 0) {
      mesh_.notes.push_back(counted(unknown_, "element of an unknown kind was ignored",
                                    "elements of unknown kinds were ignored"));
    }
  }

 private:
  AnyMesh& mesh_;
  std::size_t curved_ = 0, lower_ = 0, unknown_ = 0;
};

}  // namespace hexwall
