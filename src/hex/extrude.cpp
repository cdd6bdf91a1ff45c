#include "hex/extrude.h"

#include "quad/boundary.h"

namespace hexwall {
namespace {

class HexBuilder {
 public:
  HexBuilder(const QuadMesh& quads, const std::vector<std::string>& loop_names,
             const WallShape& shape)
      : quads_(quads),
        loop_names_(loop_names),
        shape_(shape),
        plan_(shape.plan),
        has_inner_(plan_.inner > 0),
        has_outer_(plan_.has_outer()),
        vertex_count_(static_cast<int>(quads.points.size())),
        quad_count_(static_cast<int>(quads.quads.size())) {}

  HexMesh run(const std::vector<Vec3>& directions) {
    add_points(directions);
    reserve_hexes();
    for (const std::string& name : plan_.zone_names) mesh_.zones.push_back({name, {}});
    if (has_inner_) mesh_.regions.push_back({"lumen", {}});
    if (has_outer_) mesh_.regions.push_back({"wall", {}});
    for (int layer = 0; layer < plan_.layers(); ++layer) add_layer(layer);
    add_skins();
    add_ends();
    if (has_inner_ && has_outer_) add_interface();
    return std::move(mesh_);
  }

 private:
  int at(int v, int level) const { return level * vertex_count_ + v; }
  int hex(int quad, int layer) const { return layer * quad_count_ + quad; }

  void add_points(const std::vector<Vec3>& directions) {
    mesh_.points.reserve(plan_.levels.size() * quads_.points.size());
    for (const double level : plan_.levels) {
      for (int v = 0; v < vertex_count_; ++v) {
        mesh_.points.push_back(point_at(quads_.points[v], directions[v],
                                        has_outer_ ? shape_.outward[v] : 0.0,
                                        has_inner_ ? shape_.inward[v] : 0.0, level));
      }
    }
  }

  void reserve_hexes() {
    const std::size_t hexes = plan_.layers() * quads_.quads.size();
    mesh_.reserve(hexes, 8 * hexes);
    mesh_.layer.reserve(hexes);
    mesh_.quad.reserve(hexes);
  }

  void add_layer(int layer) {
    CellGroup& zone = mesh_.zones[plan_.zone[layer]];
    CellGroup& region = layer < plan_.inner ? mesh_.regions.front() : mesh_.regions.back();
    for (int q = 0; q < quad_count_; ++q) {
      std::array<int, 8> corners;
      for (int k = 0; k < 4; ++k) {
        corners[k] = at(quads_.quads[q][k], layer);
        corners[k + 4] = at(quads_.quads[q][k], layer + 1);
      }
      zone.cells.push_back(hex(q, layer));
      region.cells.push_back(hex(q, layer));
      mesh_.add(CellShape::hexahedron, corners);
      mesh_.layer.push_back(layer);
      mesh_.quad.push_back(q);
    }
  }

  // The quads at a level, as faces of the layer below them, or else turned over.
  std::vector<CellFace> faces_at(int level, int layer) const {
    std::vector<CellFace> faces;
    faces.reserve(quads_.quads.size());
    for (int q = 0; q < quad_count_; ++q) {
      std::array<int, 4> face;
      for (int k = 0; k < 4; ++k) {
        face[k] = at(quads_.quads[q][layer < level ? k : (4 - k) % 4], level);
      }
      faces.push_back({face, hex(q, layer)});
    }
    return faces;
  }

  void add_skins() {
    const int top = plan_.layers();
    mesh_.patches.push_back({has_inner_ ? "core" : "inner_wall", !has_inner_, faces_at(0, 0)});
    mesh_.patches.push_back({has_outer_ ? "outer_wall" : "wall", true, faces_at(top, top - 1)});
  }

  // The faces above the boundary edges of the quad mesh: one patch a loop and region.
  void add_ends() {
    const std::vector<QuadSide> sides = boundary_sides(quads_);
    if (has_inner_) add_rings(sides, "", 0, plan_.inner);
    if (has_outer_) add_rings(sides, has_inner_ ? "_wall" : "", plan_.inner, plan_.layers());
  }

  void add_rings(const std::vector<QuadSide>& sides, const std::string& suffix, int first,
                 int last) {
    std::vector<CellPatch> rings;
    for (const std::string& name : loop_names_) rings.push_back({name + suffix, false, {}});
    for (const QuadSide& side : sides) {
      const auto [a, b] = ends_of(quads_, side);
      for (int i = first; i < last; ++i) {
        rings[quads_.loop_of_vertex[a]].faces.push_back(
            {{at(a, i), at(b, i), at(b, i + 1), at(a, i + 1)}, hex(side.quad, i)});
      }
    }
    for (CellPatch& ring : rings) mesh_.patches.push_back(std::move(ring));
  }

  void add_interface() {
    mesh_.face_zones.push_back({"interface", false, faces_at(plan_.inner, plan_.inner - 1)});
  }

  const QuadMesh& quads_;
  const std::vector<std::string>& loop_names_;
  const WallShape& shape_;
  const LayerPlan& plan_;
  bool has_inner_, has_outer_;
  int vertex_count_, quad_count_;
  HexMesh mesh_;
};

}  // namespace

HexMesh extrude(const QuadMesh& quads, const std::vector<Vec3>& directions,
                const std::vector<std::string>& loop_names, const WallShape& shape) {
  return HexBuilder(quads, loop_names, shape).run(directions);
}

}  // namespace hexwall
