#include "holomorphic/poles.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <set>

#include <Eigen/Cholesky>
#include <fmt/format.h>

#include "core/errors.h"
#include "core/parallel.h"
#include "holomorphic/energy.h"
#include "holomorphic/optimum.h"
#include "surface/loop_shape.h"

namespace hexwall {
namespace {

// Quads more than this much too large make a region blind, the same factor that counts as off size.
constexpr double blind_size_ratio = 2.0;
// The neighbourhood of a charge that its judgement leaves out, relative to the radius of a
// hemisphere with the blind region's area.
constexpr double left_out_radius = 0.35;
// With so many forms all sign patterns of the others are tried for each candidate; above, the
// charge joins the pattern that was best without it.
constexpr int exhaustive_forms = 3;
// With more forms than this, which with two charges are too many for a quartic, charges join the
// optimum and so many forms only: those of the loops that take most of their flux. What they change
// at the others hardly matters.
constexpr int all_forms = largest_quartic - 2;
constexpr int nearest_forms = 8;
// Candidates are compared by their energy on about as many triangles, evenly taken from all: enough
// to rank them, and the energy of a pole that is placed is computed on all.
constexpr int judged_triangles = 4000;
// So many right-hand sides are solved for at once.
constexpr std::size_t judged_at_once = 3;
constexpr std::size_t descents_few_forms = 20;
constexpr std::size_t descents_many_forms = 6;
// A judgement is some percent off: places are tried that promise this share of the gain asked for.
constexpr double promising_gain = 0.7;
constexpr int local_rounds = 3;
constexpr int local_candidates = 12;
// Radii tried, from the one asked for downwards.
constexpr double radius_factor = 0.7;
constexpr int radius_trials = 5;
constexpr std::size_t place_trials = 3;
// Where nothing is blind, the region of a pole is taken to have this radius, relative to the root
// of the area of the surface.
constexpr double least_region = 0.05;
// A charge that wants to be smaller than this, relative to its region, wants to vanish: quads
// around it, as small as itself, would be of no use.
constexpr double vanishing_radius = 1e-3;
// A disk's area vector over its area: 0.75 for a cap of a sphere 60 degrees from its centre. Beyond
// that a flat grid no longer covers it well.
constexpr double least_flatness = 0.75;
// Of the bounding box' diagonal: no centre of a sac is farther from its wall.
constexpr double greatest_place_distance = 0.25;

struct BlindRegion {
  std::vector<int> vertices;
  double area_share = 0.0;
  double radius = 0.0;  ///< of the hemisphere of the same area
};

BlindRegion find_blind_region(const FormSolution& s) {
  const TriangleSurface& surface = s.refined.surface;
  std::vector<char> is_blind(surface.points.size(), 0);
  double blind = 0.0;
  double total = 0.0;
  for (int f = 0; f < static_cast<int>(surface.triangles.size()); ++f) {
    const double area = 0.5 * doubled_area_vector(surface, f).norm();
    total += area;
    if (s.size_ratio[f] <= blind_size_ratio) continue;
    blind += area;
    for (const int v : surface.triangles[f]) is_blind[v] = 1;
  }
  BlindRegion region;
  region.area_share = blind / total;
  region.radius = std::sqrt(blind / (2.0 * std::numbers::pi));
  for (int v = 0; v < static_cast<int>(is_blind.size()); ++v) {
    if (is_blind[v] != 0 && !s.connectivity.is_boundary_vertex(v)) region.vertices.push_back(v);
  }
  return region;
}

/// Vertices spread over a set, each the farthest from those before, starting from `first`; and the
/// distance within which every vertex of the set has one of them.
struct Sample {
  std::vector<int> vertices;
  double spacing = 0.0;
};

Sample farthest_points(const std::vector<Vec3>& points, const std::vector<int>& set, int first,
                       int count) {
  Sample sample;
  std::vector<double> distance(set.size(), std::numeric_limits<double>::max());
  int next = first;
  while (static_cast<int>(sample.vertices.size()) < count) {
    sample.vertices.push_back(next);
    for (std::size_t i = 0; i < set.size(); ++i) {
      distance[i] = std::min(distance[i], (points[set[i]] - points[next]).norm());
    }
    const auto farthest = std::max_element(distance.begin(), distance.end());
    sample.spacing = *farthest;
    if (*farthest <= 0.0) break;
    next = set[farthest - distance.begin()];
  }
  return sample;
}

/// What poles at some vertices, one or two, would give.
struct Judgement {
  std::vector<int> vertices;
  double energy = std::numeric_limits<double>::max();
  std::vector<double> radii;  ///< of each, as the form wants them; none if one of them vanishes
};

class Judge {
 public:
  Judge(const FormProblem& problem, const FormSolution& solution, double region_radius)
      : s_(solution),
        left_out_(left_out_radius * region_radius),
        vanishing_(vanishing_radius * region_radius) {
    choose_triangles(problem);
    g_ = potentials(solution.basis)(vertices_, Eigen::all);
    if (solution.basis.size() > all_forms) optimum_ = g_ * solution.optimum.lambda;
    for (const auto& loop : solution.connectivity.loops()) {
      lengths_.push_back(loop_shape(points_of(solution.refined.surface, loop)).length);
    }
    lengths_.push_back(2.0 * std::numbers::pi * region_radius);
  }

