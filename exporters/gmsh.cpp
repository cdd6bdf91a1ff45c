#include "exporters/gmsh.h"

#include <algorithm>
#include <array>
#include <map>
#include <ostream>
#include <set>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "core/errors.h"
#include "exporters/output_file.h"
#include "exporters/text.h"
#include "hex/cell_faces.h"

namespace hexwall {
namespace {

constexpr int kSurface = 2;
constexpr int kVolume = 3;

/// Gmsh's numbers of the kinds of elements.
constexpr int kTriangle = 2;
constexpr int kQuadrangle = 3;

/// Elements of one kind: faces, or cells of the mesh.
struct Block {
  int corners = 0;            ///< vertices per face
  std::vector<int> vertices;  ///< `corners` per face
  std::vector<int> cells;
};

/// A discrete surface or volume of Gmsh.
struct Entity {
  int dimension;
  int tag;
  std::vector<int> groups;           ///< tags of its physical groups
  std::map<int, Block> blocks = {};  ///< by Gmsh's number of their kind
  std::vector<int> nodes = {};       ///< vertices that no entity before it has
  std::vector<int> boundary = {};    ///< tags of the surfaces around a volume

  void add_face(const std::array<int, 4>& face) {
    const int corners = corner_count(face);
    Block& block = blocks[corners == 3 ? kTriangle : kQuadrangle];
    block.corners = corners;
    block.vertices.insert(block.vertices.end(), face.begin(), face.begin() + corners);
  }
};

int gmsh_kind(CellShape shape) {
  switch (shape) {
    case CellShape::tetrahedron:
      return 4;
    case CellShape::hexahedron:
      return 5;
    case CellShape::wedge:
      return 6;
    default:
      return 7;
  }
}

int count(const auto& container) {
  return static_cast<int>(container.size());
}

int element_count(const Block& block) {
  return block.cells.empty() ? count(block.vertices) / block.corners : count(block.cells);
}

std::span<const int> element(const CellMesh& mesh, const Block& block, int i) {
  if (!block.cells.empty()) return mesh.corners(block.cells[i]);
  return {block.vertices.data() + block.corners * i, static_cast<std::size_t>(block.corners)};
}

/// Calls `visit` with each vertex of each element of an entity.
template <typename Visit>
void for_each_corner(const CellMesh& mesh, const Entity& entity, Visit visit) {
  for (const auto& [kind, block] : entity.blocks)
    for (int i = 0; i < element_count(block); ++i)
      for (const int v : element(mesh, block, i)) visit(v);
}

/// Whether regions have physical groups of their own, behind those of the zones.
bool has_regions(const CellMesh& mesh) {
  return mesh.regions.size() > 1;
}

/// Tags of a zone's own physical group, and that of its region.
std::vector<int> groups_of_zone(const CellMesh& mesh, int zone) {
  std::vector<int> groups{zone + 1};
  if (!has_regions(mesh) || mesh.zones[zone].cells.empty()) return groups;
  const std::vector<int> region_of = group_of_cells(mesh, mesh.regions);
  groups.push_back(count(mesh.zones) + region_of[mesh.zones[zone].cells.front()] + 1);
  return groups;
}

/// The volume of each zone, without its boundary.
std::vector<Entity> volumes_of(const CellMesh& mesh) {
  std::vector<Entity> volumes;
  for (int z = 0; z < count(mesh.zones); ++z) {
    Entity volume{kVolume, z + 1, groups_of_zone(mesh, z)};
    for (const int cell : mesh.zones[z].cells)
      volume.blocks[gmsh_kind(mesh.shape[cell])].cells.push_back(cell);
    volumes.push_back(std::move(volume));
  }
  return volumes;
}

/// The surfaces of patch `p`, one for each zone behind it, each entered into the volume's boundary.
void append_surfaces(const CellMesh& mesh, const std::vector<LocalFace>& faces,
                     const std::vector<int>& zone_of, int p, std::vector<Entity>& surfaces,
                     std::vector<Entity>& volumes) {
  std::vector<Entity> by_zone(mesh.zones.size(), Entity{kSurface, 0, {p + 1}});
  for (const auto& [cell, local] : faces)
    by_zone[zone_of[cell]].add_face(cell_face(mesh, cell, local));
  for (std::size_t z = 0; z < by_zone.size(); ++z) {
    if (by_zone[z].blocks.empty()) continue;
    by_zone[z].tag = count(surfaces) + 1;
    volumes[z].boundary.push_back(by_zone[z].tag);
    surfaces.push_back(std::move(by_zone[z]));
  }
}

/// The surface of face zone `z`, entered into the boundaries of the volumes on both its sides.
void append_face_zone(const CellMesh& mesh, int z, const CellFaceValues& neighbours,
                      const std::vector<int>& zone_of, std::vector<Entity>& surfaces,
                      std::vector<Entity>& volumes) {
  const int tag = count(surfaces) + 1;
  Entity surface{kSurface, tag, {count(mesh.patches) + z + 1}};
  std::set<int> sides;
  for (const auto& [cell, local] : faces_of_zone(mesh, mesh.face_zones[z], neighbours)) {
    surface.add_face(cell_face(mesh, cell, local));
    sides.insert({zone_of[cell], zone_of[neighbours[cell][local]]});
  }
  surfaces.push_back(std::move(surface));
  for (const int side : sides) volumes[side].boundary.push_back(tag);
}

/// Gives each vertex to the first entity that has it.
void distribute_nodes(const CellMesh& mesh, std::vector<Entity>& entities) {
  std::vector<bool> is_taken(mesh.points.size(), false);
  for (Entity& entity : entities)
    for_each_corner(mesh, entity, [&](int v) {
      if (is_taken[v]) return;
      is_taken[v] = true;
      entity.nodes.push_back(v);
    });
}

/// The surfaces, then the volumes, none of them empty.
std::vector<Entity> entities_of(const CellMesh& mesh) {
  const std::vector<int> zone_of = group_of_cells(mesh, mesh.zones);
  const CellFaceValues neighbours = neighbours_of_cells(mesh);
  const auto faces = faces_of_patches(mesh, neighbours);
  std::vector<Entity> entities;
  std::vector<Entity> volumes = volumes_of(mesh);
  for (int p = 0; p < count(mesh.patches); ++p)
    append_surfaces(mesh, faces[p], zone_of, p, entities, volumes);
  for (int z = 0; z < count(mesh.face_zones); ++z)
    append_face_zone(mesh, z, neighbours, zone_of, entities, volumes);
  std::copy_if(volumes.begin(), volumes.end(), std::back_inserter(entities),
               [](const Entity& volume) { return !volume.blocks.empty(); });
  distribute_nodes(mesh, entities);
  return entities;
}

const std::string& checked_name(const std::string& name) {
  if (std::any_of(name.begin(), name.end(), [](unsigned char c) { return c < ' ' || c == '"'; }))
    throw Error(ExitCode::internal, "cannot export to Gmsh: the name '" + name +
                                        "' has a quote or a control character");
  return name;
}

/// \param before number of names of this dimension that come before
template <typename Named>
void append_names(int dimension, const std::vector<Named>& list, int before, Text& text) {
  for (int i = 0; i < count(list); ++i)
    text << dimension << ' ' << before + i + 1 << " \"" << checked_name(list[i].name) << "\"\n";
}

void append_physical_names(const CellMesh& mesh, Text& text) {
  const int regions = has_regions(mesh) ? count(mesh.regions) : 0;
  text << "$PhysicalNames\n"
       << count(mesh.patches) + count(mesh.face_zones) + count(mesh.zones) + regions << '\n';
  append_names(kSurface, mesh.patches, 0, text);
  append_names(kSurface, mesh.face_zones, count(mesh.patches), text);
  append_names(kVolume, mesh.zones, 0, text);
  if (regions > 0) append_names(kVolume, mesh.regions, count(mesh.zones), text);
  text << "$EndPhysicalNames\n";
}

void append_point(const Vec3& p, Text& text) {
  text << p.x() << ' ' << p.y() << ' ' << p.z();
}

void append_entity(const CellMesh& mesh, const Entity& entity, Text& text) {
  Eigen::AlignedBox3d box;
  for_each_corner(mesh, entity, [&](int v) { box.extend(mesh.points[v]); });
  text << entity.tag << ' ';
  append_point(box.min(), text);
  text << ' ';
  append_point(box.max(), text);
  text << ' ' << count(entity.groups);
  for (const int group : entity.groups) text << ' ' << group;
  text << ' ' << count(entity.boundary);
  for (const int surface : entity.boundary) text << ' ' << surface;
  text << '\n';
}

void append_entities(const CellMesh& mesh, const std::vector<Entity>& entities, Text& text) {
  const auto volumes = std::count_if(entities.begin(), entities.end(), [](const Entity& entity) {
    return entity.dimension == kVolume;
  });
  const int surfaces = count(entities) - static_cast<int>(volumes);
  text << "$Entities\n0 0 " << surfaces << ' ' << static_cast<int>(volumes) << '\n';
  for (const Entity& entity : entities) append_entity(mesh, entity, text);
  text << "$EndEntities\n";
}

/// The line before a block of nodes or elements: its entity, a number, the size.
void append_block(const Entity& entity, int number, int size, Text& text) {
  text << entity.dimension << ' ' << entity.tag << ' ' << number << ' ' << size << '\n';
}

void append_nodes(const CellMesh& mesh, const std::vector<Entity>& entities, Text& text) {
  int nodes = 0;
  for (const Entity& entity : entities) nodes += count(entity.nodes);
  text << "$Nodes\n" << count(entities) << ' ' << nodes << " 1 " << count(mesh.points) << '\n';
  for (const Entity& entity : entities) {
    append_block(entity, 0, count(entity.nodes), text);  // 0: without parametric coordinates
    for (const int v : entity.nodes) text << v + 1 << '\n';
    for (const int v : entity.nodes) {
      append_point(mesh.points[v], text);
      text << '\n';
    }
  }
  text << "$EndNodes\n";
}

void append_elements(const CellMesh& mesh, const std::vector<Entity>& entities, Text& text) {
  int blocks = 0;
  int elements = 0;
  for (const Entity& entity : entities)
    for (const auto& [kind, block] : entity.blocks) {
      ++blocks;
      elements += element_count(block);
    }
  text << "$Elements\n" << blocks << ' ' << elements << " 1 " << elements << '\n';
  int face_tag = mesh.cells();
  for (const Entity& entity : entities)
    for (const auto& [kind, block] : entity.blocks) {
      append_block(entity, kind, element_count(block), text);
      for (int i = 0; i < element_count(block); ++i) {
        text << (block.cells.empty() ? ++face_tag : block.cells[i] + 1);
        for (const int v : element(mesh, block, i)) text << ' ' << v + 1;
        text << '\n';
      }
    }
  text << "$EndElements\n";
}

}  // namespace

void write_gmsh(const std::filesystem::path& path, const CellMesh& mesh) {
  const std::vector<Entity> entities = entities_of(mesh);
  write_output_file(path, [&](std::ostream& stream) {
    Text text(stream);
    text << "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";  // version, ASCII, size of a number
    append_physical_names(mesh, text);
    append_entities(mesh, entities, text);
    append_nodes(mesh, entities, text);
    append_elements(mesh, entities, text);
    text.pass_on();
  });
}

}  // namespace hexwall
