#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "surface/connectivity.h"
#include "surface/triangle_surface.h"

namespace hexwall {

/// Cotangent of the angle opposite to each half-edge. 3 #F.
Eigen::VectorXd halfedge_cotangents(const TriangleSurface& surface);

/// The diagonal of the Hodge star on 1-forms: per edge half the sum of the cotangents of its
/// opposite angles, dimensionless. Negative sums of interior edges are raised to zero, which keeps
/// the maximum principle; those of boundary edges (beside obtuse angles) stay, for they belong in
/// the natural boundary condition. #E.
Eigen::VectorXd star1(const TriangleSurface& surface, const Connectivity& mesh);

/// Exterior derivative of 0-forms: (d0 f)(ab) = f(b) - f(a). #E x #V.
Eigen::SparseMatrix<double> d0(const Connectivity& mesh);

/// Exterior derivative of 1-forms: the sum along the boundary of each triangle. #F x #E.
Eigen::SparseMatrix<double> d1(const Connectivity& mesh);

}  // namespace hexwall
