#!/usr/bin/env bash
# Steady flow in the lumen of a generated abdominal aortic aneurysm with nine outlets.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

out=${1:-build/cases/aaa_flow}
mkdir -p "$out"
build/hexwall generate aaa -o "$out/surface.vtp"
rm -rf "$out/run"
build/hexwall case "$out/surface.vtp" -o "$out/run" --size 2.4 --layers 4 --growth 1.3 \
  --thickness-ratio 0.3 --core-growth 1 --re 300
"$out/run/Allrun"
build/hexwall shear "$out/run" -o "$out/run"
/usr/bin/python3 cases/aaa_flow/flows.py "$out/run"
xvfb-run -a build/hexwall-picture "$out/run/wall.vtp" -o "$out/shear.png" --array wss \
  --range 0,0.3 --view=0,1,0 --size 700x1000
