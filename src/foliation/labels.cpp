#include "foliation/labels.h"

#include <algorithm>
#include <cmath>

#include "foliation/cylinder_faces.h"

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
        visited_(mesh.face_count(), -1) {
    labels_.cylinder.assign(mesh.face_count(), -1);
    labels_.patch.assign(mesh.face_count(), -1);
    labels_.x.resize(mesh.face_count());
    labels_.uv.resize(mesh.face_count());
  }

  SurfaceLabels run() {
    int first_patch = 0;
    for (std::size_t c = 0; c < foliation_.cylinders.size(); ++c) {
      const int cylinder = static_cast<int>(c);
      visit_cylinder(
          mesh_, form_, foliation_, cylinder, visited_,
          [&](int f, const std::array<double, 3>& x) { label(cylinder, first_patch, f, x); });
      first_patch += static_cast<int>(foliation_.strips.in_cylinder[c].size());
    }
    return std::move(labels_);
  }

 private:
  void label(int c, int first_patch, int f, const std::array<double, 3>& corner_x) {
    const Cylinder& cylinder = foliation_.cylinders[c];
    std::array<double, 3> y;
    for (int k = 0; k < 3; ++k) y[k] = form_.y[mesh_.triangles()[f][k]];
    const double middle = (y[0] + y[1] + y[2]) / 3.0;
    if (middle < cylinder.y_bottom || middle > cylinder.y_top) return;
    labels_.cylinder[f] = c;
    labels_.x[f] = corner_x;
    const double height = std::max(cylinder.height(), 1e-300);
    const Place place = locate(c, (middle - cylinder.y_bottom) / height,
                               (corner_x[0] + corner_x[1] + corner_x[2]) / 3.0);
    labels_.patch[f] = first_patch + place.strip;
    for (int k = 0; k < 3; ++k) {
      labels_.uv[f][2 * k] =
          place.u_start + (corner_x[k] + place.shift - place.x_start) * place.u_per_x;
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
  SurfaceLabels labels_;
};

}  // namespace

SurfaceLabels label_surface(const Connectivity& mesh, const HolomorphicForm& form,
                            const Foliation& foliation, const std::vector<int>& across,
                            const std::vector<int>& along, const std::vector<RowSpacing>& spacing) {
  return Labeller(mesh, form, foliation, across, along, spacing).run();
}

}  // namespace hexwall
