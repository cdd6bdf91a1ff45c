#!/usr/bin/env bash
# Developed flow in a straight tube by OpenFOAM, on hybrid meshes with square quads and with quads
# twice as long as wide, and on tetrahedra of TetGen, of several sizes, against the exact solution.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
export WM_PROJECT_DIR=${WM_PROJECT_DIR:-/usr/share/openfoam}

out=${1:-build/cases/poiseuille}
mkdir -p "$out"
build/hexwall generate cylinder -o "$out/tube.vtp" --edge 0.03

# Makes and runs the case NAME_SIZE.
run() {
  local kind=$2 size=$3 folder=$out/$1_$3
  shift 3
  rm -rf "$folder"
  build/hexwall case "$out/tube.vtp" -o "$folder" --mesh "$kind" --size "$size" --re 100 --quiet "$@"
  "$folder/Allrun"
  postProcess -case "$folder" -time 0 -func writeCellCentres > "$folder/log.centres"
  postProcess -case "$folder" -time 0 -func writeCellVolumes > "$folder/log.volumes"
}

layers=(--layers 6 --growth 1.2 --thickness-ratio 0.6 --core-growth 0)
for size in 0.6 0.45 0.3 0.2; do
  run hybrid hybrid $size "${layers[@]}"
  run stretched hybrid $size "${layers[@]}" --stretch 2
done
for size in 0.45 0.3 0.2 0.14; do
  run tet tet $size
done
/usr/bin/python3 cases/poiseuille/compare.py "$out"
