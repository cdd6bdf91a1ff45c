#!/usr/bin/env bash
# A thick-walled cylinder under inner pressure, solved by CalculiX and by OpenFOAM on three meshes of
# hexwall, against Lamé's solution.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
export WM_PROJECT_DIR=${WM_PROJECT_DIR:-/usr/share/openfoam}

out=${1:-build/cases/lame_cylinder}
iterations=600

# The end rings slide in their planes (plane strain) and only radially (no rigid motion).
solve_with_calculix() {
  local folder=$1 layers=$2 k
  {
    echo '*INCLUDE, INPUT=wall.inp'
    printf '*MATERIAL, NAME=wall\n*ELASTIC\n1000, 0.3\n'
    for ((k = 1; k <= layers; k++)); do
      echo "*SOLID SECTION, ELSET=layer_$k, MATERIAL=wall"
    done
    printf '*TRANSFORM, NSET=loop_%d, TYPE=C\n0, 0, 0, 0, 0, 1\n' 0 1
    printf '*STEP\n*STATIC\n*BOUNDARY\nloop_0, 2, 3\nloop_1, 2, 3\n*DSLOAD\ninner_wall, P, 1\n'
    printf '*NODE PRINT, NSET=%s_wall, GLOBAL=YES\nU\n' inner outer
    for ((k = 1; k <= layers; k++)); do
      printf "*EL PRINT, ELSET=layer_$k\n%s\n" COORD S
    done
    echo '*END STEP'
  } > "$folder/lame.inp"
  (cd "$folder" && ccx -i lame > ccx.log)
}

foam_file() {
  echo "FoamFile { version 2.0; format ascii; class $1; object $2; }"
  cat
}

# The end rings are symmetry planes. Rigid motion in them is left to the solver.
solve_with_openfoam() (
  cd "$1"
  local loop
  for loop in loop_0 loop_1; do
    sed -i "/^    $loop\$/,/}/ s/type .*/type symmetryPlane;/" constant/polyMesh/boundary
  done
  mkdir -p 0
  foam_file volVectorField D > 0/D << 'END'
dimensions [0 1 0 0 0 0 0];
internalField uniform (0 0 0);
boundaryField
{
  inner_wall { type tractionDisplacement; traction uniform (0 0 0); pressure uniform 1; value $internalField; }
  outer_wall { type tractionDisplacement; traction uniform (0 0 0); pressure uniform 0; value $internalField; }
  "loop_.*" { type symmetryPlane; }
}
END
  foam_file dictionary mechanicalProperties > constant/mechanicalProperties << 'END'
rho { type uniform; value 1; }
nu { type uniform; value 0.3; }
E { type uniform; value 1000; }
planeStress no;
END
  foam_file dictionary thermalProperties > constant/thermalProperties <<< 'thermalStress no;'
  foam_file dictionary fvSchemes > system/fvSchemes << 'END'
d2dt2Schemes { default steadyState; }
ddtSchemes { default Euler; }
gradSchemes { default leastSquares; }
divSchemes { div(sigmaD) Gauss linear; }
laplacianSchemes { laplacian(DD,D) Gauss linear corrected; }
interpolationSchemes { default linear; }
snGradSchemes { default none; }
END
  foam_file dictionary fvSolution > system/fvSolution << 'END'
solvers { D { solver GAMG; tolerance 1e-9; relTol 0.1; smoother GaussSeidel; nCellsInCoarsestLevel 20; } }
stressAnalysis { compactNormalStress yes; nCorrectors 1; D 1e-9; }
END
  foam_file dictionary controlDict > system/controlDict << END
application solidDisplacementFoam;
startFrom startTime; startTime 0; stopAt endTime; endTime $iterations; deltaT 1;
writeControl timeStep; writeInterval $iterations; writeFormat ascii; writePrecision 10;
END
  solidDisplacementFoam > solidDisplacementFoam.log
  postProcess -func writeCellCentres > postProcess.log
)

mkdir -p "$out"
build/hexwall generate cylinder -o "$out/surface.vtp" --edge 0.04
runs=()
while read -r size layers; do
  run=$out/size_$size
  echo "size $size, $layers layers"
  build/hexwall mesh "$out/surface.vtp" -o "$run" --units m --thickness 0.2 --size "$size" \
    --layers "$layers" --write abaqus,openfoam --quiet
  solve_with_calculix "$run" "$layers"
  solve_with_openfoam "$run/openfoam"
  runs+=("$size:$layers:$run")
done << 'END'
0.4 2
0.2 4
0.1 8
END
/usr/bin/python3 cases/lame_cylinder/compare.py "$iterations" "${runs[@]}"
