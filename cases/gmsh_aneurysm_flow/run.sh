#!/usr/bin/env bash
# Steady flow in the aneurysm of Debian's gmsh-doc at Re 300, on hybrid meshes and on tetrahedra of
# several sizes. All have the same flow rate: at the same Re, meshes whose polygons cut off more of
# the inlet would get less.
#
#   run.sh [FOLDER [FINEST]]     # sizes in mm down to FINEST, 0.85 unless given
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

out=${1:-build/cases/gmsh_aneurysm_flow}
aneurysm=/usr/share/doc/gmsh-doc/doc/gmsh/demos/api/aneurysm_data.stl.gz
if [[ ! -f $aneurysm ]]; then
  aneurysm=build/demo/gmsh-doc$aneurysm # where tools/demo.sh puts it if /usr/share/doc is left out
fi
finest=${2:-0.85}
mkdir -p "$out"
gzip -dc "$aneurysm" > "$out/aneurysm.stl"

# Makes and runs the case KIND_SIZE.
run() {
  local kind=$1 size=$2 folder=$out/$1_$2
  shift 2
  rm -rf "$folder"
  build/hexwall case "$out/aneurysm.stl" -o "$folder" --mesh "$kind" --size "$size" \
    --flow-rate 6.6 --quiet "$@"
  "$folder/Allrun"
  build/hexwall shear "$folder" -o "$folder"
}

for size in 2.4 2 1.5 1.2 1 0.85 0.7 0.6 0.5; do
  if awk "BEGIN { exit !($size < $finest) }"; then break; fi
  run hybrid $size --layers 10 --growth 1.2 --thickness-ratio 0.3
  if [[ $size != 2.4 ]]; then run tet $size; fi
done
/usr/bin/python3 cases/gmsh_aneurysm_flow/compare.py "$out"
xvfb-run -a build/hexwall-picture "$out/hybrid_$finest/wall.vtp" -o "$out/shear.png" --array wss \
  --range 0,2 --view=0.2,-1,0.2 --size 1000x700
