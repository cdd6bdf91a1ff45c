#!/usr/bin/env bash
# Two aneurysms under blood pressure: their walls in hexes of hexwall and in tets of TetGen, solved by
# CalculiX and compared at the same points.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
export OMP_NUM_THREADS=1 # times are those of one core

here=cases/aaa_wall_stress
out=${1:-build/cases/aaa_wall_stress}
aneurysm=/usr/share/doc/gmsh-doc/doc/gmsh/demos/api/aneurysm_data.stl.gz
if [[ ! -f $aneurysm ]]; then
  aneurysm=build/demo/gmsh-doc$aneurysm # where tools/demo.sh puts it if /usr/share/doc is left out
fi

# Runs a command with its output in LOG.log and its CPU time in LOG.seconds.
timed() {
  local log=$1 TIMEFORMAT=%U
  shift
  if ! { time "$@" > "$log.log" 2>&1; } 2> "$log.seconds"; then
    tail "$log.log" >&2
    exit 1
  fi
}

# -Y keeps the triangles of the boundary, so that all meshes share its nodes.
mesh() {
  local folder=$1 surface=$2
  shift 2
  timed "$folder/hexwall" build/hexwall mesh "$surface" -o "$folder" --layers 3 --threads 1 \
    --write abaqus "$@"
  /usr/bin/python3 $here/tets.py boundary "$folder/wall.inp" "$folder/tets.smesh"
  timed "$folder/tetgen" tetgen -pYq1.5 "$folder/tets.smesh"
  /usr/bin/python3 $here/tets.py mesh "$folder/wall.inp" "$folder/tets.1" "$folder/tets.inp"
}

solve() {
  local kind
  /usr/bin/python3 $here/decks.py "$1"
  for kind in C3D8 C3D8I C3D4 C3D10 C3D20R; do
    echo "$1: CalculiX with $kind"
    timed "$1/$kind" env -C "$1" ccx -i "${kind}_deck"
    grep -q 'Job finished' "$1/$kind.log"
  done
}

picture() {
  local folder=$1
  shift
  xvfb-run -a build/hexwall-picture "$folder/stress.vtu" -o "$folder.png" \
    --array 'sigma_1 [MPa]' "$@"
}

mkdir -p "$out"/{aaa,aneurysm}
build/hexwall generate aaa -o "$out/aaa.vtp"
gzip -dc "$aneurysm" > "$out/aneurysm.stl"
mesh "$out/aaa" "$out/aaa.vtp" --thickness 1.5 --size 2.8 --size-by radius
mesh "$out/aneurysm" "$out/aneurysm.stl" --thickness 1 --size 0.9
solve "$out/aaa"
solve "$out/aneurysm"
/usr/bin/python3 $here/compare.py "$out/aaa" "$out/aneurysm"
picture "$out/aaa" --range 0,0.3 --view=0,-1,0 --size 1300x1200
picture "$out/aneurysm" --range 0,0.4 --view=0.2,-1,0.2 --size 1300x750
