#include "foliation/labels.h"

#include <algorithm>
#include <cmath>

namespace hexwall {
namespace {

class Labeller {
 public:
  Labeller(const Connectivity& mesh, const HolomorphicForm& form, const Foliation& foliation,
           const std::vector<int>& across, const std::vector<int>& along,
           const std::vector<RowSpacing>& spacing)
      : mesh_(mesh),
        form_(form),
        foliation_(foliation),
        across_(across),
        along_(along),
        spacing_(spacing),
        visited_(mesh.face_count(), -1),
        corner_x_(mesh.face_count()) {
    labels_.cylinder.assign(mesh.face_count(), -1);
    labels_.patch.assign(mesh.face_count(), -1);
    labels_.x.resize(mesh.face_count());
    labels_.uv.resize(mesh.face_count());
  }

  SurfaceLabels run() {
    int first_patch = 0;
    for (std::size_t c = 0; c < foliation_.cylinders.size(); ++c) {
      flood(static_cast<int>(c), first_patch);
      first_patch += static_cast<int>(foliation_.strips.in_cylinder[c].size());
    }
    return std::move(labels_);
  }

 private:
  // Visits all triangles that reach into cylinder c, carrying x from corner to corner.
  void flood(int c, int first_patch) {
    const PathStep& start = foliation_.cylinders[c].path.front();
    std::vector<int> queue;
    enter(c, start.halfedge, start.x_tail, queue);
    for (std::size_t i = 0; i < queue.size(); ++i) {
      const int f = queue[i];
      label(c, first_patch, f);
      for (int k = 0; k < 3; ++k) {
        const int h = 3 * f + k;
        const int twin = mesh_.twin(h);
        if (twin < 0 || visited_[Connectivity::face(twin)] == c || !crosses(c, h)) continue;
        enter(c, twin, corner_x_[f][(k + 1) % 3], queue);
      }
    }
  }

  void enter(int c, int h, double x_tail, std::vector<int>& queue) {
    const int f = Connectivity::face(h);
    visited_[f] = c;
    queue.push_back(f);
    for (int k = h % 3, count = 0; count < 3; ++count, k = (k + 1) % 3) {
      corner_x_[f][k] = x_tail;
      x_tail += form_.dx.along(mesh_, 3 * f + k);
    }
  }

  // Whether a part of the edge lies strictly inside the cylinder.
  bool crosses(int c, int h) const {
    const Cylinder& cylinder = foliation_.cylinders[c];
    const auto& components = foliation_.graph.components;
    const auto [low, high] =
        std::minmax(foliation_.ranks[mesh_.tail(h)], foliation_.ranks[mesh_.tip(h)]);
    return low < components[cylinder.top].rank && high > components[cylinder.bottom].rank;
  }

  void label(int c, int first_patch, int f) {
    const Cylinder& cylinder = foliation_.cylinders[c];
    std::array<double, 3> y;
    for (int k = 0; k < 3; ++k) y[k] = form_.y[mesh_.triangles()[f][k]];
    const double middle = (y[0] + y[1] + y[2]) / 3.0;
    if (middle < cylinder.y_bottom || middle > cylinder.y_top) return;
    labels_.cylinder[f] = c;
    labels_.x[f] = corner_x_[f];
    const double height = std::max(cylinder.height(), 1e-300);
    const Place place = locate(c, (middle - cylinder.y_bottom) / height,
                               (corner_x_[f][0] + corner_x_[f][1] + corner_x_[f][2]) / 3.0);
    labels_.patch[f] = first_patch + place.strip;
    for (int k = 0; k < 3; ++k) {
      labels_.uv[f][2 * k] =
          place.u_start + (corner_x_[f][k] + place.shift - place.x_start) * place.u_per_x;
      labels_.uv[f][2 * k + 1] = v_of(c, y[k]);
    }
  }

  double v_of(int c, double y) const {
    const double wanted = std::max(spacing_[c].wanted(), 1e-300);
    return spacing_[c].rows_below(y) / wanted * along_[c];
  }

  struct Place {
    int strip = 0;  // index within the cylinder
    double shift = 0.0;
    double x_start = 0.0, u_start = 0.0, u_per_x = 0.0;
  };

  // The strip of cylinder c that holds x at a fraction of its height.
  Place locate(int c, double fraction, double x) const {
    const auto& lines = foliation_.strips.in_cylinder[c];
    const double period = foliation_.cylinders[c].circumference();
    const auto x_of = [&](std::size_t i) {
      const LineInCylinder& line = lines[i % lines.size()];
      return (1.0 - fraction) * line.x_bottom + fraction * line.x_top +
             (i >= lines.size() ? period : 0.0);
    };
    Place place;
    place.shift = -std::floor((x - x_of(0)) / period) * period;
    std::size_t strip = 0;
    while (strip + 1 < lines.size() && x_of(strip + 1) <= x + place.shift) {
      place.u_start += across_[lines[strip].strip];
      ++strip;
    }
    place.strip = static_cast<int>(strip);
    place.x_start = x_of(strip);
    const double width = std::max(x_of(strip + 1) - place.x_start, 1e-300);
    place.u_per_x = across_[lines[strip].strip] / width;
    return place;
  }

  const Connectivity& mesh_;
  const HolomorphicForm& form_;
  const Foliation& foliation_;
  const std::vector<int>& across_;
  const std::vector<int>& along_;
  const std::vector<RowSpacing>& spacing_;
  std::vector<int> visited_;
  std::vector<std::array<double, 3>> corner_x_;
  SurfaceLabels labels_;
};

}  // namespace

SurfaceLabels label_surface(const Connectivity& mesh, const HolomorphicForm& form,
                            const Foliation& foliation, const std::vector<int>& across,
                            const std::vector<int>& along, const std::vector<RowSpacing>& spacing) {
  return Labeller(mesh, form, foliation, across, along, spacing).run();
}

}  // namespace hexwall
