#pragma once

#include <array>
#include <string>
#include <vector>

#include <Eigen/Core>

/// An independent judge of quad and hex meshes. It takes plain arrays, shares no code with the
/// pipeline, and is slow and simple on purpose.
namespace hexwall::test {

using Points = std::vector<Eigen::Vector3d>;
using Quads = std::vector<std::array<int, 4>>;
using Hexes = std::vector<std::array<int, 8>>;

/// What is wrong with a mesh: the first few faults in words, and how many there are.
class Faults {
 public:
  void add(const std::string& fault);
  int count() const { return count_; }
  bool none() const { return count_ == 0; }
  /// Whether one of the faults in words has `words` in it.
  bool mention(const std::string& words) const;
  std::string text() const;

 private:
  int count_ = 0;
  std::vector<std::string> first_;
};

struct QuadVerdict {
  Faults faults;
  int edges = 0;
  int euler_number = 0;
  int components = 0;
  int boundary_loops = 0;
  std::vector<int> valence;       ///< #V edges at each vertex
  std::vector<char> on_boundary;  ///< #V
};

/// Checks that quads form an oriented manifold: indices in range, four distinct corners, every edge
/// in one or two quads and then in opposite directions, one fan of quads at every vertex, no vertex
/// without quads. Counts are right only if there are no faults.
QuadVerdict verify_quads(int vertex_count, const Quads& quads);

struct HexVerdict {
  Faults faults;
  double min_scaled_jacobian = 1.0;  ///< least over all corners of all hexes
  double hex_volume = 0.0;           ///< sum over the hexes: trilinear maps, integrated exactly
  double boundary_volume = 0.0;      ///< by the divergence theorem over the patches' bilinear faces
};

/// Checks that hexes (corner order of VTK_HEXAHEDRON) form a valid mesh: positive Jacobians at all
/// corners, every face in one or two hexes and then in opposite orientation, and a closed manifold
/// boundary whose faces are exactly those of `patches`, each once and facing out.
HexVerdict verify_hexes(const Points& points, const Hexes& hexes,
                        const std::vector<Quads>& patches);

}  // namespace hexwall::test
