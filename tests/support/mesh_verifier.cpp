#include "support/mesh_verifier.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include <Eigen/Geometry>

namespace hexwall::test {
namespace {

using Eigen::Vector3d;

constexpr int faults_in_words = 10;

template <typename Indices>
std::string listed(const Indices& indices) {
  std::string text = "(";
  for (const int i : indices) text += std::to_string(i) + " ";
  text.back() = ')';
  return text;
}

template <typename Cells>
bool are_well_formed(std::size_t vertex_count, const Cells& cells, Faults& faults) {
  std::vector<char> used(vertex_count, 0);
  for (const auto& cell : cells) {
    for (const int v : cell) {
      if (v < 0 || static_cast<std::size_t>(v) >= vertex_count) {
        faults.add("vertex out of range in " + listed(cell));
        return false;
      }
      used[v] = 1;
    }
    const std::set<int> distinct(cell.begin(), cell.end());
    if (distinct.size() != cell.size()) faults.add("repeated vertex in " + listed(cell));
  }
  const auto unused = std::count(used.begin(), used.end(), 0);
  if (unused > 0) faults.add(std::to_string(unused) + " unused vertices");
  return true;
}

/// Disjoint sets of 0 … count - 1.
class Sets {
 public:
  explicit Sets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  int find(int i) const {
    while (parent_[i] != i) i = parent_[i];
    return i;
  }
  void join(int i, int j) {
    i = find(i);
    j = find(j);
    parent_[std::max(i, j)] = std::min(i, j);
  }
  int count() const {
    int roots = 0;
    for (std::size_t i = 0; i < parent_.size(); ++i) roots += parent_[i] == static_cast<int>(i);
    return roots;
  }

