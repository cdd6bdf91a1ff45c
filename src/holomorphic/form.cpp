#include "holomorphic/form.h"

#include <Eigen/Cholesky>

namespace hexwall {

Eigen::MatrixXd potentials(const HolomorphicBasis& basis) {
  const Eigen::MatrixXd inverse =
      basis.capacity.llt().solve(Eigen::MatrixXd::Identity(basis.size(), basis.size()));
  return -basis.f * inverse;
}

HolomorphicForm combine(const Connectivity& mesh, const LaplaceSolver& laplace,
                        const HolomorphicBasis& basis, const Eigen::VectorXd& lambda) {
  const Eigen::VectorXd loop_values = -basis.capacity.llt().solve(lambda);
  HolomorphicForm form;
  form.y = basis.f * loop_values;
  form.periods = Eigen::VectorXd::Constant(lambda.size() + 1, -lambda.sum());
  for (int i = 0; i < basis.size(); ++i) {
    form.periods[basis.loop(i)] = lambda[i];
    // Bitwise constant along the loop: the foliation compares vertices by their exact values.
    for (const int v : mesh.loops()[basis.loop(i)]) form.y[v] = loop_values[i];
  }
  form.dx.values = coclosed(mesh, laplace, closed_forms(mesh, basis.exterior, lambda));
  const double energy_of_x = form.dx.values.dot(laplace.star1().cwiseProduct(form.dx.values));
  form.error = energy_of_x / loop_values.dot(basis.capacity * loop_values) - 1.0;
  return form;
}

}  // namespace hexwall