  /// What poles at each of these groups of vertices would give, the best one first.
  std::vector<Judgement> judge(const std::vector<std::vector<int>>& groups) const {
    std::vector<Judgement> judgements(groups.size());
    const std::size_t blocks = (groups.size() + judged_at_once - 1) / judged_at_once;
    parallel_tasks(blocks, [&](std::size_t block) {
      const std::size_t first = block * judged_at_once;
      const std::size_t last = std::min(first + judged_at_once, groups.size());
      std::vector<int> charged;
      for (std::size_t i = first; i < last; ++i) {
        charged.insert(charged.end(), groups[i].begin(), groups[i].end());
      }
      const Eigen::MatrixXd potentials = charge_potentials(charged);
      for (std::size_t i = first; i < last; ++i) {
        const auto size = static_cast<Eigen::Index>(groups[i].size());  // the same of all groups
        judgements[i] = judge_one(
            groups[i], potentials.middleCols(static_cast<Eigen::Index>(i - first) * size, size));
      }
    });
    std::stable_sort(judgements.begin(), judgements.end(),
                     [](const Judgement& a, const Judgement& b) { return a.energy < b.energy; });
    return judgements;
  }

 private:
  // Unit charges whose flux leaves through the exterior loop alone: the Dirichlet solution u loses
  // f_i(v) through loop i (its harmonic measure); f Capacity^-1 f(v) brings that back.
  // \returns #vertices_ x #charged.
  Eigen::MatrixXd charge_potentials(const std::vector<int>& charged) const {
    const auto count = static_cast<Eigen::Index>(charged.size());
    Eigen::MatrixXd charges = Eigen::MatrixXd::Zero(s_.basis.f.rows(), count);
    Eigen::MatrixXd harmonic_measure(s_.basis.size(), count);
    for (Eigen::Index i = 0; i < count; ++i) {
      charges(charged[i], i) = 1.0;
      harmonic_measure.col(i) = s_.basis.f.row(charged[i]).transpose();
    }
    const Eigen::MatrixXd u = s_.laplace->solve_dirichlet(charges);
    return -(u(vertices_, Eigen::all) +
             s_.basis.f(vertices_, Eigen::all) * s_.basis.capacity.llt().solve(harmonic_measure));
  }

  /// What the energy of some charges is made of.
  struct Trial {
    Eigen::MatrixXd g;                    ///< potentials: those that the charges join, then theirs
    std::vector<Eigen::VectorXd> minima;  ///< in the former, to begin with
    Eigen::Index first_form = 0;          ///< of the former, the first one that is of a single loop
    Eigen::Index charges = 0;
  };

  Trial trial_with(const std::vector<int>& vertices, const Eigen::MatrixXd& potentials) const {
    Trial trial;
    trial.charges = potentials.cols();
    if (s_.basis.size() > all_forms) {
      trial.first_form = 1;
      trial.g.resize(g_.rows(), 1 + nearest_forms + potentials.cols());
      trial.g.col(0) = optimum_;
      const std::vector<int> forms = forms_near(vertices);
      for (int i = 0; i < nearest_forms; ++i) trial.g.col(1 + i) = g_.col(forms[i]);
      trial.g.rightCols(potentials.cols()) = potentials;
      trial.minima.emplace_back(Eigen::VectorXd::Unit(1 + nearest_forms, 0));
      return trial;
    }
    trial.g.resize(g_.rows(), g_.cols() + potentials.cols());
    trial.g << g_, potentials;
    if (s_.basis.size() > exhaustive_forms) {
      trial.minima.push_back(s_.optimum.descents[s_.optimum.best].lambda);
    } else {
      for (const Descent& descent : s_.optimum.descents) trial.minima.push_back(descent.lambda);
    }
    return trial;
  }

