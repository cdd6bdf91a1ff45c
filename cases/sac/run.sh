#!/usr/bin/env bash
# The saccular aneurysm of Debian's gmsh-doc, meshed without and with poles, with a picture of each.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

out=${1:-build/cases/sac}
surface=$out/aneurysm.stl

mkdir -p "$out"
gunzip -c /usr/share/doc/gmsh-doc/doc/gmsh/demos/api/aneurysm_data.stl.gz > "$surface"
for poles in off auto; do
  build/hexwall mesh "$surface" -o "$out/$poles" --size 1.2 --poles $poles
  xvfb-run -a build/hexwall-picture "$out/$poles/quads.vtp" -o "$out/poles_$poles.png" --edges \
    --view 1 -0.3 0.2 --size 640x560
done
echo "Pictures: $out/poles_off.png, $out/poles_auto.png"
