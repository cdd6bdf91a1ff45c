#!/usr/bin/env bash
# A pulse of Carreau blood in a bifurcation: mean wall shear stress and its oscillation.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

out=${1:-build/cases/bifurcation}
mkdir -p "$out"
build/hexwall generate bifurcation -o "$out/bifurcation.vtp" --edge 0.1
rm -rf "$out/run"
build/hexwall case "$out/bifurcation.vtp" -o "$out/run" --size 0.35 --layers 4 --growth 1.3 \
  --thickness-ratio 0.3 --core-growth 0.5 --units cm --flow pulsatile --re 400 --period 0.9 --cycles 2 \
  --fluid carreau
"$out/run/Allrun"
build/hexwall shear "$out/run" -o "$out/run"
for value in tawss osi; do
  xvfb-run -a build/hexwall-picture "$out/run/wall.vtp" -o "$out/$value.png" --array $value \
    --view=0,-1,0 --size 700x700
done
