#pragma once

#include <vector>

#include <Eigen/Core>

#include "surface/connectivity.h"

namespace hexwall {

/// A strict order of the vertices by y in which ties are broken by vertex number, so that every
/// comparison is exact; all vertices of a boundary loop share one rank. #V ranks from 0.
std::vector<int> level_ranks(const Connectivity& mesh, const Eigen::VectorXd& y);

/// A zero of the form: a saddle of y, with twice its order (so that half-zeros are integers).
struct Zero {
  int vertex = -1;
  int loop = -1;          ///< boundary loop, -1 for an interior zero
  int doubled_order = 0;  ///< sign changes in the link - 2 (interior), sign changes (boundary)
};

/// All zeros, interior ones by the sign changes of y around each vertex (Banchoff's index),
/// half-zeros by those of the normal derivative along each loop.
/// \throws MeshingError if y has an interior extremum (it has none unless the discrete maximum
/// principle was lost to rounding), or the orders do not sum to n - 1.
std::vector<Zero> find_zeros(const Connectivity& mesh, const std::vector<int>& ranks);

}  // namespace hexwall
