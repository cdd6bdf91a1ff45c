#!/usr/bin/env bash
# Steady flow in a generated abdominal aortic aneurysm with ten ends, in two processes.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

out=${1:-build/cases/aaa_flow}
mkdir -p "$out"
build/hexwall generate aaa -o "$out/aaa.vtp"
rm -rf "$out/run"
build/hexwall case "$out/aaa.vtp" -o "$out/run" --size 3 --size-by radius --layers 4 --growth 1.3 \
  --thickness-ratio 0.3 --core-growth 0.5 --re 600 --procs 2
"$out/run/Allrun"
build/hexwall shear "$out/run" -o "$out/run"
xvfb-run -a build/hexwall-picture "$out/run/wall.vtp" -o "$out/shear.png" --array wss \
  --range 0,1 --view=0,-1,0 --size 800x1000
