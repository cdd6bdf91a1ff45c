#include "holomorphic/solution.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "core/cancel.h"
#include "dec/operators.h"
#include "holomorphic/energy.h"

namespace hexwall {
namespace {

// Where not every pattern of signs is tried, the search runs on a sample of the triangles, enough
// of them for each loop that the order of the energies is nearly that on all; of many loops, fewer
// for each, and what grows with their number squared is tried less.
constexpr int sampled_triangles = 6400;
constexpr int most_sampled_per_loop = 128;
constexpr int least_sampled_per_loop = 32;
constexpr int many_loops = 64;
constexpr int restarts_of_many_loops = 4;
constexpr int swaps_of_many_loops = 32;
// The last descent takes as many triangles as its second derivatives are worth: their cost is this
// number times the loops squared.
constexpr double most_products = 2e9;

int sample_size(int n) {
  return n * std::clamp(sampled_triangles / n, least_sampled_per_loop, most_sampled_per_loop);
}

// One vertex of each loop of the punctured surface: those of the surface, then the holes.
std::vector<int> loop_vertices(const Connectivity& original, const PuncturedSurface& punctured) {
  std::vector<int> vertices(original.loops().size(), -1);
  for (int v = 0; v < static_cast<int>(punctured.original_vertex.size()); ++v) {
    const int u = punctured.original_vertex[v];
    if (u >= 0 && original.is_boundary_vertex(u)) vertices[original.loop_of_vertex(u)] = v;
  }
  vertices.insert(vertices.end(), punctured.hole_vertex.begin(), punctured.hole_vertex.end());
  return vertices;
}

// Its loops come in the order of `vertices`, one of each. Refinement has kept their numbers.
void connect(const std::vector<int>& vertices, FormSolution& s) {
  const TriangleSurface& surface = s.refined.surface;
  s.connectivity = connectivity_of(surface);
  std::vector<int> order;
  for (const int v : vertices) order.push_back(s.connectivity.loop_of_vertex(v));
  s.connectivity.reorder_loops(order);
}

void find_scale_factors(FormSolution& s) {
  const TriangleSurface& surface = s.refined.surface;
  s.scale_factor.reserve(surface.triangles.size());
  for (int f = 0; f < static_cast<int>(surface.triangles.size()); ++f) {
    const auto& t = surface.triangles[f];
    Vec3 rotated = Vec3::Zero();
    for (int k = 0; k < 3; ++k) {
      rotated += s.form.y[t[k]] * (surface.points[t[(k + 2) % 3]] - surface.points[t[(k + 1) % 3]]);
    }
    s.scale_factor.push_back(rotated.norm() / doubled_area_vector(surface, f).norm());
  }
}

// As many quads as targets ask for: the integral of (1/edge)^2 equals that of (scale/plane)^2.
void find_size_ratios(const FormProblem& problem, FormSolution& s) {
  const TriangleSurface& surface = s.refined.surface;
  std::vector<double> area;
  double wanted = 0.0;
  double conformal = 0.0;
  double total = 0.0;
  for (int f = 0; f < static_cast<int>(surface.triangles.size()); ++f) {
    area.push_back(0.5 * doubled_area_vector(surface, f).norm());
    const double edge = problem.edge[s.refined.parent_face[f]];
    wanted += area.back() / (edge * edge);
    conformal += area.back() * s.scale_factor[f] * s.scale_factor[f];
    total += area.back();
  }
  const double plane = std::sqrt(conformal / wanted);
  double off = 0.0;
  for (std::size_t f = 0; f < area.size(); ++f) {
    const double edge = problem.edge[s.refined.parent_face[f]];
    s.size_ratio.push_back(plane / (s.scale_factor[f] * edge));
    if (s.size_ratio.back() > 2.0 || s.size_ratio.back() < 0.5) off += area[f];
  }
  s.off_size_share = off / total;
}

// Lengths of the loops in the plane if quads had their target sizes there.
std::vector<double> wanted_circumferences(const FormProblem& problem, const FormSolution& s) {
  const Connectivity& mesh = s.connectivity;
  std::vector<double> lengths(mesh.loops().size(), 0.0);
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    for (const int v : mesh.loops()[i]) {
      const int h = mesh.outgoing(v);
      const double length =
          (s.refined.surface.points[mesh.tip(h)] - s.refined.surface.points[v]).norm();
      lengths[i] += length / problem.edge[s.refined.parent_face[Connectivity::face(h)]];
    }
  }
  return lengths;
}

FormSolution solve_refined(const FormProblem& problem, FormSolution s) {
  s.laplace = laplace_of(s);
  s.factor_nonzeros = s.laplace->factor_nonzeros();
  s.basis = holomorphic_basis(s.connectivity, *s.laplace);
  find_optimum(problem, s);
  s.form = combine(s.connectivity, *s.laplace, s.basis, s.optimum.lambda);
  find_scale_factors(s);
  find_size_ratios(problem, s);
  return s;
}

}  // namespace