  // The forms of the loops with the greatest harmonic measure seen from the vertices.
  std::vector<int> forms_near(const std::vector<int>& vertices) const {
    Eigen::VectorXd measure = Eigen::VectorXd::Zero(s_.basis.size());
    for (const int v : vertices) measure += s_.basis.f.row(v).transpose();
    std::vector<int> forms(s_.basis.size());
    std::iota(forms.begin(), forms.end(), 0);
    std::stable_sort(forms.begin(), forms.end(),
                     [&](int a, int b) { return measure[a] > measure[b]; });
    forms.resize(nearest_forms);
    return forms;
  }

  Judgement judge_one(const std::vector<int>& vertices, const Eigen::MatrixXd& potentials) const {
    const Trial trial = trial_with(vertices, potentials);
    const std::vector<int> parents = parents_away_from(vertices);
    const auto energy =
        area_energy({sample_, parents, static_cast<int>(rho_.size()), trial.g, rho_});
    const Descent best = best_descent(*energy, trial);
    // Where the neighbourhood left out is all of the surface, there is no energy to descend.
    Judgement judgement{vertices, best.energy, {}};
    for (Eigen::Index i = trial.g.cols() - trial.charges; i < best.lambda.size(); ++i) {
      const double radius = std::abs(best.lambda[i]) / (2.0 * std::numbers::pi);
      if (radius <= vanishing_) return {vertices, std::numeric_limits<double>::max(), {}};
      judgement.radii.push_back(radius);
    }
    return judgement;
  }

  // Every k-th triangle of the surface is judged by.
  void choose_triangles(const FormProblem& problem) {
    const auto count = static_cast<int>(problem.surface.triangles.size());
    const int step = std::max(1, count / judged_triangles);
    const Eigen::VectorXd rho = sizing_weights(problem.edge);
    rho_.resize((count + step - 1) / step);
    for (Eigen::Index i = 0; i < rho_.size(); ++i) rho_[i] = rho[i * step];
    const TriangleSurface& surface = s_.refined.surface;
    std::vector<int> number(surface.points.size(), -1);
    for (std::size_t f = 0; f < surface.triangles.size(); ++f) {
      const int parent = s_.refined.parent_face[f];
      if (parent % step != 0) continue;
      parents_.push_back(parent / step);
      std::array<int, 3> triangle = surface.triangles[f];
      for (int& v : triangle) {
        if (number[v] < 0) {
          number[v] = static_cast<int>(vertices_.size());
          vertices_.push_back(v);
          sample_.points.push_back(surface.points[v]);
        }
        v = number[v];
      }
      sample_.triangles.push_back(triangle);
    }
  }

  // Those of the triangles judged by, -1 beside the charges.
  std::vector<int> parents_away_from(const std::vector<int>& charged) const {
    std::vector<char> is_near(sample_.points.size());
    for (const int v : charged) {
      const Vec3& charge = s_.refined.surface.points[v];
      for (std::size_t i = 0; i < is_near.size(); ++i) {
        if ((sample_.points[i] - charge).norm() < left_out_) is_near[i] = 1;
      }
    }
    std::vector<int> parents = parents_;
    for (std::size_t f = 0; f < parents.size(); ++f) {
      const auto& [a, b, c] = sample_.triangles[f];
      if (is_near[a] != 0 || is_near[b] != 0 || is_near[c] != 0) parents[f] = -1;
    }
    return parents;
  }

  // Starts of descents, as good as they are before them.
  class Starts {
   public:
    explicit Starts(const AreaEnergy& energy) : energy_(energy) {}

    void add(const Eigen::VectorXd& direction) {
      const AreaEnergy::Ray ray = energy_.along(direction);
      starts_.emplace_back(ray.least(), ray.best_scale() * direction);
    }

