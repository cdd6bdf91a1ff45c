#include "surface/open_caps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <set>
#include <utility>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "core/errors.h"
#include "surface/loop_shape.h"
#include "surface/names.h"
#include "surface/regions.h"

namespace hexwall {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

// A triangle counts as part of a plane if it is tilted less than this: caps are flat up to the
// rounding of their coordinates and the noise of a remesher.
const double greatest_tilt = std::tan(10.0 * degree);
// ... or if it is thinner than this fraction of its longest edge: the tilt of a needle of
// single-precision coordinates is noise.
constexpr double needle_height = 1e-4;
// Distance from the plane, relative to the radius, of a cap found by its shape and by its label.
constexpr double flat_deviation = 0.03;
constexpr double labelled_deviation = 0.15;
// 4 pi area / length²: 1 for a circle, 0.84 for an ellipse of 2 : 1, 0.66 for 3 : 1.
constexpr double least_roundness = 0.65;
// Facets of coarse walls and steps of voxels have 4 to 6 rim edges.
constexpr std::size_t least_rim_edges = 8;
// An end that is cut 45° off the vessel's axis folds by 45° to 135° at its rim; the wall itself
// folds less even where 10 vertices go around it.
constexpr double sharp_fold = 42.0 * degree;
constexpr double least_sharp_share = 0.8;
// A sharp fold against the plane of the whole cap is at least this much against one triangle of it.
const double least_fold = std::tan(25.0 * degree);

Vec3 apex(const TriangleSurface& surface, const Disk::Side& side) {
  const auto& t = surface.triangles[side.triangle];
  const int a = t[side.side];
  const int b = t[(side.side + 1) % 3];
  for (const int v : surface.triangles[side.outside]) {
    if (v != a && v != b) return surface.points[v];
  }
  return surface.points[a];
}

struct CapShape {
  LoopShape loop;
  double deviation = 0.0;    ///< of its vertices from the plane
  double sharp_share = 0.0;  ///< of the rim's length that is folded sharply, to one side
};

// Angle by which the surface turns from the plane of the cap into the triangle outside, and to
// which side of the plane: 0 straight on, 90° perpendicular, 180° back.
std::pair<double, double> fold_at(const TriangleSurface& surface, const Disk::Side& side,
                                  const Vec3& normal) {
  const auto& t = surface.triangles[side.triangle];
  const Vec3& a = surface.points[t[side.side]];
  const Vec3 along = (surface.points[t[(side.side + 1) % 3]] - a).normalized();
  const Vec3 inward = surface.points[t[(side.side + 2) % 3]] - a;
  Vec3 straight = along.cross(normal);
  if (straight.dot(inward) > 0.0) straight = -straight;
  const Vec3 beyond = apex(surface, side) - a;
  const double height = beyond.dot(normal);
  return {std::atan2(std::abs(height), beyond.dot(straight)), height};
}

CapShape shape_of(const TriangleSurface& surface, const Disk& disk) {
  CapShape shape{loop_shape(points_of(surface, disk.rim))};
  for (const int f : disk.triangles) {
    for (const int v : surface.triangles[f]) {
      const double off = (surface.points[v] - shape.loop.center).dot(shape.loop.normal);
      shape.deviation = std::max(shape.deviation, std::abs(off));
    }
  }
  double balance = 0.0;  // length of rim with the wall above the plane, minus that below
  double sharp = 0.0;
  for (const Disk::Side& side : disk.sides) {
    const auto& t = surface.triangles[side.triangle];
    const auto [angle, height] = fold_at(surface, side, shape.loop.normal);
    const Vec3 edge = surface.points[t[(side.side + 1) % 3]] - surface.points[t[side.side]];
    balance += std::copysign(edge.norm(), height);
    if (angle >= sharp_fold) sharp += std::copysign(edge.norm(), height);
  }
  shape.sharp_share = std::abs(sharp) / shape.loop.length;
  // The wall is where the apices are: the normal points away from them.
  if (balance > 0.0) shape.loop.normal = -shape.loop.normal;
  return shape;
}

bool is_flat(const CapShape& shape, double deviation) {
  return shape.loop.area > 0.0 && shape.deviation <= deviation * shape.loop.radius;
}

bool is_cap(const Disk& disk, const CapShape& shape) {
  const double roundness =
      4.0 * std::numbers::pi * shape.loop.area / (shape.loop.length * shape.loop.length);
  return is_flat(shape, flat_deviation) && roundness >= least_roundness &&
         disk.rim.size() >= least_rim_edges && shape.sharp_share >= least_sharp_share;
}

Cap cap_of(const TriangleSurface& surface, Disk disk, std::string name, std::string how) {
  const Vec3 outward = shape_of(surface, disk).loop.normal;
  std::sort(disk.triangles.begin(), disk.triangles.end());
  return {std::move(name), std::move(how), std::move(disk.triangles), std::move(disk.rim), outward};
}

// Caps end on a wall. Flat disks side by side are the facets of something else.
std::vector<Disk> without_touching(std::vector<Disk> disks, std::size_t face_count) {
  std::vector<int> disk_of(face_count, -1);
  for (std::size_t i = 0; i < disks.size(); ++i) {
    for (const int f : disks[i].triangles) disk_of[f] = static_cast<int>(i);
  }
  std::erase_if(disks, [&](const Disk& disk) {
    return std::any_of(disk.sides.begin(), disk.sides.end(),
                       [&](const Disk::Side& side) { return disk_of[side.outside] >= 0; });
  });
  return disks;
}

// --- by label -----------------------------------------------------------------------------------

struct Region {
  double value;
  double area;
  std::vector<int> triangles;
};

std::vector<Region> regions_of_equal_value(const TriangleSurface& surface,
                                           const std::vector<FaceNeighbours>& neighbours,
                                           const SurfaceArray& array) {
  std::vector<Region> regions;
  RegionGrower grower(neighbours);
  std::vector<char> done(surface.triangles.size(), 0);
  for (int f = 0; f < static_cast<int>(done.size()); ++f) {
    if (done[f] != 0) continue;
    const double value = array.values[f];
    Region region{value, 0.0, grower.grow(f, [&](int g) { return array.values[g] == value; })};
    for (const int g : region.triangles) {
      done[g] = 1;
      region.area += 0.5 * doubled_area_vector(surface, g).norm();
    }
    regions.push_back(std::move(region));
  }
  return regions;
}

bool is_named(const SurfaceArray& array, const std::string& name) {
  return array.name == name && array.components == 1;
}

enum class Rule { positive, flat, all_but_largest };

std::vector<Cap> caps_of_array(const TriangleSurface& surface,
                               const std::vector<FaceNeighbours>& neighbours,
                               const SurfaceArray& array, Rule rule) {
  const std::vector<Region> regions = regions_of_equal_value(surface, neighbours, array);
  const auto largest =
      std::max_element(regions.begin(), regions.end(),
                       [](const Region& a, const Region& b) { return a.area < b.area; });
  std::vector<Disk> disks;
  for (auto region = regions.begin(); region != regions.end(); ++region) {
    if (rule == Rule::positive && !(region->value > 0.0)) continue;
    if (rule == Rule::all_but_largest && region == largest) continue;
    auto disk = as_disk(surface, neighbours, region->triangles);
    if (!disk) continue;
    if (rule == Rule::flat && !is_flat(shape_of(surface, *disk), labelled_deviation)) continue;
    disks.push_back(std::move(*disk));
  }
  if (rule == Rule::flat) disks = without_touching(std::move(disks), surface.triangles.size());
  std::map<double, int> parts;
  std::vector<Cap> caps;
  for (Disk& disk : disks) {
    const double value = array.values[disk.triangles.front()];
    const int part = ++parts[value];
    std::string name = fmt::format("{}_{:g}", array.name, value);
    if (part > 1) name += fmt::format("_part{}", part);
    caps.push_back(cap_of(surface, std::move(disk), valid_name(name),
                          fmt::format("array {} = {:g}", array.name, value)));
  }
  return caps;
}

std::vector<Cap> caps_of_named_array(const TriangleSurface& surface,
                                     const std::vector<FaceNeighbours>& neighbours,
                                     const std::vector<SurfaceArray>& cell_arrays,
                                     const std::string& name) {
  std::string known;
  for (const SurfaceArray& array : cell_arrays) {
    if (array.components == 1) known += " " + array.name;
    if (!is_named(array, name)) continue;
    std::vector<Cap> caps = caps_of_array(surface, neighbours, array, Rule::all_but_largest);
    if (!caps.empty()) return caps;
    throw UsageError(fmt::format(
        "the array '{}' marks no caps: none of its connected regions of equal value, but for the "
        "largest, is a disk",
        name));
  }
  throw UsageError(fmt::format("the surface has no cell array '{}' of one component. It has{}",
                               name, known.empty() ? " none" : known));
}

// --- by shape -----------------------------------------------------------------------------------

/// Whether the triangle is parallel to a plane, up to the tolerances.
bool is_parallel(const TriangleSurface& surface, int f, const Vec3& normal) {
  const auto& [a, b, c] = surface.triangles[f];
  const auto& p = surface.points;
  const Vec3 area = doubled_area_vector(surface, f);
  const double off = area.cross(normal).norm();
  const double longest = std::max(
      {(p[b] - p[a]).squaredNorm(), (p[c] - p[b]).squaredNorm(), (p[a] - p[c]).squaredNorm()});
  return off <= greatest_tilt * std::abs(area.dot(normal)) + needle_height * longest;
}

// Whether half of the region's rim is folded at all, so that it may be a cap: the facets of a wall,
// of which there are many, are told from it quickly.
bool has_folds(const TriangleSurface& surface, const std::vector<FaceNeighbours>& neighbours,
               const std::vector<int>& region, const RegionGrower& grower, const Vec3& normal) {
  double balance = 0.0;  // length that is folded, minus that which is not
  for (const int f : region) {
    for (int k = 0; k < 3; ++k) {
      const int g = neighbours[f][k];
      if (g < 0) return false;  // not a disk within the surface
      if (grower.contains(g)) continue;
      const auto& t = surface.triangles[f];
      const double length = (surface.points[t[(k + 1) % 3]] - surface.points[t[k]]).norm();
      const Vec3 area = doubled_area_vector(surface, g);
      const bool is_folded = area.cross(normal).norm() > least_fold * std::abs(area.dot(normal));
      balance += is_folded ? length : -length;
    }
  }
  return balance > 0.0;
}

// Largest first, so that regions start from triangles whose normal can be trusted.
std::vector<int> seeds_by_area(const TriangleSurface& surface) {
  std::vector<double> area;
  area.reserve(surface.triangles.size());
  for (int f = 0; f < static_cast<int>(surface.triangles.size()); ++f) {
    const double doubled = doubled_area_vector(surface, f).norm();
    area.push_back(std::isfinite(doubled) ? doubled : 0.0);
  }
  std::vector<int> seeds(area.size());
  std::iota(seeds.begin(), seeds.end(), 0);
  std::stable_sort(seeds.begin(), seeds.end(), [&](int a, int b) { return area[a] > area[b]; });
  while (!seeds.empty() && area[seeds.back()] == 0.0) seeds.pop_back();
  return seeds;
}

}  // namespace

