#pragma once

#include <filesystem>
#include <string>

#include "inspect/any_mesh.h"

namespace hexwall {

/// Reads a mesh in the format that the file's extension names: .vtu, .vtp, .vtk, .msh (Gmsh 2.2 and
/// 4.1, text), .inp (Abaqus, CalculiX), .stl, .obj, .ply, .off; or an OpenFOAM mesh (text) from a
/// folder: `polyMesh`, the `constant` that holds it, or the case.
/// \throws ReadError, naming the file and, in text formats, the line.
AnyMesh read_mesh(const std::filesystem::path& path);

// What the readers do with the bytes of a file.
AnyMesh parse_vtu(const std::string& content);
AnyMesh parse_vtk_grid(const std::string& content);
AnyMesh parse_gmsh(const std::string& content);
AnyMesh parse_abaqus(const std::string& content);

/// The contents of the files of a polyMesh folder.
struct FoamFiles {
  std::string points, faces, owner, neighbour;
};

AnyMesh parse_foam(const FoamFiles& files);

/// \param folder the polyMesh folder with the files points, faces, owner and neighbour.
AnyMesh read_foam(const std::filesystem::path& folder);

}  // namespace hexwall
