#include "surface/editable_mesh.h"

#include <numeric>

namespace hexwall {

EditableMesh::EditableMesh(const TriangleSurface& surface, const Connectivity& mesh)
    : surface_(surface), parent_(surface.triangles.size()) {
  twin_.resize(mesh.halfedge_count());
  for (int h = 0; h < mesh.halfedge_count(); ++h) twin_[h] = mesh.twin(h);
  std::iota(parent_.begin(), parent_.end(), 0);
}

void EditableMesh::link(int g, int h) {
  twin_[g] = h;
  if (h >= 0) twin_[h] = g;
}

// Splits h = (a, b): its face (a, b, c) becomes (a, p, c) and the new (p, b, c).
int EditableMesh::split_one_side(int h, int p) {
  const int f = h / 3;
  const int b = tip(h);
  const int c = apex(h);
  const int outer = twin_[next(h)];
  const int g = static_cast<int>(surface_.triangles.size());
  surface_.triangles.push_back({p, b, c});
  parent_.push_back(parent_[f]);
  twin_.resize(twin_.size() + 3, -1);
  surface_.triangles[f][(h + 1) % 3] = p;
  link(3 * g + 1, outer);
  link(3 * g + 2, next(h));
  return 3 * g;
}

int EditableMesh::split(int h, double t) {
  const int opposite = twin_[h];
  const int p = static_cast<int>(surface_.points.size());
  surface_.points.push_back((1.0 - t) * point(tail(h)) + t * point(tip(h)));
  const int second = split_one_side(h, p);        // p -> b
  const int other = split_one_side(opposite, p);  // p -> a
  link(h, other);
  link(opposite, second);
  split_faces_ = {h / 3, second / 3, opposite / 3, other / 3};
  return p;
}

// (a, b, c) becomes (a, b, p); (b, c, p) and (c, a, p) are new.
int EditableMesh::insert(int f, const Vec3& position) {
  const auto [a, b, c] = surface_.triangles[f];
  const int p = static_cast<int>(surface_.points.size());
  const int g = static_cast<int>(surface_.triangles.size());
  const int bc = twin_[3 * f + 1];
  const int ca = twin_[3 * f + 2];
  surface_.points.push_back(position);
  surface_.triangles[f] = {a, b, p};
  surface_.triangles.push_back({b, c, p});
  surface_.triangles.push_back({c, a, p});
  parent_.insert(parent_.end(), 2, parent_[f]);
  twin_.resize(twin_.size() + 6, -1);
  link(3 * g, bc);
  link(3 * (g + 1), ca);
  link(3 * f + 1, 3 * g + 2);
  link(3 * g + 1, 3 * (g + 1) + 2);
  link(3 * (g + 1) + 1, 3 * f + 2);
  return p;
}

// The two faces (a, b, c), (b, a, d) become (d, c, a), (c, d, b).
void EditableMesh::flip(int h) {
  const int g = twin_[h];
  const int f1 = h / 3;
  const int f2 = g / 3;
  const int a = tail(h);
  const int b = tail(g);
  const int c = apex(h);
  const int d = apex(g);
  const int bc = twin_[next(h)];
  const int ca = twin_[prev(h)];
  const int ad = twin_[next(g)];
  const int db = twin_[prev(g)];
  surface_.triangles[f1] = {d, c, a};
  surface_.triangles[f2] = {c, d, b};
  link(3 * f1, 3 * f2);
  link(3 * f1 + 1, ca);
  link(3 * f1 + 2, ad);
  link(3 * f2 + 1, db);
  link(3 * f2 + 2, bc);
}

void EditableMesh::detach(int h) {
  if (twin_[h] < 0) return;
  twin_[twin_[h]] = -1;
  twin_[h] = -1;
}

}  // namespace hexwall
