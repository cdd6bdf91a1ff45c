#!/usr/bin/env bash
# Times hexwall and other quad and wall meshers on the same surface in the same run, and measures
# what they make: a table in the terminal and compare.json.
#
#   tests/bench/compare.sh [SURFACE [SIZE [THICKNESS]]]     # by default gmsh's aneurysm, 0.68, 0.5
#
# gmsh and TetGen are Debian's. QuadriFlow, Instant Meshes and QuadWild run if quadriflow,
# instant-meshes or quadwild are on PATH.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

out=build/bench
mkdir -p "$out"
if [[ $# -gt 0 ]]; then
  surface=$1
else
  aneurysm=/usr/share/doc/gmsh-doc/doc/gmsh/demos/api/aneurysm_data.stl.gz
  if [[ ! -f $aneurysm ]]; then
    aneurysm=build/demo/gmsh-doc$aneurysm # where tools/demo.sh puts it if /usr/share/doc is left out
  fi
  surface=$out/aneurysm.stl
  gzip -dc "$aneurysm" > "$surface"
fi
/usr/bin/python3 tests/bench/compare.py "$surface" "$out" "${2:-0.68}" "${3:-0.5}"
