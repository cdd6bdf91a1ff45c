#include "lumen/tetgen.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStaticPointLocator.h>

#define TETLIBRARY
#include <tetgen.h>

#include "core/errors.h"
#include "core/forked.h"
#include "surface/self_intersection.h"

namespace hexwall {
namespace {

// Of a regular tetrahedron, relative to the cube of its edge.
constexpr double regular_volume = std::numbers::sqrt2 / 12.0;
// TetGen makes tetrahedra up to the bound, half as large on the mean: with this factor edges come
// out as wanted on the mean.
constexpr double volume_factor = 1.6;
constexpr std::size_t quoted_output = 200;

/// Wanted edge lengths in space.
class SizeField {
 public:
  SizeField(const std::vector<Vec3>& points, const std::vector<double>& edge, double growth)
      : edge_(edge), growth_(growth) {
    vtkNew<vtkPoints> cloud_points;
    cloud_points->SetDataTypeToDouble();
    for (const Vec3& p : points) cloud_points->InsertNextPoint(p.data());
    vtkNew<vtkPolyData> cloud;
    cloud->SetPoints(cloud_points);
    locator_->SetDataSet(cloud);
    locator_->BuildLocator();
    const auto [least, greatest] = std::minmax_element(edge.begin(), edge.end());
    least_volume_ = volume_of(*least);
    is_constant_ = growth == 0.0 && *least == *greatest;
  }

  bool is_too_large(const Vec3& at, double volume) const {
    if (volume <= least_volume_) return false;
    if (is_constant_) return true;
    double squared = 0.0;
    const vtkIdType nearest = locator_->FindClosestPointWithinRadius(1e300, at.data(), squared);
    return volume > volume_of(edge_[nearest] + growth_ * std::sqrt(squared));
  }

 private:
  static double volume_of(double edge) {
    return volume_factor * regular_volume * edge * edge * edge;
  }

