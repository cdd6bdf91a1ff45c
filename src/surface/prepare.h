#pragma once

#include <optional>
#include <string>
#include <vector>

#include "surface/names.h"
#include "surface/open_surface.h"
#include "surface/read.h"
#include "surface/repair.h"
#include "surface/triangle_surface.h"

namespace hexwall {

struct PrepareOptions {
  RepairOptions repair;
  OpenOptions open;
  double extend = 0.0;            ///< length of flow extensions in radii of their opening; 0: none
  std::vector<NamedPlace> names;  ///< names of openings
  double metres_per_unit = 1e-3;  ///< unit of the coordinates, for `unit_warning`
};

/// A surface as it comes, made ready to be meshed, and all that was done to it.
struct PrepareResult {
  TriangleSurface surface;           ///< passes `check_surface`
  std::vector<NamedPlace> openings;  ///< name and centre of every opening, the longest loop first
  std::vector<RepairAction> repairs;
  double moved = 0.0;             ///< by repairs: greatest distance between shapes, pinholes aside
  std::vector<OpenedCap> opened;  ///< caps taken off and ends cut off
  std::vector<int> extension;     ///< #F opening whose flow extension it belongs to, -1: the vessel
  std::vector<std::string> notes;     ///< one sentence for each thing done
  std::vector<std::string> warnings;  ///< what to look at before using a mesh of this surface
};

/// Repairs the topology, opens closed ends, repairs the geometry, checks, extends the openings and
/// names them: see `repair_topology`, `open_surface`, `repair_geometry`, `check_surface`,
/// `extend_openings`, `assign_names`. A clean, open surface comes out as it is.
/// \throws what these throw: ReadError, UsageError, TopologyError, GeometryError.
PrepareResult prepare_surface(const ReadResult& input, const PrepareOptions& options = {});

/// The first steps alone, up to and without the check: the surface may be anything.
PrepareResult repair_and_open(const ReadResult& input, const PrepareOptions& options,
                              bool& is_free_of_intersections);

/// The last steps alone, from the check on: neither repaired nor opened.
PrepareResult use_as_it_is(const TriangleSurface& surface, const PrepareOptions& options = {});

}  // namespace hexwall
