#include "exporters/openfoam_case.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "core/errors.h"
#include "exporters/foam_file.h"
#include "exporters/openfoam.h"
#include "exporters/openfoam_fields.h"
#include "exporters/output_file.h"

namespace hexwall {
namespace {

namespace fs = std::filesystem;

constexpr int written_per_cycle = 20;

std::string solver_of(const FlowSetup& setup) {
  return setup.pulse ? "pimpleFoam" : "simpleFoam";
}

OutputFile transport_properties(const Blood& blood) {
  const double nu = blood.kinematic_viscosity();
  std::string body = fmt::format("rho             [1 -3 0 0 0 0 0] {};\n", blood.density);
  if (blood.model == FluidModel::newtonian) {
    body += fmt::format("transportModel  Newtonian;\nnu              [0 2 -1 0 0 0 0] {};\n", nu);
  } else {
    body += fmt::format(R"(transportModel  BirdCarreau;
BirdCarreauCoeffs
{{
    nu0         [0 2 -1 0 0 0 0] {};
    nuInf       [0 2 -1 0 0 0 0] {};
    k           [0 0 1 0 0 0 0] {};
    n           [0 0 0 0 0 0 0] {};
}}
)",
                        blood.viscosity_at_rest / blood.density, nu, blood.relaxation_time,
                        blood.power);
  }
  return foam_dictionary("constant", "transportProperties", body);
}

/// What cells of one shape want: gradients of the velocity and of the pressure, and what else is
/// interpolated to faces than linearly. All gradients are exact for linear fields on every shape.
struct Schemes {
  std::string_view velocity_gradient, pressure_gradient, interpolation;
};

/// With hexahedra at the walls, the pressure's gradient leaves out cells that share but a point:
/// pressure drops come out 1 % too small with them. On tetrahedra alone leaving them out makes wall
/// shear stress worse, by up to 7 %; but that of the velocity leaves them out, and the flux through
/// faces, which lie beside the line between the centres there, is fitted: both halve the error, and
/// make the pressure drop converge (cases/poiseuille).
Schemes schemes_for(const CellMesh& mesh) {
  const bool is_tetrahedral =
      std::all_of(mesh.shape.begin(), mesh.shape.end(),
                  [](CellShape shape) { return shape == CellShape::tetrahedron; });
  if (!is_tetrahedral) return {"pointCellsLeastSquares", "edgeCellsLeastSquares", ""};
  return {"edgeCellsLeastSquares", "pointCellsLeastSquares", " flux(HbyA) linearFit 1;"};
}

/// Second order.
OutputFile schemes(const CellMesh& mesh, const FlowSetup& setup) {
  const Schemes of_cells = schemes_for(mesh);
  return foam_dictionary("system", "fvSchemes",
                         fmt::format(R"(ddtSchemes           {{ default {}; }}
gradSchemes
{{
    default     {};
    grad(p)     {};
}}
divSchemes
{{
    default     none;
    div(phi,U)  {}Gauss linearUpwind grad(U);
    div((nuEff*dev2(T(grad(U))))) Gauss linear;
}}
laplacianSchemes     {{ default Gauss linear corrected; }}
interpolationSchemes {{ default linear;{} }}
snGradSchemes        {{ default corrected; }}
)",
                                     setup.pulse ? "backward" : "steadyState",
                                     of_cells.velocity_gradient, of_cells.pressure_gradient,
                                     setup.pulse ? "" : "bounded ", of_cells.interpolation));
}

constexpr std::string_view steady_solution = R"(solvers
{
    p
    {
        solver          GAMG;
        smoother        GaussSeidel;
        tolerance       1e-12;
        relTol          0.02;
    }
    U
    {
        solver          smoothSolver;
        smoother        symGaussSeidel;
        tolerance       1e-12;
        relTol          0.05;
    }
}
SIMPLE
{
    consistent                yes;
    nNonOrthogonalCorrectors  0;
    residualControl
    {
        p  1e-6;
        U  1e-7;
    }
}
relaxationFactors
{
    equations { U 0.9; }
}
)";

constexpr std::string_view pulsatile_solution = R"(solvers
{
    p
    {
        solver          GAMG;
        smoother        GaussSeidel;
        tolerance       1e-9;
        relTol          0.02;
    }
    pFinal
    {
        $p;
        relTol          0.001;
    }
    U
    {
        solver          smoothSolver;
        smoother        symGaussSeidel;
        tolerance       1e-9;
        relTol          0.02;
    }
    UFinal
    {
        $U;
        relTol          0.001;
    }
}
PIMPLE
{
    nOuterCorrectors          2;
    nCorrectors               2;
    nNonOrthogonalCorrectors  1;
}
relaxationFactors
{
    equations { ".*" 1; }
}
)";

