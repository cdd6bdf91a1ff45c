#include "exporters/formats.h"

#include "exporters/abaqus.h"
#include "exporters/gmsh.h"
#include "exporters/openfoam.h"
#include "exporters/results.h"
#include "exporters/svmultiphysics.h"

namespace hexwall {

using Path = std::filesystem::path;

const std::vector<Format>& hex_mesh_formats() {
  static const std::vector<Format> formats{
      {"vtu", "wall.vtu",
       [](const Path& path, const PipelineResult& r, double) { write_wall(path, r); }},
      {"openfoam", "openfoam",
       [](const Path& path, const PipelineResult& r, double metres_per_unit) {
         write_openfoam(path, r.wall, metres_per_unit);
       }},
      {"abaqus", "wall.inp",
       [](const Path& path, const PipelineResult& r, double) { write_abaqus(path, r.wall); }},
      {"gmsh", "wall.msh",
       [](const Path& path, const PipelineResult& r, double) { write_gmsh(path, r.wall); }},
      {"svmultiphysics", "mesh-complete",
       [](const Path& path, const PipelineResult& r, double) {
         write_svmultiphysics(path, r.wall);
       }},
  };
  return formats;
}

}  // namespace hexwall
