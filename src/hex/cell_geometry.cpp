#include "hex/cell_geometry.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

namespace hexwall {
namespace {

// A face counts as extended by at least these shares of the distance of the cells, as in OpenFOAM.
constexpr double least_extent_inside = 0.2;
constexpr double least_extent_at_boundary = 0.4;

/// `FaceGeometry` of four faces.
struct FaceLanes {
  VectorLanes center, area;
};

// `face_geometry` of the faces with the corners a, b, c, d of each lane.
FaceLanes face_lanes(const VectorLanes& a, const VectorLanes& b, const VectorLanes& c,
                     const VectorLanes& d) {
  const VectorLanes middle = Lanes::Constant(0.25) * (a + b + c + d);
  VectorLanes area(Vec3::Zero());
  VectorLanes moment(Vec3::Zero());
  Lanes weights = Lanes::Zero();
  const auto add = [&](const VectorLanes& p, const VectorLanes& q) {
    const VectorLanes doubled_area = cross(q - p, middle - p);
    const Lanes weight = dot(doubled_area, doubled_area).sqrt();
    area = area + doubled_area;
    moment = moment + weight * (p + q + middle);
    weights += weight;
  };
  add(a, b);
  add(b, c);
  add(c, d);
  add(d, a);
  const auto weighted = [&](const Lanes& sum, const Lanes& mean) {
    return Lanes((weights > 0.0).select(sum / (3.0 * weights), mean));
  };
  return {
      {weighted(moment.x, middle.x), weighted(moment.y, middle.y), weighted(moment.z, middle.z)},
      Lanes::Constant(0.5) * area};
}

double relative(const Vec3& offset, std::span<const Vec3> face, const Vec3& center,
                double least_extent) {
  const double length = offset.norm();
  if (length == 0.0) return 0.0;
  double extent = least_extent;
  for (const Vec3& p : face) extent = std::max(extent, std::abs(offset.dot(p - center)) / length);
  return length / extent;
}

}  // namespace

FaceGeometry face_geometry(std::span<const Vec3> face) {
  if (face.size() == 3) {
    return {(face[0] + face[1] + face[2]) / 3.0,
            0.5 * (face[1] - face[0]).cross(face[2] - face[0])};
  }
  Vec3 middle = Vec3::Zero();
  for (const Vec3& p : face) middle += p;
  middle /= static_cast<double>(face.size());
  FaceGeometry result{Vec3::Zero(), Vec3::Zero()};
  double weights = 0.0;
  for (std::size_t k = 0; k < face.size(); ++k) {
    const Vec3& a = face[k];
    const Vec3& b = face[k + 1 < face.size() ? k + 1 : 0];
    const Vec3 doubled_area = (b - a).cross(middle - a);
    const double weight = doubled_area.norm();
    result.area += 0.5 * doubled_area;
    result.center += weight * (a + b + middle) / 3.0;
    weights += weight;
  }
  result.center = weights > 0.0 ? Vec3(result.center / weights) : middle;
  return result;
}

CellGeometry cell_geometry(std::span<const FaceGeometry> faces) {
  Vec3 middle = Vec3::Zero();
  for (const FaceGeometry& face : faces) middle += face.center / static_cast<double>(faces.size());
  Vec3 sum = Vec3::Zero();
  double volume = 0.0;
  for (const FaceGeometry& face : faces) {
    const double pyramid = face.area.dot(face.center - middle);
    sum += pyramid * (0.75 * face.center + 0.25 * middle);
    volume += pyramid;
  }
  return {volume > 0.0 ? Vec3(sum / volume) : middle, volume / 3.0};
}

Vec3 cell_center(const VectorLanes& low, const VectorLanes& high) {
  const FaceLanes sides = face_lanes(low, next(low), next(high), high);
  const auto level = [](const VectorLanes& face) {
    return face_geometry(Face{face[0], face[1], face[2], face[3]});
  };
  const FaceGeometry bottom = level(low);
  const FaceGeometry top = level(high);
  Vec3 middle = (4.0 * sides.center.mean() + bottom.center + top.center) / 6.0;
  const Lanes pyramids = dot(sides.area, sides.center - VectorLanes(middle));
  const double below = -bottom.area.dot(bottom.center - middle);
  const double above = top.area.dot(top.center - middle);
  const double volume = pyramids.sum() + below + above;
  if (!(volume > 0.0)) return middle;
  const Vec3 moment =
      4.0 * (pyramids * sides.center).mean() + below * bottom.center + above * top.center;
  return 0.75 * moment / volume + 0.25 * middle;
}

Vec3 cell_center(const std::array<Vec3, 8>& p) {
  return cell_center(VectorLanes({p[0], p[1], p[2], p[3]}), VectorLanes({p[4], p[5], p[6], p[7]}));
}

double skewness_between(std::span<const Vec3> face, const FaceGeometry& geometry, const Vec3& owner,
                        const Vec3& neighbour) {
  const Vec3 to_face = geometry.center - owner;
  const Vec3 d = neighbour - owner;
  const double across = geometry.area.dot(d);
  if (across == 0.0) return std::numeric_limits<double>::max();
  const Vec3 offset = to_face - geometry.area.dot(to_face) / across * d;
  return relative(offset, face, geometry.center, least_extent_inside * d.norm());
}

double skewness_at_boundary(std::span<const Vec3> face, const FaceGeometry& geometry,
                            const Vec3& owner) {
  const Vec3 normal = geometry.area.normalized();
  const Vec3 to_face = geometry.center - owner;
  const Vec3 d = normal.dot(to_face) * normal;
  return relative(to_face - d, face, geometry.center, least_extent_at_boundary * d.norm());
}

double best_split_height(const VectorLanes& face, const Vec3* below, const Vec3* above) {
  // Of each corner, the next one and the one opposite: the first and the third triangle lie on
  // either side of one diagonal, the others of the other one.
  const VectorLanes edge = next(face) - face;
  const VectorLanes normal = normalized(cross(edge, next(edge)));
  Lanes height = Lanes::Constant(std::numeric_limits<double>::max());
  if (above != nullptr) height = height.min(dot(VectorLanes(*above) - face, normal));
  if (below != nullptr) height = height.min(dot(face - VectorLanes(*below), normal));
  return std::max(std::min(height[0], height[2]), std::min(height[1], height[3]));
}

}  // namespace hexwall