std::string wall_names(const CellMesh& mesh) {
  std::string names;
  for (const CellPatch& patch : mesh.patches)
    if (patch.is_wall) names += (names.empty() ? "" : " ") + patch.name;
  return names;
}

/// A value on an opening at every step, in postProcessing/.
std::string opening_value(const std::string& prefix, const std::string& patch,
                          std::string_view operation, std::string_view field) {
  return fmt::format(R"(    {}_{}
    {{
        type            surfaceFieldValue;
        libs            (fieldFunctionObjects);
        regionType      patch;
        name            {};
        operation       {};
        fields          ({});
        writeFields     false;
        log             false;
    }}
)",
                     prefix, patch, patch, operation, field);
}

/// Means over the last cycle, from which `hexwall shear` has TAWSS, OSI and RRT.
std::string averages(const Pulse& pulse) {
  return fmt::format(R"(    wallShearStressMagnitude
    {{
        type            mag;
        libs            (fieldFunctionObjects);
        field           wallShearStress;
        result          wallShearStressMagnitude;
        writeControl    writeTime;
    }}
    average
    {{
        type            fieldAverage;
        libs            (fieldFunctionObjects);
        timeStart       {:.10g};
        writeControl    writeTime;
        fields
        (
            wallShearStress          {{ mean on; prime2Mean off; base time; }}
            wallShearStressMagnitude {{ mean on; prime2Mean off; base time; }}
            U                        {{ mean on; prime2Mean off; base time; }}
            p                        {{ mean on; prime2Mean off; base time; }}
        );
    }}
)",
                     (pulse.cycles - 1) * pulse.period);
}

std::string functions(const CellMesh& mesh, const FlowSetup& setup) {
  const std::string walls = wall_names(mesh);
  std::string text = fmt::format(R"(functions
{{
    wallShearStress
    {{
        type            wallShearStress;
        libs            (fieldFunctionObjects);
        patches         ({});
        executeControl  {};
        writeControl    writeTime;
        log             false;
    }}
)",
                                 walls, setup.pulse ? "timeStep" : "writeTime");
  if (setup.pulse) text += averages(*setup.pulse);
  text += fmt::format(R"(    forces
    {{
        type            forces;
        libs            (forces);
        patches         ({});
        rho             rhoInf;
        rhoInf          {};
        CofR            (0 0 0);
        log             false;
    }}
    residuals
    {{
        type            solverInfo;
        libs            (utilityFunctionObjects);
        fields          (p U);
    }}
)",
                      walls, setup.blood.density);
  std::vector<std::string> openings{setup.inlet};
  for (const FlowOutlet& outlet : setup.outlets) openings.push_back(outlet.patch);
  for (const std::string& patch : openings) {
    text += opening_value("flowRate", patch, "sum", "phi");
    text += opening_value("pressure", patch, "areaAverage", "p");
  }
  return text + "}\n";
}

std::string times(const FlowSetup& setup) {
  if (!setup.pulse) {
    return R"(startTime       0;
stopAt          endTime;
endTime         3000;
deltaT          1;
writeControl    timeStep;
writeInterval   500;
purgeWrite      1;
)";
  }
  const Pulse& pulse = *setup.pulse;
  return fmt::format(R"(startTime       0;
stopAt          endTime;
endTime         {:.10g};
deltaT          {:.10g};
adjustTimeStep  yes;
maxCo           2;
maxDeltaT       {:.10g};
writeControl    adjustableRunTime;
writeInterval   {:.10g};
purgeWrite      {};
)",
                     pulse.cycles * pulse.period, pulse.period / 2000.0, pulse.period / 200.0,
                     pulse.period / written_per_cycle, written_per_cycle + 1);
}

OutputFile control(const CellMesh& mesh, const FlowSetup& setup) {
  return foam_dictionary("system", "controlDict",
                         fmt::format(R"(application     {};
startFrom       latestTime;
{}writeFormat     ascii;
writePrecision  10;
timeFormat      general;
timePrecision   10;
runTimeModifiable no;
{})",
                                     solver_of(setup), times(setup), functions(mesh, setup)));
}

/// Numbers of slices along x, y, z: the greatest prime factor of `processes` goes to the longest
/// side of what is left of the bounding box, and so on.
std::array<int, 3> slices(const CellMesh& mesh, int processes) {
  Eigen::AlignedBox3d box;
  for (const Vec3& p : mesh.points) box.extend(p);
  std::array<double, 3> side{box.sizes().x(), box.sizes().y(), box.sizes().z()};
  std::array<int, 3> numbers{1, 1, 1};
  std::vector<int> factors;
  for (int factor = 2; processes > 1; ++factor)
    for (; processes % factor == 0; processes /= factor) factors.push_back(factor);
  std::reverse(factors.begin(), factors.end());
  for (const int factor : factors) {
    const auto longest = std::max_element(side.begin(), side.end()) - side.begin();
    numbers[longest] *= factor;
    side[longest] /= factor;
  }
  return numbers;
}

