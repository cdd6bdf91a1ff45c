#!/usr/bin/env bash
# Meshes the wall of a generated abdominal aortic aneurysm and checks it with OpenFOAM.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

out=${1:-build/cases/aaa}
mkdir -p "$out"
build/hexwall generate aaa -o "$out/surface.vtp"
build/hexwall mesh "$out/surface.vtp" -o "$out/mesh" --size 0.86
cd "$out/mesh/openfoam"
export WM_PROJECT_DIR=${WM_PROJECT_DIR:-/usr/share/openfoam}
checkMesh -allGeometry -allTopology | tee ../checkMesh.log | grep -E '\*\*\*|Mesh OK|Failed'
grep -q '^Mesh OK' ../checkMesh.log
