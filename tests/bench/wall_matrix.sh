#!/usr/bin/env bash
# Walls of every surface in a folder, for several thicknesses, layers and sides, judged by checkMesh.
#
#   tests/bench/wall_matrix.sh FOLDER > matrix.tsv
#   RATIOS="0.1" LAYERS="3" SIDES="out in both" tests/bench/wall_matrix.sh FOLDER
#
# A line for each run: surface, ratio, layers, side, exit code, least scaled Jacobian of the hexes,
# share of the area that is thinner than asked (outward, inward), verdict of checkMesh: OK with
# -allGeometry -allTopology, or plain, without (a single layer cannot pass the former, nor can many
# thin layers on large quads), or FAILED, and its complaints.
set -euo pipefail

folder=${1:?"usage: wall_matrix.sh FOLDER"}
program=${HEXWALL:-$(dirname "${BASH_SOURCE[0]}")/../../build/hexwall}
export WM_PROJECT_DIR=${WM_PROJECT_DIR:-/usr/share/openfoam}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

report() {
  /usr/bin/python3 - "$1" << 'END'
import json, sys
wall = json.load(open(sys.argv[1]))["wall"]
reduced = [f"{100 * wall[side]['reduced_area_fraction']:.2f}" if side in wall else "-"
           for side in ("outward", "inward")]
print(f"{wall['min_scaled_jacobian']:.3f}", *reduced, sep="\t")
END
}

judge() {
  if check -allGeometry -allTopology; then
    echo "OK"
    return
  fi
  local complaints
  complaints=$(grep -F '***' "$work/out/checkMesh.log" | tr -s ' \n' ' ')
  if check; then echo "plain: $complaints"; else echo "FAILED: $complaints"; fi
}

check() {
  (cd "$work/out/openfoam" && checkMesh "$@" > ../checkMesh.log 2>&1) || true
  grep -q '^Mesh OK' "$work/out/checkMesh.log"
}

printf 'surface\tratio\tlayers\tside\texit\tmin_sj\tthinner_out\tthinner_in\tcheckMesh\n'
for surface in "$folder"/*.{stl,vtp,vtk}; do
  [[ -f $surface ]] || continue
  for ratio in ${RATIOS:-0.05 0.1 0.2}; do
    for layers in ${LAYERS:-1 3 8}; do
      for side in ${SIDES:-out in both}; do
        options=(--thickness-ratio "$ratio" --layers "$layers" --side "$side")
        [[ $side != both ]] || options+=(--inner-thickness-ratio "$ratio" --inner-layers "$layers")
        rm -rf "$work/out"
        code=0
        "$program" mesh "$surface" -o "$work/out" "${options[@]}" --write openfoam --quiet \
          2> "$work/error" || code=$?
        printf '%s\t%s\t%s\t%s\t%s\t' "$(basename "$surface")" "$ratio" "$layers" "$side" "$code"
        if ((code == 0)); then
          printf '%s\t%s\n' "$(report "$work/out/report.json")" "$(judge)"
        else
          printf '\t\t\t%s\n' "$(tr '\n' ' ' < "$work/error")"
        fi
      done
    done
  done
done