/// `hierarchical`, because Debian's OpenFOAM comes without Scotch.
OutputFile decomposition(const CellMesh& mesh, int processes) {
  const auto [x, y, z] = slices(mesh, processes);
  return foam_dictionary("system", "decomposeParDict",
                         fmt::format(R"(numberOfSubdomains {};
method          hierarchical;
hierarchicalCoeffs
{{
    n           ({} {} {});
    delta       0.001;
    order       xyz;
}}
)",
                                     processes, x, y, z));
}

constexpr std::string_view script_head = R"(#!/bin/sh
# Debian's OpenFOAM looks for its dictionaries in $WM_PROJECT_DIR/etc.
cd "${0%/*}" || exit 1
if [ -z "$WM_PROJECT_DIR" ] && [ -d /usr/share/openfoam/etc ]; then
  export WM_PROJECT_DIR=/usr/share/openfoam
fi

# Runs a program with its output in log.NAME, and ends if it fails.
run() {
  name=$1
  shift
  echo "$name, see $PWD/log.$name"
  if ! "$@" > "log.$name" 2>&1; then
    tail -n 20 "log.$name" >&2
    echo "$name failed" >&2
    exit 1
  fi
}

)";

std::string run_script(const std::string& solver, int processes) {
  std::string script(script_head);
  if (processes == 1) return script + fmt::format("run {0} {0}\n", solver);
  return script +
         fmt::format(
             R"sh(# Open MPI refuses to run as root, as in containers, unless told otherwise.
if [ "$(id -u)" = 0 ]; then
  export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
fi
#Debian's OpenFOAM runs in one process unless its MPI library is found first.
for folder in /usr/lib/openmpi-system /usr/lib/*/openmpi-system; do
  if [ -f "$folder/libPstream.so" ]; then
    export LD_LIBRARY_PATH="$folder${{LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}}"
  fi
done

# MPIRUN_OPTIONS: for instance --oversubscribe, for more processes than cores.
run decomposePar decomposePar -force
# shellcheck disable=SC2086
run {0} mpirun $MPIRUN_OPTIONS -np {1} {0} -parallel
run reconstructPar reconstructPar
)sh",
             solver, processes);
}

constexpr std::string_view clean_script = R"(#!/bin/sh
# Takes away what Allrun has made: the mesh and the boundary values stay.
cd "${0%/*}" || exit 1
rm -rf log.* postProcessing processor[0-9]* constant/polyMesh/sets
for time in [0-9]*; do
  [ "$time" = 0 ] || rm -rf "$time"
done
)";

std::vector<OutputFile> case_files(const CellMesh& mesh, const FlowSetup& setup,
                                   const OpenFoamCase& options) {
  std::vector<OutputFile> files = openfoam_fields(mesh, setup);
  files.push_back(transport_properties(setup.blood));
  files.push_back(
      foam_dictionary("constant", "turbulenceProperties", "simulationType  laminar;\n"));
  files.push_back(control(mesh, setup));
  files.push_back(schemes(mesh, setup));
  files.push_back(
      foam_dictionary("system", "fvSolution", setup.pulse ? pulsatile_solution : steady_solution));
  if (options.processes > 1) files.push_back(decomposition(mesh, options.processes));
  files.push_back({"Allrun", run_script(solver_of(setup), options.processes)});
  files.push_back({"Allclean", std::string(clean_script)});
  files.push_back({"case.foam", ""});
  return files;
}

void make_executable(const fs::path& path) {
  std::error_code error;
  fs::permissions(path, fs::perms::owner_exec | fs::perms::group_exec | fs::perms::others_exec,
                  fs::perm_options::add, error);
  if (error) throw WriteError("cannot make " + path.string() + " executable: " + error.message());
}

}  // namespace

void write_openfoam_case(const fs::path& case_dir, const CellMesh& mesh, const FlowSetup& setup,
                         const OpenFoamCase& options) {
  const std::vector<OutputFile> files = case_files(mesh, setup, options);
  // The mesh comes with a system/ for checkMesh alone, which the case's own replaces.
  write_openfoam(case_dir, mesh, options.metres_per_unit);
  write_output_files(case_dir, files);
  for (const char* script : {"Allrun", "Allclean"}) make_executable(case_dir / script);
}

}  // namespace hexwall
