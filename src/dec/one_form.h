#pragma once

#include <Eigen/Core>

#include "surface/connectivity.h"

namespace hexwall {

/// A discrete 1-form: one value per edge, its integral along the edge's own orientation.
struct OneForm {
  Eigen::VectorXd values;  ///< #E

  /// Integral along half-edge `h`, in the direction of `h`.
  double along(const Connectivity& mesh, int h) const {
    return mesh.sign(h) * values[mesh.edge(h)];
  }
};

}  // namespace hexwall