    std::vector<Eigen::VectorXd> best(std::size_t count) {
      std::stable_sort(starts_.begin(), starts_.end(),
                       [](const auto& a, const auto& b) { return a.first < b.first; });
      std::vector<Eigen::VectorXd> result;
      for (std::size_t i = 0; i < std::min(count, starts_.size()); ++i) {
        result.push_back(starts_[i].second);
      }
      return result;
    }

   private:
    const AreaEnergy& energy_;
    std::vector<std::pair<double, Eigen::VectorXd>> starts_;
  };

  // One charge joins a minimum without it; its flux leaves through each of the loops in turn.
  void add_to_minimum(const Eigen::VectorXd& minimum, Eigen::Index first_form,
                      Starts& starts) const {
    const Eigen::Index n = minimum.size();
    for (Eigen::Index loop = first_form; loop <= n; ++loop) {
      for (const double sign : {1.0, -1.0}) {
        const double charge = sign * 2.0 * std::numbers::pi * left_out_;
        Eigen::VectorXd lambda(n + 1);
        lambda << minimum, charge;
        if (loop < n) lambda[loop] -= charge;  // otherwise through the exterior loop
        starts.add(lambda);
      }
    }
  }

  // Two charges join a minimum without them, the one taking what the other one gives.
  void add_pair_to_minimum(const Eigen::VectorXd& minimum, Starts& starts) const {
    for (const double charge : {lengths_.back(), -lengths_.back()}) {
      Eigen::VectorXd lambda(minimum.size() + 2);
      lambda << minimum, charge, -charge;
      starts.add(lambda);
    }
  }

  // Starts are the minima without the charges, and with few loops all patterns of signs, the
  // charges as strong as the region is wide; descents begin at the best of them.
  Descent best_descent(const AreaEnergy& energy, const Trial& trial) const {
    Starts starts(energy);
    const bool few = s_.basis.size() <= exhaustive_forms;
    if (few) {
      std::vector<double> lengths = lengths_;
      lengths.resize(lengths.size() + trial.charges - 1, lengths_.back());
      for_sign_patterns(static_cast<int>(lengths.size()), [&](const std::vector<int>& signs) {
        starts.add(balanced_start(signs, lengths, s_.basis.exterior));
      });
    }
    for (const Eigen::VectorXd& minimum : trial.minima) {
      if (trial.charges == 1) {
        add_to_minimum(minimum, trial.first_form, starts);
      } else {
        add_pair_to_minimum(minimum, starts);
      }
    }
    Descent best;
    best.energy = std::numeric_limits<double>::max();
    for (const Eigen::VectorXd& start :
         starts.best(few ? descents_few_forms : descents_many_forms)) {
      Descent descent = descend(energy, start, most_descent_iterations);
      if (descent.energy < best.energy) best = std::move(descent);
    }
    return best;
  }

