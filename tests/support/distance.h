#pragma once

#include <memory>
#include <vector>

#include "surface/triangle_surface.h"

namespace hexwall::test {

/// Distances to a triangle surface by VTK's cell locator: nothing of the pipeline's own projection.
class SurfaceDistance {
 public:
  explicit SurfaceDistance(const TriangleSurface& surface);
  ~SurfaceDistance();
  SurfaceDistance(const SurfaceDistance&) = delete;
  SurfaceDistance& operator=(const SurfaceDistance&) = delete;

  struct Nearest {
    double distance;
    int triangle;
  };
  Nearest operator()(const Vec3& p) const;

 private:
  struct Locator;
  std::unique_ptr<Locator> locator_;
};

/// Distance of `p` from a closed polyline, by trying every segment.
double distance_to_polyline(const Vec3& p, const std::vector<Vec3>& polyline);

}  // namespace hexwall::test
