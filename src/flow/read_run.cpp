#include "flow/read_run.h"

#include <algorithm>
#include <fstream>
#include <sstream>

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <vtkCellData.h>
#include <vtkCompositeDataSet.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkIdList.h>
#include <vtkInformation.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkOpenFOAMReader.h>
#include <vtkPolyData.h>

#include "core/errors.h"
#include "surface/vtk_messages.h"

namespace hexwall {
namespace {

namespace fs = std::filesystem;

/// Names of the patches of type `wall` in a polyMesh/boundary file, which is always text.
std::vector<std::string> wall_names(const fs::path& case_dir) {
  const fs::path path = case_dir / "constant/polyMesh/boundary";
  std::ifstream file(path);
  if (!file) {
    throw ReadError(
        fmt::format("'{}' is no OpenFOAM case: there is no {}", case_dir.string(), path.string()));
  }
  std::stringstream spaced;
  for (char c; file.get(c);) {
    if (c == '{' || c == '}' || c == ';' || c == '(' || c == ')') {
      spaced << ' ' << c << ' ';
    } else {
      spaced << c;
    }
  }
  std::vector<std::string> names;
  std::string before;
  std::string patch;
  for (std::string word; spaced >> word; before = word) {
    if (word == "{") patch = before;
    if (before == "type" && word == "wall") names.push_back(patch);
  }
  if (names.empty()) throw ReadError(fmt::format("{} has no patch of type wall", path.string()));
  return names;
}

bool has_parts(const fs::path& case_dir) {
  return fs::is_directory(case_dir / "processor0");
}

/// The last time directory, as a number; 0 before a run.
double last_time(vtkOpenFOAMReader& reader) {
  const vtkDoubleArray* times = reader.GetTimeValues();
  double last = 0.0;
  for (vtkIdType i = 0; times != nullptr && i < times->GetNumberOfTuples(); ++i)
    last = std::max(last, times->GetValue(i));
  return last;
}

void choose(vtkOpenFOAMReader& reader, const std::vector<std::string>& walls) {
  reader.DisableAllPatchArrays();
  for (const std::string& wall : walls) {
    // Patches are found by name, in some versions with the group's name before it.
    for (int i = 0; i < reader.GetNumberOfPatchArrays(); ++i) {
      const std::string array = reader.GetPatchArrayName(i);
      const bool is_it = array == wall || array.ends_with("/" + wall);
      if (is_it) reader.SetPatchArrayStatus(array.c_str(), 1);
    }
  }
  reader.EnableAllCellArrays();
  reader.CreateCellToPointOff();
}

vtkPolyData* patch_in(vtkMultiBlockDataSet* blocks, const std::string& name) {
  for (unsigned i = 0; blocks != nullptr && i < blocks->GetNumberOfBlocks(); ++i) {
    vtkDataObject* block = blocks->GetBlock(i);
    if (auto* inner = vtkMultiBlockDataSet::SafeDownCast(block)) {
      if (vtkPolyData* found = patch_in(inner, name)) return found;
    }
    const char* block_name =
        blocks->HasMetaData(i) ? blocks->GetMetaData(i)->Get(vtkCompositeDataSet::NAME()) : nullptr;
    if (block_name != nullptr && block_name == name) return vtkPolyData::SafeDownCast(block);
  }
  return nullptr;
}

void add_geometry(vtkPolyData& data, RunWall& wall) {
  for (vtkIdType i = 0; i < data.GetNumberOfPoints(); ++i)
    wall.points.emplace_back(data.GetPoint(i));
  vtkNew<vtkIdList> corners;
  for (vtkIdType i = 0; i < data.GetNumberOfCells(); ++i) {
    data.GetCellPoints(i, corners);
    std::vector<int>& face = wall.faces.emplace_back();
    for (vtkIdType k = 0; k < corners->GetNumberOfIds(); ++k)
      face.push_back(static_cast<int>(corners->GetId(k)));
    Vec3 area = Vec3::Zero();
    for (std::size_t k = 1; k + 1 < face.size(); ++k) {
      const Vec3& first = wall.points[face[0]];
      area += 0.5 * (wall.points[face[k]] - first).cross(wall.points[face[k + 1]] - first);
    }
    wall.areas.push_back(area.norm());
  }
}

vtkDataArray* array_of(vtkPolyData& data, const char* name, int components) {
  vtkDataArray* array = data.GetCellData()->GetArray(name);
  const bool fits = array != nullptr && array->GetNumberOfComponents() == components &&
                    array->GetNumberOfTuples() == data.GetNumberOfCells();
  return fits ? array : nullptr;
}

std::vector<Vec3> vectors_of(vtkPolyData& data, const char* name) {
  std::vector<Vec3> values;
  vtkDataArray* array = array_of(data, name, 3);
  for (vtkIdType i = 0; array != nullptr && i < array->GetNumberOfTuples(); ++i)
    values.emplace_back(array->GetTuple3(i));
  return values;
}

std::vector<double> numbers_of(vtkPolyData& data, const char* name) {
  std::vector<double> values;
  vtkDataArray* array = array_of(data, name, 1);
  for (vtkIdType i = 0; array != nullptr && i < array->GetNumberOfTuples(); ++i)
    values.push_back(array->GetTuple1(i));
  return values;
}

RunWall wall_of(vtkPolyData& data, const std::string& name) {
  RunWall wall;
  wall.name = name;
  add_geometry(data, wall);
  wall.shear = vectors_of(data, "wallShearStress");
  wall.mean_shear = vectors_of(data, "wallShearStressMean");
  wall.mean_magnitude = numbers_of(data, "wallShearStressMagnitudeMean");
  return wall;
}

[[noreturn]] void no_results(const fs::path& case_dir) {
  const char* what = has_parts(case_dir) ? "its results are still in the parts of its processes: "
                                           "run reconstructPar in it"
                                         : "there are no results: run its Allrun";
  throw ReadError(fmt::format("'{}': {}", case_dir.string(), what));
}

}  // namespace

RunWalls read_run(const fs::path& case_dir) {
  const std::vector<std::string> names = wall_names(case_dir);
  const VtkMessages messages;
  vtkNew<vtkOpenFOAMReader> reader;
  reader->SetFileName((case_dir / "system/controlDict").c_str());
  reader->UpdateInformation();
  RunWalls run;
  run.time = last_time(*reader);
  if (run.time <= 0.0) no_results(case_dir);
  choose(*reader, names);
  reader->UpdateTimeStep(run.time);
  if (!messages.error().empty())
    throw ReadError(fmt::format("'{}': {}", case_dir.string(), messages.error()));
  for (const std::string& name : names) {
    vtkPolyData* data = patch_in(reader->GetOutput(), name);
    if (data == nullptr)
      throw ReadError(fmt::format("'{}': the patch '{}' cannot be read", case_dir.string(), name));
    run.walls.push_back(wall_of(*data, name));
    if (run.walls.back().shear.size() == run.walls.back().faces.size()) continue;
    throw ReadError(
        fmt::format("'{}': there is no wallShearStress on '{}' at time {:.10g}: let the run write "
                    "it, or run 'simpleFoam -postProcess -func wallShearStress -latestTime'",
                    case_dir.string(), name, run.time));
  }
  return run;
}

}  // namespace hexwall
