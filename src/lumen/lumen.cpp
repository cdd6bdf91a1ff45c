#include "lumen/lumen.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "core/errors.h"
#include "hex/cell_faces.h"
#include "lumen/core_surface.h"
#include "lumen/reconnect.h"
#include "lumen/tetgen.h"
#include "surface/loop_shape.h"

namespace hexwall {
namespace {

constexpr int improvement_rounds = 6;
constexpr double hybrid_core_growth = 0.2;
constexpr double most_skewness = 4.0;  // OpenFOAM reports more
// Where faces stay bad whatever moves, other tetrahedra are tried: edges by these factors.
constexpr std::array other_sizes{0.9, 1.1, 0.8};

std::vector<std::string> opening_names(const PipelineResult& r) {
  std::vector<std::string> names;
  for (const Opening& opening : r.openings) names.push_back(opening.name);
  return names;
}

// The quads at the inside of the layers; all of the skin's vertices have the numbers of the quads'.
QuadMesh inner_skin(const PipelineResult& r) {
  QuadMesh skin = r.quads;
  std::copy_n(r.wall.points.begin(), skin.points.size(), skin.points.begin());
  return skin;
}

using Triangle = std::array<int, 3>;

Triangle sorted(Triangle t) {
  std::sort(t.begin(), t.end());
  return t;
}

/// Puts the pieces of a lumen's mesh together.
class Assembler {
 public:
  Assembler(const PipelineResult& r, const CoreSurface& core, const TetMesh& tets)
      : r_(r), core_(core), tets_(tets) {}

  CellMesh hybrid() {
    mesh_ = static_cast<const CellMesh&>(r_.wall);
    first_own_ = static_cast<int>(r_.quads.points.size());
    first_added_ = static_cast<int>(mesh_.points.size());
    add_points();
    const int first_cell = mesh_.cells();
    add_pyramids();
    add_tets();
    mesh_.patches.erase(std::find_if(mesh_.patches.begin(), mesh_.patches.end(),
                                     [](const CellPatch& p) { return p.name == "core"; }));
    add_faces("");
    enter_cells(first_cell);
    return std::move(mesh_);
  }

  CellMesh tet() {
    first_own_ = 0;
    first_added_ = 0;
    add_points();
    add_tets();
    mesh_.patches.push_back({"wall", true, {}});
    for (const Opening& opening : r_.openings) mesh_.patches.push_back({opening.name, false, {}});
    mesh_.regions.push_back({"lumen", {}});
    add_faces("wall");
    enter_cells(0);
    return std::move(mesh_);
  }

 private:
  // Vertices of the core that the hexes have keep their numbers, others come after the hexes'.
  int global(int v) const { return v < first_own_ ? v : v - first_own_ + first_added_; }

  void add_points() {
    mesh_.points.insert(mesh_.points.end(), tets_.points.begin() + first_own_, tets_.points.end());
  }

  void add_pyramids() {
    for (std::size_t q = 0; q < r_.quads.quads.size(); ++q) {
      const auto& [a, b, c, d] = r_.quads.quads[q];
      mesh_.add(CellShape::pyramid,
                std::array{a, d, c, b, global(core_.first_apex + static_cast<int>(q))});
    }
  }

  void add_tets() {
    first_tet_ = mesh_.cells();
    for (const auto& [a, b, c, d] : tets_.tets) {
      mesh_.add(CellShape::tetrahedron, std::array{global(a), global(b), global(c), global(d)});
    }
  }

  CellPatch& patch(const std::string& name) {
    return *std::find_if(mesh_.patches.begin(), mesh_.patches.end(),
                         [&](const CellPatch& p) { return p.name == name; });
  }

  // The tetrahedron behind each triangle of the core's surface that is a face of a patch.
  std::vector<int> tets_behind(const std::vector<int>& triangles) const {
    std::vector<std::pair<Triangle, int>> wanted;
    for (const int t : triangles) wanted.emplace_back(sorted(core_.surface.triangles[t]), t);
    std::sort(wanted.begin(), wanted.end());
    std::vector<int> behind(core_.surface.triangles.size(), -1);
    const auto vertices = static_cast<int>(core_.surface.points.size());
    for (std::size_t i = 0; i < tets_.tets.size(); ++i) {
      const auto& t = tets_.tets[i];
      for (int k = 0; k < 4; ++k) {
        const Triangle face = sorted({t[(k + 1) % 4], t[(k + 2) % 4], t[(k + 3) % 4]});
        if (face[2] >= vertices) continue;
        const auto found = std::lower_bound(wanted.begin(), wanted.end(), std::pair(face, -1));
        if (found == wanted.end() || found->first != face) continue;
        behind[found->second] = first_tet_ + static_cast<int>(i);
      }
    }
    return behind;
  }