Eigen::VectorXd sizing_weights(const Eigen::VectorXd& edge) {
  return edge.cwiseAbs2().cwiseInverse();
}

// Many loops have many sign patterns: they are tried on a sample of the triangles, and only the
// best one is brought to its minimum on all of them.
void find_optimum(const FormProblem& problem, FormSolution& s) {
  const Eigen::VectorXd rho = sizing_weights(problem.edge);
  const Eigen::MatrixXd g = potentials(s.basis);
  const auto face_count = static_cast<int>(problem.surface.triangles.size());
  const AreaEnergyInput input{s.refined.surface, s.refined.parent_face, face_count, g, rho};
  const std::vector<double> lengths = wanted_circumferences(problem, s);
  const int n = s.basis.size();
  if (n <= most_for_every_pattern) {
    s.optimum = optimal_form(*quartic_energy(input), lengths, s.basis.exterior);
    return;
  }
  const auto on_sample = [&](int count) {
    const std::vector<int> parents = sampled_parents(input, count);
    return FacewiseEnergy({input.surface, parents, input.parent_count, input.g, input.rho});
  };
  SearchOptions options;
  if (n > many_loops) {
    options.restarts = restarts_of_many_loops;
    options.finalists = 0;
    options.most_swaps = swaps_of_many_loops;
  }
  s.optimum = search_optimal_form(on_sample(sample_size(n)), lengths, s.basis.exterior, options);
  const double most = std::min<double>(face_count, most_products / (n * n));
  Descent last =
      descend(on_sample(static_cast<int>(most)), s.optimum.lambda, most_descent_iterations);
  last.signs = s.optimum.descents[s.optimum.best].signs;
  s.optimum.lambda = last.lambda;
  s.optimum.energy = last.energy;
  s.optimum.best = static_cast<int>(s.optimum.descents.size());
  s.optimum.descents.push_back(std::move(last));
}

std::shared_ptr<const LaplaceSolver> laplace_of(const FormSolution& s) {
  return std::make_shared<const LaplaceSolver>(s.connectivity,
                                               star1(s.refined.surface, s.connectivity));
}

FormSolution solve_form(const FormProblem& problem) {
  throw_if_cancelled();
  FormSolution s;
  s.refined = make_delaunay(problem.surface, problem.connectivity);
  std::vector<int> vertices;
  for (const auto& loop : problem.connectivity.loops()) vertices.push_back(loop.front());
  connect(vertices, s);
  return solve_refined(problem, std::move(s));
}

std::optional<FormSolution> solve_form(const FormProblem& problem,
                                       const std::vector<SurfaceDisk>& disks,
                                       PuncturedSurface punctured, int most_negative) {
  throw_if_cancelled();
  const TriangleSurface& surface = punctured.surface;
  const Connectivity mesh = connectivity_of(surface);
  FormSolution s;
  s.refined = make_delaunay(surface, mesh);
  if (s.refined.negative_edges > most_negative) return std::nullopt;
  for (int& f : s.refined.parent_face) f = punctured.parent_face[f];
  connect(loop_vertices(problem.connectivity, punctured), s);
  s.disks = disks;
  s.disk_faces = std::move(punctured.disk_faces);
  return solve_refined(problem, std::move(s));
}

}  // namespace hexwall
