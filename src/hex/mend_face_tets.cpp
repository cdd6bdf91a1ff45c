#include "hex/mend_face_tets.h"

#include <algorithm>

#include "core/parallel.h"
#include "hex/column_search.h"
#include "hex/thickness.h"

namespace hexwall {
namespace {

// Margin of face tets that is aimed at.
constexpr double wanted_margin = 0.02;
constexpr double first_step = 0.5;
constexpr int most_sweeps = 40;

/// Gives face tets to the columns that lack them.
class FaceTetMender {
 public:
  explicit FaceTetMender(ColumnSearch& search)
      : search_(search),
        margin_(search.quads().quads.size()),
        moved_(search.quads().points.size()) {
    parallel_for(margin_.size(), [&](std::size_t q) { find_margin(static_cast<int>(q)); });
  }

  int run() {
    double step = first_step;
    for (int sweep = 0; sweep < most_sweeps; ++sweep) {
      search_.turn_rings();
      bool lacking = false;
      bool improved = false;
      for (std::size_t q = 0; q < margin_.size(); ++q) {
        if (margin_[q] > 0.0) continue;
        lacking = true;
        for (const int v : search_.quads().quads[q]) improved = improve(v, step) || improved;
      }
      if (!lacking) break;
      if (!improved) step *= 0.5;
    }
    return static_cast<int>(std::count(moved_.begin(), moved_.end(), 1));
  }

 private:
  void find_margin(int q) { margin_[q] = face_tet_margin(search_.column(q), search_.levels()); }

  double cost_around(int v, double limit) const {
    double sum = 0.0;
    for (const int q : search_.columns_around(v)) {
      sum += std::max(0.0, wanted_margin - face_tet_margin(search_.column(q), search_.levels()));
      if (sum >= limit) break;
    }
    return sum;
  }

  double jacobian_around(int v) const {
    double least = wanted_scaled_jacobian;
    for (const int q : search_.columns_around(v)) {
      least = std::min(least, scaled_jacobian(search_.column(q), search_.levels()));
    }
    return least;
  }

  bool improve(int v, double step) {
    if (search_.quads().loop_of_vertex[v] >= 0) return false;
    const double jacobian = jacobian_around(v);
    const bool improved = search_.improve(
        v, step, [this](int w, double limit) { return cost_around(w, limit); },
        [&](int w) { return jacobian_around(w) >= jacobian; });
    if (!improved) return false;
    moved_[v] = 1;
    for (const int q : search_.columns_around(v)) find_margin(q);
    return true;
  }

  ColumnSearch& search_;
  std::vector<double> margin_;
  std::vector<char> moved_;
};

}  // namespace

int mend_face_tets(QuadMesh& quads, std::vector<SurfacePoint>& places,
                   std::vector<Vec3>& directions, const SurfaceProjector& projector,
                   const WallShape& shape) {
  ColumnSearch search(quads, places, directions, projector, shape);
  return FaceTetMender(search).run();
}

}  // namespace hexwall