  // Caps to the patches of the openings, the rest to the wall if that is made of triangles.
  void add_faces(const std::string& wall) {
    std::vector<int> triangles;
    for (std::size_t t = 0; t < core_.opening.size(); ++t) {
      if (core_.opening[t] >= 0 || !wall.empty()) triangles.push_back(static_cast<int>(t));
    }
    const std::vector<int> behind = tets_behind(triangles);
    std::map<int, CellPatch*> patches;
    if (!wall.empty()) patches[-1] = &patch(wall);
    for (int i = 0; i < static_cast<int>(r_.openings.size()); ++i) {
      patches[i] = &patch(r_.openings[i].name);
    }
    for (const int t : triangles) {
      const auto& [a, b, c] = core_.surface.triangles[t];
      patches[core_.opening[t]]->faces.push_back(
          {{global(a), global(b), global(c), -1}, behind[t]});
    }
  }

  void enter_cells(int first) {
    CellGroup zone{"lumen_core", {}};
    CellGroup& lumen = mesh_.regions.front();
    for (int cell = first; cell < mesh_.cells(); ++cell) {
      zone.cells.push_back(cell);
      lumen.cells.push_back(cell);
    }
    mesh_.zones.push_back(std::move(zone));
  }

  const PipelineResult& r_;
  const CoreSurface& core_;
  const TetMesh& tets_;
  int first_own_ = 0, first_added_ = 0, first_tet_ = 0;
  CellMesh mesh_;
};

// Apexes, and what lies inside the core.
std::vector<char> movable_vertices(const CellMesh& mesh, const CoreSurface& core,
                                   const TetMesh& tets) {
  std::vector<char> movable(mesh.points.size(), 0);
  const std::size_t offset = mesh.points.size() - tets.points.size();
  const int apexes_end = core.has_apexes ? core.first_cap_point : core.first_apex;
  for (int v = core.first_apex; v < apexes_end; ++v) movable[offset + v] = 1;
  for (std::size_t v = core.surface.points.size(); v < tets.points.size(); ++v) {
    movable[offset + v] = 1;
  }
  return movable;
}

/// A mesh of hexes, pyramids and tetrahedra.
struct Hybrid {
  CellMesh mesh;
  ImproveResult improvement;
  std::vector<CellQuality> quality;  // of each region
};

// Moves points and reconnects tetrahedra in turn, until nothing changes.
void improve_core(const PipelineResult& r, const CoreSurface& core, TetMesh& tets, Hybrid& result) {
  const auto first_tet = static_cast<int>(
      std::find(result.mesh.shape.begin(), result.mesh.shape.end(), CellShape::tetrahedron) -
      result.mesh.shape.begin());
  const std::size_t own = r.quads.points.size();
  const std::size_t added = r.wall.points.size();
  for (int round = 0; round < improvement_rounds; ++round) {
    const ImproveResult moves = improve(result.mesh, movable_vertices(result.mesh, core, tets));
    result.improvement.moved += moves.moved;
    int changes = 0;
    const auto reconnected = reconnect(result.mesh, first_tet, changes);
    result.improvement.reconnected += changes;
    if (changes == 0) return;
    std::copy(result.mesh.points.begin() + static_cast<std::ptrdiff_t>(added),
              result.mesh.points.end(), tets.points.begin() + static_cast<std::ptrdiff_t>(own));
    tets.tets = reconnected;
    for (auto& tet : tets.tets) {
      for (int& v : tet) v = v < static_cast<int>(own) ? v : v - static_cast<int>(added - own);
    }
    result.mesh = Assembler(r, core, tets).hybrid();
  }
}

std::vector<CellQuality> qualities(const CellMesh& mesh) {
  if (mesh.regions.size() == 1) return {cell_quality(mesh)};
  std::vector<CellQuality> result;
  for (int region = 0; region < static_cast<int>(mesh.regions.size()); ++region) {
    result.push_back(cell_quality(region_mesh(mesh, region)));
  }
  return result;
}

// Steep faces of the lumen, and one more if any is too skewed.
int complaints(const Hybrid& hybrid) {
  const CellQuality& lumen = hybrid.quality.front();
  return lumen.faces_above_70 + (lumen.skewness.value > most_skewness ? 1 : 0);
}

// \param size factor on the edges.
TetMesh fill(const CoreSurface& core, const LumenOptions& options, double size,
             LumenResult& result) {
  const bool is_hybrid = options.mesh == LumenOptions::Mesh::hybrid;
  std::vector<double> edge = core.edge;
  for (double& length : edge) length *= size;
  TetOptions tet_options;
  tet_options.growth = options.core_growth.value_or(is_hybrid ? hybrid_core_growth : 0.0);
  tet_options.seconds = options.seconds;
  TetMesh tets = fill_with_tets(core.surface, edge, tet_options);
  result.tetgen_seconds += tets.seconds;
  result.tetgen_memory_bytes = std::max(result.tetgen_memory_bytes, tets.memory_bytes);
  return tets;
}

Hybrid make_hybrid(const PipelineResult& r, const CoreSurface& core, TetMesh tets) {
  Hybrid result{Assembler(r, core, tets).hybrid(), {}, {}};
  improve_core(r, core, tets, result);
  result.quality = qualities(result.mesh);
  return result;
}

// Fills the core again where it did not come out well. \returns the best.
Hybrid try_other_cores(const PipelineResult& r, const CoreSurface& core,
                       const LumenOptions& options, Hybrid best, LumenResult& result) {
  for (const double size : other_sizes) {
    if (complaints(best) == 0) break;
    try {
      Hybrid other = make_hybrid(r, core, fill(core, options, size, result));
      if (complaints(other) < complaints(best)) best = std::move(other);
    } catch (const MeshingError&) {
      continue;  // there is a mesh
    }
  }
  return best;
}

LumenOpening measure(const CellMesh& mesh, const std::string& name) {
  LumenOpening opening{name, false, Vec3::Zero(), Vec3::Zero(), 0.0, 0.0};
  const auto patch = std::find_if(mesh.patches.begin(), mesh.patches.end(),
                                  [&](const CellPatch& p) { return p.name == name; });
  Vec3 sum = Vec3::Zero();
  for (const CellFace& face : patch->faces) {
    const FaceGeometry geometry = face_geometry(FacePoints(mesh.points, face.vertices).span());
    const double area = geometry.area.norm();
    opening.area += area;
    opening.center += area * geometry.center;
    sum += geometry.area;
  }
  opening.center /= opening.area;
  opening.normal = sum.normalized();
  opening.radius = std::sqrt(opening.area / std::numbers::pi);
  return opening;
}

std::vector<LumenOpening> measure_openings(const CellMesh& mesh, const PipelineResult& r,
                                           const std::string& inlet) {
  std::vector<LumenOpening> openings;
  for (const Opening& opening : r.openings) openings.push_back(measure(mesh, opening.name));
  const auto is_inlet = [&](const LumenOpening& o) { return o.patch == inlet; };
  const auto found = inlet.empty()
                         ? std::max_element(openings.begin(), openings.end(),
                                            [](const LumenOpening& a, const LumenOpening& b) {
                                              return a.area < b.area;
                                            })
                         : std::find_if(openings.begin(), openings.end(), is_inlet);
  found->inlet = true;
  return openings;
}

void check_inlet(const PipelineResult& r, const std::string& inlet) {
  const std::vector<std::string> names = opening_names(r);
  if (inlet.empty() || std::find(names.begin(), names.end(), inlet) != names.end()) return;
  throw UsageError(fmt::format("--inlet: no opening is named '{}'. There are: {}", inlet,
                               fmt::join(names, ", ")));
}

CellCounts count_cells(const CellMesh& mesh) {
  CellCounts counts;
  for (const CellShape shape : mesh.shape) {
    if (shape == CellShape::hexahedron) ++counts.hexes;
    if (shape == CellShape::pyramid) ++counts.pyramids;
    if (shape == CellShape::tetrahedron) ++counts.tets;
  }
  return counts;
}

// What OpenFOAM would complain of.
void add_quality_warnings(LumenResult& r) {
  for (std::size_t i = 0; i < r.quality.size(); ++i) {
    const CellQuality& q = r.quality[i];
    const std::string& region = r.mesh.regions[i].name;
    const char* advice = "choose a smaller --size, --size-by radius, or thinner layers";
    if (q.faces_above_70 > 0) {
      r.warnings.push_back(fmt::format(
          "{} faces of the {} have a non-orthogonality above 70 deg, the worst {:.1f} at {}: {}",
          q.faces_above_70, region, q.non_orthogonality.value, coordinates(q.non_orthogonality.at),
          advice));
    }
    if (q.skewness.value > most_skewness) {
      r.warnings.push_back(fmt::format("the skewness of the {} reaches {:.2f} at {}: {}", region,
                                       q.skewness.value, coordinates(q.skewness.at), advice));
    }
  }
}

}  // namespace

LumenResult make_lumen(const PipelineResult& r, const LumenOptions& options,
                       const ProgressCallback& progress) {
  check_inlet(r, options.inlet);
  const bool is_hybrid = options.mesh == LumenOptions::Mesh::hybrid;
  LumenResult result;
  StageClock clock(progress, 4);
  clock.begin("caps");
  const CoreSurface core = is_hybrid ? pyramid_surface(inner_skin(r), opening_names(r))
                                     : split_surface(r.quads, opening_names(r));
  clock.begin("tetrahedra");
  TetMesh tets = fill(core, options, 1.0, result);
  if (is_hybrid) {
    clock.begin("improve");
    Hybrid hybrid =
        try_other_cores(r, core, options, make_hybrid(r, core, std::move(tets)), result);
    result.mesh = std::move(hybrid.mesh);
    result.improvement = hybrid.improvement;
    result.quality = std::move(hybrid.quality);
  } else {
    result.mesh = Assembler(r, core, tets).tet();
    result.quality = qualities(result.mesh);
  }
  clock.begin("judge");
  result.lowered_pyramids = core.lowered;
  result.openings = measure_openings(result.mesh, r, options.inlet);
  result.counts = count_cells(result.mesh);
  add_quality_warnings(result);
  clock.end();
  result.times = clock.times();
  return result;
}

}  // namespace hexwall