  const FormSolution& s_;
  double left_out_, vanishing_;
  TriangleSurface sample_;       // the triangles judged by
  std::vector<int> vertices_;    // of the refined surface, which those of the sample are
  std::vector<int> parents_;     // of the sample's triangles, as numbered in rho_
  Eigen::VectorXd rho_;          // of the input's triangles that are judged by
  std::vector<double> lengths_;  // of the loops, and of one around the blind region
  Eigen::MatrixXd g_;            // potentials at the sample's vertices
  Eigen::VectorXd optimum_;      // potential of the optimum, if there are very many forms
};

std::vector<std::vector<int>> one_by_one(const std::vector<int>& vertices) {
  std::vector<std::vector<int>> groups;
  for (const int v : vertices) groups.push_back({v});
  return groups;
}

// Vertices of the region where a charge lowers the energy most: the best one, refined locally, then
// the next best ones of the sample.
std::vector<Judgement> best_places(const FormProblem& problem, const FormSolution& s,
                                   const BlindRegion& region, int candidates) {
  if (region.vertices.empty()) return {};  // every vertex lies on an opening
  const Judge judge(problem, s, region.radius);
  const std::vector<Vec3>& points = s.refined.surface.points;
  const Sample sample = farthest_points(points, region.vertices, region.vertices[0], candidates);
  std::vector<Judgement> places = judge.judge(one_by_one(sample.vertices));
  Judgement best = places[0];
  double spacing = sample.spacing;
  for (int round = 0; round < local_rounds; ++round, spacing *= 0.5) {
    std::vector<int> near;
    for (const int v : region.vertices) {
      if ((points[v] - points[best.vertices[0]]).norm() <= spacing) near.push_back(v);
    }
    const auto local = judge.judge(
        one_by_one(farthest_points(points, near, best.vertices[0], local_candidates).vertices));
    if (local[0].energy < best.energy) best = local[0];
  }
  places.insert(places.begin(), best);
  if (places.size() > place_trials) places.resize(place_trials);
  return places;
}

// Pairs of vertices of the region, each with the one farthest from it, where two charges lower the
// energy most: what a sac on a narrow neck needs, whose own flux cannot come through the neck.
std::vector<Judgement> best_pairs(const FormProblem& problem, const FormSolution& s,
                                  const BlindRegion& region, int candidates) {
  if (region.vertices.empty()) return {};  // every vertex lies on an opening
  const std::vector<Vec3>& points = s.refined.surface.points;
  const std::vector<int> sample =
      farthest_points(points, region.vertices, region.vertices[0], candidates).vertices;
  std::set<std::vector<int>> pairs;
  for (const int v : sample) {
    const int opposite = *std::max_element(sample.begin(), sample.end(), [&](int a, int b) {
      return (points[a] - points[v]).squaredNorm() < (points[b] - points[v]).squaredNorm();
    });
    if (opposite != v) pairs.insert({std::min(v, opposite), std::max(v, opposite)});
  }
  const Judge judge(problem, s, region.radius);
  std::vector<Judgement> places = judge.judge({pairs.begin(), pairs.end()});
  if (places.size() > place_trials) places.resize(place_trials);
  return places;
}

SurfacePoint surface_point(const FormSolution& s, int vertex) {
  const int h = s.connectivity.outgoing(vertex);
  return {s.refined.parent_face[Connectivity::face(h)], s.refined.surface.points[vertex]};
}

bool is_flat(const TriangleSurface& surface, const std::vector<int>& faces) {
  Vec3 sum = Vec3::Zero();
  double total = 0.0;
  for (const int f : faces) {
    sum += doubled_area_vector(surface, f);
    total += doubled_area_vector(surface, f).norm();
  }
  return sum.norm() >= least_flatness * total;
}

// From one of the last `count` loops y rises into the surface in some places and falls in others.
bool has_half_zeros(const FormSolution& s, int count) {
  const auto& loops = s.connectivity.loops();
  return std::any_of(loops.end() - count, loops.end(), [&](const std::vector<int>& loop) {
    bool rises = false;
    bool falls = false;
    for (const int v : loop) {
      for (int h = s.connectivity.outgoing(v); h >= 0; h = s.connectivity.rotate(h)) {
        const int u = s.connectivity.tip(h);
        rises = rises || s.form.y[u] > s.form.y[v];
        falls = falls || s.form.y[u] < s.form.y[v];
      }
    }
    return rises && falls;
  });
}

// The largest of a series of disks around the last `count` points that give poles without
// half-zeros; without `strict` else some with half-zeros.
std::optional<FormSolution> solve_with_disks(const FormProblem& problem, const FormSolution& before,
                                             std::vector<SurfaceDisk> disks, int count,
                                             bool strict) {
  std::optional<FormSolution> fallback;
  const auto first = static_cast<std::ptrdiff_t>(disks.size()) - count;
  for (int trial = 0; trial < radius_trials; ++trial) {
    const auto are_flat = [&](const PuncturedSurface& punctured) {
      return std::all_of(punctured.disk_faces.begin() + first, punctured.disk_faces.end(),
                         [&](const auto& faces) { return is_flat(problem.surface, faces); });
    };
    auto punctured = puncture(problem.surface, problem.connectivity, disks);
    if (punctured && are_flat(*punctured)) {
      std::optional<FormSolution> solution =
          solve_form(problem, disks, std::move(*punctured), before.refined.negative_edges);
      if (solution && !has_half_zeros(*solution, count)) return solution;
      if (!strict && !fallback) fallback = std::move(solution);
    }
    for (auto i = first; i < std::ssize(disks); ++i) disks[i].radius *= radius_factor;
  }
  return fallback;
}

// Adds poles, as large as their judgement wants them. False if there is no room, or they are not
// worthwhile.
bool add_poles(const FormProblem& problem, const Judgement& judgement, const PoleOptions& options,
               PoleResult& result) {
  const FormSolution& s = result.solution;
  const auto count = static_cast<int>(judgement.vertices.size());
  const double least_gain = 1.0 - std::pow(1.0 - options.least_gain, count);
  if (judgement.radii.empty()) return false;
  if (options.only_if_worthwhile &&
      judgement.energy > (1.0 - promising_gain * least_gain) * s.optimum.energy) {
    return false;
  }
  std::vector<SurfaceDisk> disks = s.disks;
  for (int i = 0; i < count; ++i) {
    disks.push_back({surface_point(s, judgement.vertices[i]), judgement.radii[i]});
  }
  auto next = solve_with_disks(problem, s, disks, count, options.only_if_worthwhile);
  if (!next) return false;
  const double gain = 1.0 - next->optimum.energy / s.optimum.energy;
  if (options.only_if_worthwhile && gain < least_gain) return false;
  for (int i = count; i > 0; --i) {
    result.poles.push_back({next->disks[next->disks.size() - i], s.optimum.energy,
                            next->optimum.energy, s.off_size_share, next->off_size_share});
  }
  result.solution = std::move(*next);
  return true;
}

BlindRegion whole_surface(const FormSolution& s) {
  BlindRegion region = find_blind_region(s);
  region.radius = std::max(region.radius, least_region * std::sqrt(total_area(s.refined.surface)));
  region.vertices.clear();
  for (int v = 0; v < s.connectivity.vertex_count(); ++v) {
    if (!s.connectivity.is_boundary_vertex(v)) region.vertices.push_back(v);
  }
  return region;
}

// A point beside the surface, or in the middle of a sac, means the nearest place of the surface;
// one far away is a mistake, of the unit for instance.
void check_near(const std::vector<Vec3>& places, const TriangleSurface& surface) {
  for (const Vec3& place : places) {
    const Vec3& nearest = *std::min_element(
        surface.points.begin(), surface.points.end(),
        [&](auto& a, auto& b) { return (a - place).squaredNorm() < (b - place).squaredNorm(); });
    const double distance = (place - nearest).norm();
    if (distance <= greatest_place_distance * bounding_box_diagonal(surface)) continue;
    throw UsageError(fmt::format(
        "the place {} for a pole is {:.4g} away from the surface, which is nearest at {}",
        coordinates(place), distance, coordinates(nearest)));
  }
}

}  // namespace

PoleResult place_poles(const FormProblem& problem, FormSolution start, const PoleOptions& options) {
  PoleResult result{std::move(start), {}};
  while (static_cast<int>(result.poles.size()) < options.most) {
    const FormSolution& s = result.solution;
    BlindRegion region = find_blind_region(s);
    if (region.area_share < options.least_blind_share) {
      if (options.only_if_worthwhile) break;
      region = whole_surface(s);
    }
    const auto add_best = [&](const std::vector<Judgement>& places) {
      return std::any_of(places.begin(), places.end(), [&](const Judgement& place) {
        return add_poles(problem, place, options, result);
      });
    };
    if (add_best(best_places(problem, s, region, options.candidates))) continue;
    if (static_cast<int>(result.poles.size()) + 2 > options.most ||
        !add_best(best_pairs(problem, s, region, options.candidates))) {
      break;
    }
  }
  return result;
}

PoleResult place_poles_at(const FormProblem& problem, FormSolution start,
                          const std::vector<Vec3>& places) {
  PoleResult result{std::move(start), {}};
  check_near(places, problem.surface);
  for (const Vec3& place : places) {
    const FormSolution& s = result.solution;
    const BlindRegion region = whole_surface(s);
    const std::vector<Vec3>& points = s.refined.surface.points;
    const auto nearest =
        std::min_element(region.vertices.begin(), region.vertices.end(), [&](int a, int b) {
          return (points[a] - place).squaredNorm() < (points[b] - place).squaredNorm();
        });
    const Judge judge(problem, s, region.radius);
    PoleOptions options;
    options.only_if_worthwhile = false;
    const bool is_inside = nearest != region.vertices.end();
    if (is_inside && add_poles(problem, judge.judge({{*nearest}})[0], options, result)) continue;
    throw UsageError(fmt::format(
        "there is no room for a pole at ({:.6g}, {:.6g}, {:.6g}): it is too near an opening or "
        "another pole, or the surface is folded there, or so even that a pole would vanish",
        place.x(), place.y(), place.z()));
  }
  return result;
}

}  // namespace hexwall
