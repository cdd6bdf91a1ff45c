#include "exporters/gmsh.h"

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "core/errors.h"
#include "exporters/hex_faces.h"
#include "exporters/output_file.h"
#include "exporters/text.h"

namespace hexwall {
namespace {

/// What tells the two kinds of entities apart in the file.
struct Kind {
  int dimension;
  int element_type;  ///< Gmsh's number
  int corners;       ///< vertices per element
};
constexpr Kind kSurface{2, 3, 4};
constexpr Kind kVolume{3, 5, 8};

/// A discrete surface or volume of Gmsh.
struct Entity {
  Kind kind;
  int tag;
  std::vector<int> groups;    ///< tags of its physical groups
  std::vector<int> vertices;  ///< `kind.corners` per element
  std::vector<int> nodes;     ///< vertices that no entity before it has
  std::vector<int> boundary;  ///< tags of the surfaces around a volume
};

int count(const auto& container) {
  return static_cast<int>(container.size());
}

int element_count(const Entity& entity) {
  return count(entity.vertices) / entity.kind.corners;
}

/// Whether regions have physical groups of their own, behind those of the zones.
bool has_regions(const HexMesh& mesh) {
  return mesh.regions.size() > 1;
}

/// Tags of a zone's own physical group, and that of its region.
std::vector<int> groups_of_zone(const HexMesh& mesh, int zone) {
  std::vector<int> groups{zone + 1};
  if (!has_regions(mesh) || mesh.zones[zone].hexes.empty()) return groups;
  const std::vector<int> region_of = group_of_hexes(mesh, mesh.regions);
  groups.push_back(count(mesh.zones) + region_of[mesh.zones[zone].hexes.front()] + 1);
  return groups;
}

/// The volume of each zone, without its boundary.
std::vector<Entity> volumes_of(const HexMesh& mesh) {
  std::vector<Entity> volumes;
  for (int z = 0; z < count(mesh.zones); ++z) {
    volumes.push_back({kVolume, z + 1, groups_of_zone(mesh, z), {}, {}, {}});
    for (const int hex : mesh.zones[z].hexes)
      volumes.back().vertices.insert(volumes.back().vertices.end(), mesh.hexes[hex].begin(),
                                     mesh.hexes[hex].end());
  }
  return volumes;
}

/// The surfaces of patch `p`, one for each zone behind it, each entered into the volume's boundary.
void append_surfaces(const HexMesh& mesh, const std::vector<HexFace>& faces,
                     const std::vector<int>& zone_of, int p, std::vector<Entity>& surfaces,
                     std::vector<Entity>& volumes) {
  std::vector<std::vector<int>> vertices_by_zone(mesh.zones.size());
  for (const HexFace& face : faces) {
    std::vector<int>& vertices = vertices_by_zone[zone_of[face.hex]];
    const std::array<int, 4> corners = hex_face(mesh, face.hex, face.local);
    vertices.insert(vertices.end(), corners.begin(), corners.end());
  }
  for (std::size_t z = 0; z < vertices_by_zone.size(); ++z) {
    if (vertices_by_zone[z].empty()) continue;
    const int tag = count(surfaces) + 1;
    surfaces.push_back({kSurface, tag, {p + 1}, std::move(vertices_by_zone[z]), {}, {}});
    volumes[z].boundary.push_back(tag);
  }
}

/// The surface of face zone `z`, entered into the boundaries of the volumes on both its sides.
void append_face_zone(const HexMesh& mesh, int z, const HexFaceValues& neighbours,
                      const std::vector<int>& zone_of, std::vector<Entity>& surfaces,
                      std::vector<Entity>& volumes) {
  const int tag = count(surfaces) + 1;
  Entity surface{kSurface, tag, {count(mesh.patches) + z + 1}, {}, {}, {}};
  std::set<int> sides;
  for (const HexFace& face : faces_of_zone(mesh, mesh.face_zones[z], neighbours)) {
    const std::array<int, 4> corners = hex_face(mesh, face.hex, face.local);
    surface.vertices.insert(surface.vertices.end(), corners.begin(), corners.end());
    sides.insert({zone_of[face.hex], zone_of[neighbours[face.hex][face.local]]});
  }
  surfaces.push_back(std::move(surface));
  for (const int side : sides) volumes[side].boundary.push_back(tag);
}

/// Gives each vertex to the first entity that has it.
void distribute_nodes(int vertices, std::vector<Entity>& entities) {
  std::vector<bool> is_taken(vertices, false);
  for (Entity& entity : entities)
    for (const int v : entity.vertices) {
      if (is_taken[v]) continue;
      is_taken[v] = true;
      entity.nodes.push_back(v);
    }
}

/// The surfaces, then the volumes, none of them empty.
std::vector<Entity> entities_of(const HexMesh& mesh) {
  const std::vector<int> zone_of = group_of_hexes(mesh, mesh.zones);
  const HexFaceValues neighbours = neighbours_of_hexes(mesh);
  const auto faces = faces_of_patches(mesh, neighbours);
  std::vector<Entity> entities;
  std::vector<Entity> volumes = volumes_of(mesh);
  for (int p = 0; p < count(mesh.patches); ++p)
    append_surfaces(mesh, faces[p], zone_of, p, entities, volumes);
  for (int z = 0; z < count(mesh.face_zones); ++z)
    append_face_zone(mesh, z, neighbours, zone_of, entities, volumes);
  std::copy_if(volumes.begin(), volumes.end(), std::back_inserter(entities),
               [](const Entity& volume) { return !volume.vertices.empty(); });
  distribute_nodes(count(mesh.points), entities);
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

void append_physical_names(const HexMesh& mesh, Text& text) {
  const int regions = has_regions(mesh) ? count(mesh.regions) : 0;
  text << "$PhysicalNames\n"
       << count(mesh.patches) + count(mesh.face_zones) + count(mesh.zones) + regions << '\n';
  append_names(kSurface.dimension, mesh.patches, 0, text);
  append_names(kSurface.dimension, mesh.face_zones, count(mesh.patches), text);
  append_names(kVolume.dimension, mesh.zones, 0, text);
  if (regions > 0) append_names(kVolume.dimension, mesh.regions, count(mesh.zones), text);
  text << "$EndPhysicalNames\n";
}

void append_point(const Vec3& p, Text& text) {
  text << p.x() << ' ' << p.y() << ' ' << p.z();
}

void append_entity(const HexMesh& mesh, const Entity& entity, Text& text) {
  Eigen::AlignedBox3d box;
  for (const int v : entity.vertices) box.extend(mesh.points[v]);
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

void append_entities(const HexMesh& mesh, const std::vector<Entity>& entities, Text& text) {
  const auto volumes = std::count_if(entities.begin(), entities.end(), [](const Entity& entity) {
    return entity.kind.dimension == kVolume.dimension;
  });
  const int surfaces = count(entities) - static_cast<int>(volumes);
  text << "$Entities\n0 0 " << surfaces << ' ' << static_cast<int>(volumes) << '\n';
  for (const Entity& entity : entities) append_entity(mesh, entity, text);
  text << "$EndEntities\n";
}

/// The line before a block of nodes or elements: its entity, a number, the size.
void append_block(const Entity& entity, int number, int size, Text& text) {
  text << entity.kind.dimension << ' ' << entity.tag << ' ' << number << ' ' << size << '\n';
}

void append_nodes(const HexMesh& mesh, const std::vector<Entity>& entities, Text& text) {
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

void append_element(const Entity& entity, int index, int tag, Text& text) {
  text << tag;
  for (int i = 0; i < entity.kind.corners; ++i)
    text << ' ' << entity.vertices[entity.kind.corners * index + i] + 1;
  text << '\n';
}

void append_elements(const HexMesh& mesh, const std::vector<Entity>& entities, Text& text) {
  int elements = 0;
  for (const Entity& entity : entities) elements += element_count(entity);
  text << "$Elements\n" << count(entities) << ' ' << elements << " 1 " << elements << '\n';
  int face_tag = count(mesh.hexes);
  for (const Entity& entity : entities) {
    append_block(entity, entity.kind.element_type, element_count(entity), text);
    for (int i = 0; i < element_count(entity); ++i) {
      const bool is_volume = entity.kind.dimension == kVolume.dimension;
      const int tag = is_volume ? mesh.zones[entity.groups.front() - 1].hexes[i] + 1 : ++face_tag;
      append_element(entity, i, tag, text);
    }
  }
  text << "$EndElements\n";
}

}  // namespace

void write_gmsh(const std::filesystem::path& path, const HexMesh& mesh) {
  const std::vector<Entity> entities = entities_of(mesh);
  Text text(80 * mesh.points.size() + 80 * mesh.hexes.size() + 1024);
  text << "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";  // version, ASCII, size of a number
  append_physical_names(mesh, text);
  append_entities(mesh, entities, text);
  append_nodes(mesh, entities, text);
  append_elements(mesh, entities, text);
  write_output_file(path, text.take());
}

}  // namespace hexwall