 private:
  std::vector<int> parent_;
};

using DirectedEdge = std::pair<int, int>;
using Corner = std::pair<int, int>;  // quad, and the corner at which an edge of it starts

/// The quads that run along each directed edge.
std::map<DirectedEdge, std::vector<Corner>> directed_edges(const Quads& quads) {
  std::map<DirectedEdge, std::vector<Corner>> edges;
  for (int q = 0; q < static_cast<int>(quads.size()); ++q) {
    for (int k = 0; k < 4; ++k) edges[{quads[q][k], quads[q][(k + 1) % 4]}].push_back({q, k});
  }
  return edges;
}

/// Joins the corners of the quads at each vertex across shared edges: one fan leaves one set.
void check_fans(const std::map<DirectedEdge, std::vector<Corner>>& edges, const Quads& quads,
                QuadVerdict& verdict) {
  Sets corners(4 * quads.size());
  for (const auto& [edge, uses] : edges) {
    const auto opposite = edges.find({edge.second, edge.first});
    if (opposite == edges.end()) continue;
    const auto [q, k] = uses.front();
    const auto [r, l] = opposite->second.front();
    corners.join(4 * q + k, 4 * r + (l + 1) % 4);
    corners.join(4 * q + (k + 1) % 4, 4 * r + l);
  }
  std::vector<int> fans(verdict.valence.size(), 0);
  for (int c = 0; c < static_cast<int>(4 * quads.size()); ++c) {
    if (corners.find(c) == c) ++fans[quads[c / 4][c % 4]];
  }
  for (std::size_t v = 0; v < fans.size(); ++v) {
    if (fans[v] > 1) verdict.faults.add("several fans of quads at vertex " + std::to_string(v));
  }
}

/// Counts edges, valences and boundary loops.
void count_edges(const std::map<DirectedEdge, std::vector<Corner>>& edges, QuadVerdict& verdict) {
  std::map<int, int> next;  // along the boundary
  for (const auto& [edge, uses] : edges) {
    const bool is_boundary = !edges.contains({edge.second, edge.first});
    if (!is_boundary && edge.first > edge.second) continue;
    ++verdict.edges;
    for (const int v : {edge.first, edge.second}) {
      ++verdict.valence[v];
      if (is_boundary) verdict.on_boundary[v] = 1;
    }
    if (is_boundary) next[edge.first] = edge.second;
  }
  while (!next.empty()) {
    ++verdict.boundary_loops;
    for (auto it = next.begin(); it != next.end();) {
      const int tip = it->second;
      next.erase(it);
      it = next.find(tip);
    }
  }
}

int count_components(std::size_t vertex_count, const Quads& quads) {
  Sets sets(vertex_count);
  for (const auto& quad : quads) {
    for (const int v : quad) sets.join(quad[0], v);
  }
  return sets.count();
}

/// The cycle that starts at the lowest vertex.
std::array<int, 4> rotated(std::array<int, 4> face) {
  std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
  return face;
}

std::array<int, 4> reversed(std::array<int, 4> face) {
  std::reverse(face.begin(), face.end());
  return face;
}

std::array<int, 4> sorted(std::array<int, 4> face) {
  std::sort(face.begin(), face.end());
  return face;
}

/// Faces of a hex with the corner order of VTK_HEXAHEDRON, counter-clockwise from outside.
std::array<std::array<int, 4>, 6> faces_of(const std::array<int, 8>& h) {
  return {{{h[0], h[3], h[2], h[1]},
           {h[4], h[5], h[6], h[7]},
           {h[0], h[1], h[5], h[4]},
           {h[1], h[2], h[6], h[5]},
           {h[2], h[3], h[7], h[6]},
           {h[3], h[0], h[4], h[7]}}};
}

/// Corner of the unit cube, in the order of VTK_HEXAHEDRON.
std::array<int, 3> cube_corner(int k) {
  const int bottom = k % 4;
  return {bottom == 1 || bottom == 2 ? 1 : 0, bottom >= 2 ? 1 : 0, k / 4};
}

/// Derivatives of the trilinear map of a hex at (u, v, w) in the unit cube, as columns.
Eigen::Matrix3d trilinear_derivatives(const std::array<Vector3d, 8>& p, const Vector3d& at) {
  Eigen::Matrix3d jacobian = Eigen::Matrix3d::Zero();
  for (int k = 0; k < 8; ++k) {
    const auto corner = cube_corner(k);
    for (int d = 0; d < 3; ++d) {
      double weight = corner[d] == 1 ? 1.0 : -1.0;
      for (int e = 0; e < 3; ++e) {
        if (e != d) weight *= corner[e] == 1 ? at[e] : 1.0 - at[e];
      }
      jacobian.col(d) += weight * p[k];
    }
  }
  return jacobian;
}

/// Two Gauss points integrate the cubic polynomials of (0, 1) exactly.
const std::array<double, 2> gauss{0.5 - 0.5 / std::sqrt(3.0), 0.5 + 0.5 / std::sqrt(3.0)};

double hex_volume(const std::array<Vector3d, 8>& p) {
  double sum = 0.0;
  for (const double u : gauss) {
    for (const double v : gauss) {
      for (const double w : gauss) {
        sum += trilinear_derivatives(p, {u, v, w}).determinant() / 8.0;
      }
    }
  }
  return sum;
}

/// A third of the flux of the position through a bilinear face.
double flux(const std::array<Vector3d, 4>& p) {
  double sum = 0.0;
  for (const double u : gauss) {
    for (const double v : gauss) {
      const Vector3d at =
          (1 - u) * (1 - v) * p[0] + u * (1 - v) * p[1] + u * v * p[2] + (1 - u) * v * p[3];
      const Vector3d du = (1 - v) * (p[1] - p[0]) + v * (p[2] - p[3]);
      const Vector3d dv = (1 - u) * (p[3] - p[0]) + u * (p[2] - p[1]);
      sum += at.dot(du.cross(dv)) / 12.0;
    }
  }
  return sum;
}

void check_jacobians(const Points& points, const Hexes& hexes, const Vector3d& origin,
                     HexVerdict& verdict) {
  for (std::size_t h = 0; h < hexes.size(); ++h) {
    std::array<Vector3d, 8> p;
    for (int k = 0; k < 8; ++k) p[k] = points[hexes[h][k]] - origin;
    double least = 1.0;
    bool is_positive = true;
    for (int k = 0; k < 8; ++k) {
      const auto corner = cube_corner(k);
      Eigen::Matrix3d edges = trilinear_derivatives(p, Vector3d(corner[0], corner[1], corner[2]));
      edges.colwise().normalize();
      least = std::min(least, edges.determinant());
      is_positive = is_positive && edges.determinant() > 0.0;  // false for a NaN
    }
    if (!is_positive) {
      verdict.faults.add("corner not positive in hex " + std::to_string(h) + " " +
                         listed(hexes[h]));
    }
    verdict.min_scaled_jacobian = std::min(verdict.min_scaled_jacobian, least);
    verdict.hex_volume += hex_volume(p);
  }
}

using FaceUses = std::map<std::array<int, 4>, std::vector<std::array<int, 4>>>;

/// Checks that hexes match face to face; gives the faces in one hex only.
std::map<std::array<int, 4>, int> check_faces(const Hexes& hexes, Faults& faults) {
  FaceUses uses;
  for (const auto& hex : hexes) {
    for (const auto& face : faces_of(hex)) uses[sorted(face)].push_back(rotated(face));
  }
  std::map<std::array<int, 4>, int> boundary;
  for (const auto& [key, faces] : uses) {
    if (faces.size() > 2) faults.add("more than two hexes share face " + listed(key));
    if (faces.size() == 1) boundary[faces.front()] = 0;
    if (faces.size() == 2 && faces[0] != rotated(reversed(faces[1]))) {
      faults.add("two hexes on the same side of face " + listed(key));
    }
  }
  return boundary;
}

void check_patches(std::map<std::array<int, 4>, int> boundary, const std::vector<Quads>& patches,
                   Faults& faults) {
  for (const Quads& patch : patches) {
    for (const auto& face : patch) {
      const auto found = boundary.find(rotated(face));
      if (found != boundary.end()) {
        ++found->second;
      } else if (boundary.contains(rotated(reversed(face)))) {
        faults.add("patch face looks inward " + listed(face));
      } else {
        faults.add("patch face is not on the boundary " + listed(face));
      }
    }
  }
  for (const auto& [face, times] : boundary) {
    if (times == 0) faults.add("boundary face without patch " + listed(face));
    if (times > 1) faults.add("boundary face in patches more than once " + listed(face));
  }
}

/// Every directed edge of the boundary must be met by one in the opposite direction.
void check_closed(const std::map<std::array<int, 4>, int>& boundary, Faults& faults) {
  Quads faces;
  faces.reserve(boundary.size());
  for (const auto& [face, times] : boundary) faces.push_back(face);
  const auto edges = directed_edges(faces);
  for (const auto& [edge, uses] : edges) {
    if (uses.size() == 1 && edges.contains({edge.second, edge.first})) continue;
    faults.add("boundary is not a closed manifold at edge " +
               listed(std::array{edge.first, edge.second}));
  }
}

}  // namespace

void Faults::add(const std::string& fault) {
  ++count_;
  if (count_ <= faults_in_words) first_.push_back(fault);
}

bool Faults::mention(const std::string& words) const {
  return text().find(words) != std::string::npos;
}

std::string Faults::text() const {
  std::string all = std::to_string(count_) + " faults";
  for (const std::string& fault : first_) all += "\n  " + fault;
  return all;
}

QuadVerdict verify_quads(int vertex_count, const Quads& quads) {
  QuadVerdict verdict;
  verdict.valence.assign(vertex_count, 0);
  verdict.on_boundary.assign(vertex_count, 0);
  if (!are_well_formed(verdict.valence.size(), quads, verdict.faults)) return verdict;
  const auto edges = directed_edges(quads);
  for (const auto& [edge, uses] : edges) {
    if (uses.size() > 1) {
      verdict.faults.add("several quads run the same way along edge " +
                         listed(std::array{edge.first, edge.second}));
    }
  }
  check_fans(edges, quads, verdict);
  count_edges(edges, verdict);
  verdict.components = count_components(verdict.valence.size(), quads);
  verdict.euler_number = vertex_count - verdict.edges + static_cast<int>(quads.size());
  return verdict;
}

HexVerdict verify_hexes(const Points& points, const Hexes& hexes,
                        const std::vector<Quads>& patches) {
  HexVerdict verdict;
  if (!are_well_formed(points.size(), hexes, verdict.faults)) return verdict;
  // Volumes are taken around the middle of the points: far from the origin digits would be lost.
  Vector3d origin = Vector3d::Zero();
  for (const Vector3d& p : points) origin += p / static_cast<double>(points.size());
  check_jacobians(points, hexes, origin, verdict);
  const auto boundary = check_faces(hexes, verdict.faults);
  check_closed(boundary, verdict.faults);
  check_patches(boundary, patches, verdict.faults);
  for (const Quads& patch : patches) {
    for (const auto& face : patch) {
      verdict.boundary_volume += flux({points[face[0]] - origin, points[face[1]] - origin,
                                       points[face[2]] - origin, points[face[3]] - origin});
    }
  }
  return verdict;
}

}  // namespace hexwall::test