std::vector<Cap> labelled_caps(const TriangleSurface& surface,
                               const std::vector<SurfaceArray>& cell_arrays,
                               const std::optional<std::string>& cap_array) {
  if (cell_arrays.empty() && !cap_array) return {};
  const auto neighbours = face_neighbours(surface.triangles);
  if (cap_array) return caps_of_named_array(surface, neighbours, cell_arrays, *cap_array);
  constexpr std::array<std::pair<const char*, Rule>, 3> known{
      {{"CapID", Rule::positive}, {"ModelFaceID", Rule::flat}, {"CellEntityIds", Rule::flat}}};
  for (const auto& [name, rule] : known) {
    for (const SurfaceArray& array : cell_arrays) {
      if (!is_named(array, name)) continue;
      std::vector<Cap> caps = caps_of_array(surface, neighbours, array, rule);
      if (!caps.empty()) return caps;
    }
  }
  return {};
}

std::vector<Cap> flat_caps(const TriangleSurface& surface) {
  const auto neighbours = face_neighbours(surface.triangles);
  RegionGrower grower(neighbours);
  std::vector<char> tried(surface.triangles.size(), 0);
  std::vector<Disk> disks;
  for (const int seed : seeds_by_area(surface)) {
    if (tried[seed] != 0) continue;
    const Vec3 normal = doubled_area_vector(surface, seed).normalized();
    std::vector<int> region =
        grower.grow(seed, [&](int f) { return is_parallel(surface, f, normal); });
    for (const int f : region) tried[f] = 1;
    if (region.size() + 2 < least_rim_edges) continue;  // a disk has no more rim edges
    if (!has_folds(surface, neighbours, region, grower, normal)) continue;
    auto disk = as_disk(surface, neighbours, std::move(region));
    if (disk && is_cap(*disk, shape_of(surface, *disk))) disks.push_back(std::move(*disk));
  }
  std::vector<Cap> caps;
  for (Disk& disk : without_touching(std::move(disks), surface.triangles.size())) {
    caps.push_back(cap_of(surface, std::move(disk), "", "flat cap"));
  }
  std::sort(caps.begin(), caps.end(),
            [](const Cap& a, const Cap& b) { return a.triangles < b.triangles; });
  return caps;
}

}  // namespace hexwall
