#include "exporters/picture_scenes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <fmt/format.h>

#include "exporters/checkerboard.h"
#include "exporters/results.h"
#include "exporters/view_frame.h"
#include "exporters/vtk_files.h"

namespace hexwall {
namespace {

namespace fs = std::filesystem;

Eigen::Matrix3Xd matrix_of(const std::vector<Vec3>& points) {
  Eigen::Matrix3Xd matrix(3, static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) {
    matrix.col(static_cast<Eigen::Index>(i)) = points[i];
  }
  return matrix;
}

std::string joined(std::initializer_list<Vec3> vectors) {
  std::string text;
  for (const Vec3& v : vectors) {
    for (const double x : v) text += fmt::format("{}{:.9g}", text.empty() ? "" : ",", x);
  }
  return text;
}

PolyData input_data(const PipelineResult& r) {
  PolyData data;
  data.points = r.surface.points;
  data.polygons.reserve(r.surface.triangles.size(), 3);
  for (const auto& triangle : r.surface.triangles) data.polygons.add(triangle);
  return data;
}

// Out of the vessel through a loop: away from the triangles along it.
Vec3 outward(const PipelineResult& r, int loop) {
  Vec3 inside = Vec3::Zero();
  const auto& vertices = r.connectivity.loops()[loop];
  for (const int v : vertices) {
    inside += centroid(r.surface, Connectivity::face(r.connectivity.outgoing(v))) -
              r.openings[loop].plane.center;
  }
  const Vec3& normal = r.openings[loop].plane.normal;
  return normal.dot(inside) > 0.0 ? Vec3(-normal) : normal;
}

void add_label(PolyData& data, const Vec3& at) {
  data.vertices.add(std::array{static_cast<int>(data.points.size())});
  data.points.push_back(at);
}

// The loops, of poles as well, as lines; for each opening and pole a point with its name.
PolyData openings_data(const PipelineResult& r) {
  PolyData data;
  data.strings.push_back({"labels", {}});
  const FormSolution& s = r.solution;
  for (const auto& loop : s.connectivity.loops()) {
    std::vector<int> line;
    for (const int v : loop) {
      line.push_back(static_cast<int>(data.points.size()));
      data.points.push_back(s.refined.surface.points[v]);
    }
    line.push_back(line.front());
    data.lines.add(line);
  }
  for (std::size_t i = 0; i < r.openings.size(); ++i) {
    const LoopPlane& plane = r.openings[i].plane;
    add_label(data, plane.center + plane.radius * outward(r, static_cast<int>(i)));
    data.strings.front().values.push_back(r.openings[i].name);
  }
  for (std::size_t i = 0; i < r.poles.size(); ++i) {
    const Vec3& at = r.poles[i].disk.center.position;
    add_label(data, at);
    data.strings.front().values.push_back(fmt::format("pole_{}", i + 1));
  }
  return data;
}

/// A plane through the vessel and the place to look at.
struct Cut {
  Vec3 at, normal;
  Vec3 along;     ///< in the plane: where the vessel extends most
  double radius;  ///< of what is to be seen
  bool has_branches;
};

// The quad vertex nearest to a place.
std::size_t nearest_vertex(const PipelineResult& r, const Vec3& at) {
  const auto nearest = std::min_element(r.quads.points.begin(), r.quads.points.end(),
                                        [&](const Vec3& a, const Vec3& b) {
                                          return (a - at).squaredNorm() < (b - at).squaredNorm();
                                        });
  return static_cast<std::size_t>(nearest - r.quads.points.begin());
}

// The zero where the vessel is widest; without one the middle of the vessel.
std::size_t vertex_to_cut_at(const PipelineResult& r, bool& has_branches) {
  std::size_t widest = nearest_vertex(r, matrix_of(r.quads.points).rowwise().mean());
  has_branches = false;
  for (const Zero& zero : r.foliation.graph.zeros) {
    if (zero.loop >= 0) continue;
    const std::size_t v = nearest_vertex(r, r.solution.refined.surface.points[zero.vertex]);
    if (has_branches && r.radius[v] <= r.radius[widest]) continue;
    widest = v;
    has_branches = true;
  }
  return widest;
}

// The plane in which the vessel extends around that place.
Cut find_cut(const PipelineResult& r) {
  Cut cut{};
  const std::size_t v = vertex_to_cut_at(r, cut.has_branches);
  cut.radius = 4.0 * r.radius[v];
  std::vector<Vec3> around;
  for (const Vec3& p : r.quads.points) {
    if ((p - r.quads.points[v]).norm() < cut.radius) around.push_back(p);
  }
  const Eigen::Matrix3Xd points = matrix_of(around);
  cut.at = points.rowwise().mean();
  const Eigen::Matrix3Xd centred = points.colwise() - cut.at;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(centred * centred.transpose());
  cut.normal = axes.eigenvectors().col(0);
  Eigen::Index largest = 0;
  cut.normal.cwiseAbs().maxCoeff(&largest);
  if (cut.normal[largest] < 0.0) cut.normal *= -1.0;
  cut.along = axes.eigenvectors().col(2);
  if (cut.along.sum() < 0.0) cut.along *= -1.0;
  return cut;
}

PictureScene cut_scene(const PipelineResult& r, const std::string& wall) {
  const Cut cut = find_cut(r);
  // What lies beyond the plane stays, and is looked at through it, a little from the side.
  const Vec3& right = cut.along;
  const Vec3 up = cut.normal.cross(right);
  const Vec3 eye = (-cut.normal + 0.25 * right + 0.35 * up).normalized();
  return {"cut",
          cut.has_branches ? "The layers, cut open at a bifurcation." : "The layers, cut open.",
          {wall, "--array", "zone", "--edges", "--clip", joined({cut.at, cut.normal}), "--frame",
           joined({up.cross(eye).normalized(), up}), "--focus",
           fmt::format("{},{:.9g}", joined({cut.at}), cut.radius)}};
}

std::string ratio_range(const ThicknessResult& side) {
  double least = 1.0;
  for (int v = 0; v < static_cast<int>(side.given.size()); ++v) {
    least = std::min(least, side.ratio(v));
  }
  return fmt::format("{:g},1", std::min(0.9, std::floor(10.0 * least) / 10.0));
}

}  // namespace

std::vector<PictureScene> write_picture_scenes(const fs::path& folder, const PipelineResult& r) {
  const auto file = [&](const char* name) { return (folder / name).string(); };
  write_vtp(file("input.vtp"), input_data(r));
  write_vtp(file("openings.vtp"), openings_data(r));
  const Checkerboards boards = checkerboards(r);
  write_vtp(file("before.vtp"), boards.before);
  write_vtp(file("after.vtp"), boards.after);
  write_vtp(file("quads.vtp"), quad_data(r));
  write_wall(file("wall.vtu"), r);
  const Eigen::Matrix3d frame = frame_of_points(matrix_of(r.quads.points));
  const std::string view = joined({frame.col(0), frame.col(1)});
  std::vector<PictureScene> scenes{
      {"input",
       "The surface that was meshed, with its openings and poles.",
       {file("input.vtp"), "--lines", file("openings.vtp"), "--frame", view}},
      {"checkerboard_before",
       fmt::format("Before the optimisation: squares of the conformal map whose circumferences are "
                   "those of the openings (energy {:.3g}).",
                   boards.energy_before),
       {file("before.vtp"), "--texture", "checkerboard", "--frame", view}},
      {"checkerboard_after",
       fmt::format("After the optimisation: squares of the map of least area distortion (energy "
                   "{:.3g}).",
                   r.solution.optimum.energy),
       {file("after.vtp"), "--texture", "checkerboard", "--frame", view}},
      {"quads", "The quads.", {file("quads.vtp"), "--edges", "--frame", view}},
      cut_scene(r, file("wall.vtu")),
      {"scaled_jacobian",
       "The hexahedra by scaled Jacobian: 1 is a box.",
       {file("wall.vtu"), "--array", "scaled_jacobian", "--title", "scaled\nJacobian", "--range",
        "0,1", "--frame", view}}};
  const auto add_side = [&](const std::optional<ThicknessResult>& side, const std::string& prefix,
                            const std::string& of) {
    if (!side) return;
    scenes.push_back({prefix + "thickness_ratio",
                      "Thickness of " + of + ", given / asked.",
                      {file("quads.vtp"), "--array", prefix + "thickness_ratio", "--title",
                       "given /\nasked", "--range", ratio_range(*side), "--frame", view}});
  };
  add_side(r.outward, "", "the wall");
  add_side(r.inward, "inner_", "the layers in the lumen");
  return scenes;
}

}  // namespace hexwall
