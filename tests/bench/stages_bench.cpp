// Stages of the pipeline on vessels of several sizes and of several numbers of openings.
//
//   build/tests/bench/hexwall_bench --benchmark_filter=Aaa
//
// On the generated aortic aneurysm by the edge length of its triangles in hundredths of a
// millimetre (142: the 26,165 vertices of the literature), on trees by their number of loops.

#include <cmath>
#include <map>
#include <memory>
#include <sys/resource.h>

#include <benchmark/benchmark.h>

#include "bench/bare_cholmod.h"
#include "dec/delaunay.h"
#include "dec/operators.h"
#include "holomorphic/form.h"
#include "holomorphic/solution.h"
#include "pipeline.h"
#include "support/vessel_surfaces.h"
#include "surface/check.h"

namespace hexwall::bench {
namespace {

/// A surface and what the stages up to the form take.
struct Vessel {
  explicit Vessel(const TriangleSurface& input)
      : surface(check_surface(input).surface),
        mesh(connectivity_of(surface)),
        edge(Eigen::VectorXd::Ones(mesh.face_count())),
        refined(make_delaunay(surface, mesh)),
        refined_mesh(connectivity_of(refined.surface)),
        star(star1(refined.surface, refined_mesh)) {}

  // A quad for each vertex: with many openings the default would be too few.
  double quad_size() const {
    return std::sqrt(total_area(surface) / static_cast<double>(surface.points.size()));
  }
  int n() const { return static_cast<int>(mesh.loops().size()) - 1; }
  FormProblem problem() const { return {surface, mesh, edge}; }

  TriangleSurface surface;
  Connectivity mesh;
  Eigen::VectorXd edge;
  DelaunaySurface refined;
  Connectivity refined_mesh;
  Eigen::VectorXd star;
};

// Surfaces are made once, whatever the number of benchmarks on them.
const Vessel& vessel(const std::string& key, const std::function<TriangleSurface()>& make) {
  static std::map<std::string, std::unique_ptr<Vessel>> vessels;
  std::unique_ptr<Vessel>& place = vessels[key];
  if (!place) place = std::make_unique<Vessel>(make());
  return *place;
}

const Vessel& aaa(const benchmark::State& state) {
  const double edge = 0.01 * static_cast<double>(state.range(0));
  return vessel("aaa" + std::to_string(state.range(0)),
                [edge] { return generate_shape(Shape::aaa, edge); });
}

const Vessel& tree(const benchmark::State& state) {
  const int loops = static_cast<int>(state.range(0));
  return vessel("tree" + std::to_string(loops),
                [loops] { return test::tree_with_sides(loops - 2); });
}

using Surface = const Vessel& (*)(const benchmark::State&);

void count(benchmark::State& state, const Vessel& v) {
  state.counters["vertices"] = static_cast<double>(v.surface.points.size());
  state.counters["forms"] = v.n();
  state.counters["vertices/s"] = benchmark::Counter(static_cast<double>(v.surface.points.size()),
                                                    benchmark::Counter::kIsIterationInvariantRate);
}

// The limit: two factorisations and 2 n right-hand sides.
void bare_cholmod(benchmark::State& state, Surface surface) {
  const Vessel& v = surface(state);
  BareCholmod bare(v.refined_mesh, v.star);
  double nonzeros = 0.0;
  for (auto _ : state) nonzeros = bare.run(v.n());
  count(state, v);
  state.counters["factor_bytes"] = 12.0 * nonzeros;
}

// From weights to all n potentials and the x of one form.
void forms(benchmark::State& state, Surface surface) {
  const Vessel& v = surface(state);
  const Eigen::VectorXd lambda = Eigen::VectorXd::LinSpaced(v.n(), 1.0, 2.0);
  long nonzeros = 0;
  for (auto _ : state) {
    const LaplaceSolver laplace(v.refined_mesh, v.star);
    const HolomorphicBasis basis = holomorphic_basis(v.refined_mesh, laplace);
    benchmark::DoNotOptimize(combine(v.refined_mesh, laplace, basis, lambda));
    nonzeros = laplace.factor_nonzeros();
  }
  count(state, v);
  state.counters["factor_bytes"] = 12.0 * static_cast<double>(nonzeros);
}

void refine(benchmark::State& state, Surface surface) {
  const Vessel& v = surface(state);
  for (auto _ : state) {
    const DelaunaySurface refined = make_delaunay(v.surface, v.mesh);
    const Connectivity mesh = connectivity_of(refined.surface);
    benchmark::DoNotOptimize(star1(refined.surface, mesh));
  }
  count(state, v);
}

// The energy and its minimum over all patterns of signs, from the potentials.
void optimum(benchmark::State& state, Surface surface) {
  const Vessel& v = surface(state);
  FormSolution solution = solve_form(v.problem());
  for (auto _ : state) find_optimum(v.problem(), solution);
  count(state, v);
  state.counters["energy"] = solution.optimum.energy;
  state.counters["descents"] = static_cast<double>(solution.optimum.descents.size());
}

// The whole pipeline, without files: seconds of its stages as counters.
void pipeline(benchmark::State& state, Surface surface) {
  const Vessel& v = surface(state);
  PipelineOptions options;
  options.size = v.quad_size();
  std::map<std::string, double> seconds;
  std::size_t quads = 0;
  for (auto _ : state) {
    const PipelineResult result = run_pipeline(v.surface, options);
    quads = result.quads.quads.size();
    for (const StageTime& time : result.times) seconds[time.stage] += time.seconds;
  }
  count(state, v);
  for (const auto& [stage, sum] : seconds) {
    state.counters[stage + "_s"] = sum / static_cast<double>(state.iterations());
  }
  state.counters["quads"] = static_cast<double>(quads);
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  state.counters["peak_bytes"] = 1024.0 * static_cast<double>(usage.ru_maxrss);
}

void add(const std::string& name, void (*body)(benchmark::State&, Surface)) {
  const auto registered = [&](const std::string& on, Surface surface) {
    return benchmark::RegisterBenchmark((on + "/" + name).c_str(), body, surface)
        ->Unit(benchmark::kMillisecond)
        ->MeasureProcessCPUTime()
        ->UseRealTime();
  };
  for (const int edge : {200, 142, 100, 70, 50}) registered("Aaa", aaa)->Arg(edge);
  for (const int loops : {3, 10, 50, 200}) registered("Tree", tree)->Arg(loops);
}

}  // namespace
}  // namespace hexwall::bench

int main(int argc, char** argv) {
  using namespace hexwall::bench;
  add("bare_cholmod", bare_cholmod);
  add("forms", forms);
  add("refine", refine);
  add("optimum", optimum);
  add("pipeline", pipeline);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
