#pragma once

#include <array>
#include <cstdlib>
#include <filesystem>
#include <optional>

#include "core/errors.h"

namespace hexwall::test {

/// Folder of real vessel surfaces that are too large, or not free, to be part of the project: the
/// environment variable HEXWALL_SHARED_DATA, or else the compile definition of the same name.
/// Nothing where there is no such folder; tests then skip.
inline std::optional<std::filesystem::path> shared_data() {
  std::filesystem::path folder;
  if (const char* variable = std::getenv("HEXWALL_SHARED_DATA")) {
    folder = variable;
  } else {
#ifdef HEXWALL_SHARED_DATA
    folder = HEXWALL_SHARED_DATA;
#endif
  }
  std::error_code error;
  if (folder.empty() || !std::filesystem::is_directory(folder, error)) return std::nullopt;
  return folder;
}

/// What reading and checking a shared file gives.
struct SharedFile {
  const char* name;
  int vertices, triangles;
  ExitCode outcome;    ///< success, or the class of the refusal
  const char* reason;  ///< words of the message of the refusal
  int loops;           ///< if it succeeds
  int flipped;         ///< triangles with the wrong winding
};

inline constexpr std::array<SharedFile, 20> shared_files{{
    {"palabos_aneurysm_open.stl", 8004, 15925, ExitCode::success, "", 3, 0},
    {"vmtk4an_ideal_aneurysm.stl", 22365, 44443, ExitCode::success, "", 3, 0},
    {"vampy_ica_artery_C0015.vtp", 3862, 7485, ExitCode::success, "", 3, 0},
    {"vampy_case71_remeshed.vtp", 3725, 7383, ExitCode::success, "", 3, 0},
    {"vampy_artery_test_small.stl", 753, 1402, ExitCode::success, "", 3, 0},
    {"vampy_vein_test_small.stl", 330, 600, ExitCode::success, "", 2, 0},
    {"vampy_left_atrium.vtp", 10516, 20576, ExitCode::success, "", 5, 0},
    {"vampy_left_atrium_C35_flowext.vtp", 26610, 52924, ExitCode::success, "", 5, 0},
    {"vampy_left_atrium_moving.vtp", 4581, 9023, ExitCode::success, "", 5, 4504},
    {"vasp_artery_flowext.vtp", 6603, 13058, ExitCode::success, "", 3, 0},
    {"vasp_stenosis_tube.vtp", 960, 1892, ExitCode::success, "", 2, 1892},
    {"vasp_cylinder.vtp", 389, 730, ExitCode::success, "", 2, 0},
    {"vascularmd_cerebral_stenosis_quads.vtk", 30814, 61440, ExitCode::success, "", 4, 61440},
    {"vascularmd_ideal_quads.vtk", 9118, 18048, ExitCode::success, "", 4, 18048},
    {"openlb_bifurcation3d.vtp", 749, 1458, ExitCode::success, "", 3, 0},
    {"openlb_bifurcation3d_closed.stl", 793, 1582, ExitCode::topology, "closed", 0, 0},
    {"openlb_aorta3d_closed.stl", 1329, 2654, ExitCode::topology, "closed", 0, 0},
    {"carotid_jk_left.stl", 4615, 9071, ExitCode::topology, "6 edges", 0, 0},
    {"carotid_jk_left.vtp", 4607, 9053, ExitCode::success, "", 3, 0},
    {"matteo_AAA_phantom.stl", 2771, 5593, ExitCode::topology, "2 edges", 0, 0},
}};

}  // namespace hexwall::test
