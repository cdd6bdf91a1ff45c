#pragma once

#include <span>
#include <vector>

#include "quad/quad_mesh.h"

namespace hexwall {

/// A corner of a quad.
struct QuadCorner {
  int quad;
  int corner;  ///< 0 … 3
};

/// The corners of quads at each vertex, in the order of the quads.
class VertexCorners {
 public:
  explicit VertexCorners(const QuadMesh& mesh);

  std::span<const QuadCorner> at(std::size_t v) const {
    return {corners_.begin() + first_[v], corners_.begin() + first_[v + 1]};
  }

 private:
  std::vector<int> first_;  // #V + 1
  std::vector<QuadCorner> corners_;
};

}  // namespace hexwall