  vtkNew<vtkStaticPointLocator> locator_;
  const std::vector<double>& edge_;
  double growth_;
  double least_volume_ = 0.0;
  bool is_constant_ = false;
};

// TetGen takes a plain function: what it needs lies here, in the process that runs TetGen only.
const SizeField* size_field = nullptr;

bool is_unsuitable(REAL* pa, REAL* pb, REAL* pc, REAL* pd, REAL* /*unused*/, REAL /*unused*/) {
  const Vec3 a = Vec3::Map(pa);
  const Vec3 b = Vec3::Map(pb);
  const Vec3 c = Vec3::Map(pc);
  const Vec3 d = Vec3::Map(pd);
  const double volume = std::abs((b - a).cross(c - a).dot(d - a)) / 6.0;
  return size_field->is_too_large(0.25 * (a + b + c + d), volume);
}

void set_input(const TriangleSurface& surface, tetgenio& in) {
  in.numberofpoints = static_cast<int>(surface.points.size());
  in.pointlist = new REAL[3 * surface.points.size()];
  for (std::size_t v = 0; v < surface.points.size(); ++v) {
    std::copy_n(surface.points[v].data(), 3, in.pointlist + 3 * v);
  }
  in.numberoffacets = static_cast<int>(surface.triangles.size());
  in.facetlist = new tetgenio::facet[surface.triangles.size()];
  for (std::size_t f = 0; f < surface.triangles.size(); ++f) {
    tetgenio::facet& facet = in.facetlist[f];
    tetgenio::init(&facet);
    facet.numberofpolygons = 1;
    facet.polygonlist = new tetgenio::polygon[1];
    tetgenio::init(facet.polygonlist);
    facet.polygonlist->numberofvertices = 3;
    facet.polygonlist->vertexlist = new int[3];
    std::copy_n(surface.triangles[f].begin(), 3, facet.polygonlist->vertexlist);
  }
}

template <typename T>
void append(std::string& bytes, const T* values, std::size_t count) {
  const std::size_t start = bytes.size();
  bytes.resize(start + count * sizeof(T));
  std::memcpy(bytes.data() + start, values, count * sizeof(T));
}

// Two counts, the points, the tetrahedra.
std::string run_tetgen(const TriangleSurface& surface, const TetOptions& options) {
  tetgenio in;
  tetgenio out;
  set_input(surface, in);
  in.tetunsuitable = is_unsuitable;
  std::string switches =
      fmt::format("pYq{:.6g}/{:.6g}O5Q", options.radius_edge_ratio, options.min_dihedral);
  try {
    tetrahedralize(switches.data(), &in, &out);
  } catch (const int code) {
    throw std::runtime_error(fmt::format("TetGen's error {}", code));
  }
  std::string bytes;
  const std::array counts{out.numberofpoints, out.numberoftetrahedra};
  append(bytes, counts.data(), counts.size());
  append(bytes, out.pointlist, 3 * static_cast<std::size_t>(counts[0]));
  append(bytes, out.tetrahedronlist, 4 * static_cast<std::size_t>(counts[1]));
  return bytes;
}

TetMesh parse(const std::string& bytes) {
  std::array<int, 2> counts{};
  std::memcpy(counts.data(), bytes.data(), sizeof counts);
  TetMesh mesh;
  mesh.points.resize(static_cast<std::size_t>(counts[0]));
  mesh.tets.resize(static_cast<std::size_t>(counts[1]));
  const char* from = bytes.data() + sizeof counts;
  std::memcpy(mesh.points.front().data(), from, mesh.points.size() * sizeof(Vec3));
  from += mesh.points.size() * sizeof(Vec3);
  std::memcpy(mesh.tets.data(), from, mesh.tets.size() * sizeof(mesh.tets[0]));
  // TetGen's tetrahedra are the other way round.
  for (auto& tet : mesh.tets) {
    const auto at = [&](int k) -> const Vec3& { return mesh.points[tet[k]]; };
    if ((at(1) - at(0)).cross(at(2) - at(0)).dot(at(3) - at(0)) < 0.0) std::swap(tet[2], tet[3]);
  }
  return mesh;
}

void refuse_intersections(const TriangleSurface& surface) {
  const auto pairs = self_intersections(surface);
  if (pairs.empty()) return;
  throw GeometryError(fmt::format(
      "the boundary of the lumen meets itself in {} places, first at {}: it can't be filled with "
      "tetrahedra. Smooth or remesh the surface there, or choose a smaller --size",
      pairs.size(), coordinates(centroid(surface, pairs.front().first))));
}

// Where two vertices that share no triangle come closest.
Vec3 narrowest_place(const TriangleSurface& surface) {
  std::vector<std::vector<int>> neighbours(surface.points.size());
  for (const auto& triangle : surface.triangles) {
    for (const int v : triangle) {
      neighbours[v].insert(neighbours[v].end(), triangle.begin(), triangle.end());
    }
  }
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const Vec3& p : surface.points) points->InsertNextPoint(p.data());
  vtkNew<vtkPolyData> cloud;
  cloud->SetPoints(points);
  vtkNew<vtkStaticPointLocator> locator;
  locator->SetDataSet(cloud);
  locator->BuildLocator();
  vtkNew<vtkIdList> found;
  double least = std::numeric_limits<double>::max();
  Vec3 place = surface.points.front();
  for (std::size_t v = 0; v < surface.points.size(); ++v) {
    locator->FindClosestNPoints(12, surface.points[v].data(), found);
    for (vtkIdType i = 0; i < found->GetNumberOfIds(); ++i) {
      const auto w = static_cast<int>(found->GetId(i));
      const auto& near = neighbours[v];
      if (std::find(near.begin(), near.end(), w) != near.end()) continue;
      const double distance = (surface.points[v] - surface.points[w]).norm();
      if (distance >= least) continue;
      least = distance;
      place = 0.5 * (surface.points[v] + surface.points[w]);
    }
  }
  return place;
}

[[noreturn]] void fail(const ForkedResult& run, const TriangleSurface& surface,
                       const TetOptions& options) {
  std::string reason = run.output;
  if (reason.size() > quoted_output) reason.erase(0, reason.size() - quoted_output);
  std::replace(reason.begin(), reason.end(), '\n', ' ');
  if (run.timed_out) {
    reason = fmt::format("it took longer than {:.0f} s", options.seconds);
  } else if (run.signal != 0) {
    reason = fmt::format("{} (signal {})", reason.empty() ? "it crashed" : reason, run.signal);
  } else if (reason.empty()) {
    reason = "without a reason";
  }
  throw MeshingError(fmt::format(
      "TetGen could not fill the lumen: {}. The boundary comes closest to itself at {}: smooth or "
      "remesh the surface there, or choose another --size",
      reason, coordinates(narrowest_place(surface))));
}

// With -Y all triangles of the surface are faces of tetrahedra.
void check_surface_is_kept(const TriangleSurface& surface, const TetMesh& mesh) {
  using Key = std::array<int, 3>;
  const auto n = static_cast<int>(surface.points.size());
  std::vector<Key> faces;
  for (const auto& t : mesh.tets) {
    for (const auto& [i, j, k] : {Key{0, 1, 2}, Key{0, 1, 3}, Key{0, 2, 3}, Key{1, 2, 3}}) {
      Key key{t[i], t[j], t[k]};
      std::sort(key.begin(), key.end());
      if (key[2] < n) faces.push_back(key);
    }
  }
  std::sort(faces.begin(), faces.end());
  for (std::size_t f = 0; f < surface.triangles.size(); ++f) {
    Key key = surface.triangles[f];
    std::sort(key.begin(), key.end());
    if (std::binary_search(faces.begin(), faces.end(), key)) continue;
    throw MeshingError(fmt::format(
        "TetGen could not keep the boundary of the lumen at {}: smooth or remesh the surface "
        "there, or choose another --size",
        coordinates(centroid(surface, static_cast<int>(f)))));
  }
}

}  // namespace

TetMesh fill_with_tets(const TriangleSurface& surface, const std::vector<double>& edge,
                       const TetOptions& options) {
  refuse_intersections(surface);
  const SizeField field(surface.points, edge, options.growth);
  size_field = &field;
  const ForkedResult run =
      run_forked([&] { return run_tetgen(surface, options); }, options.seconds);
  size_field = nullptr;
  if (!run.finished) fail(run, surface, options);
  TetMesh mesh = parse(run.bytes);
  check_surface_is_kept(surface, mesh);
  mesh.seconds = run.seconds;
  mesh.memory_bytes = run.memory_bytes;
  return mesh;
}

}  // namespace hexwall
