#!/usr/bin/env bash
# Builds and runs the project beside this script against an installed hexwall.
#   build.sh PREFIX WORK_FOLDER
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
prefix=$1
work=$2

cmake -S "$here" -B "$work/consumer" -G Ninja -DCMAKE_PREFIX_PATH="$prefix" \
  -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER_LAUNCHER="$(command -v ccache || true)" > /dev/null
if ! grep -q "^hexwall_DIR:PATH=$prefix/" "$work/consumer/CMakeCache.txt"; then
  echo "another hexwall was found than that of $prefix" >&2
  exit 1
fi
cmake --build "$work/consumer" > "$work/build.log" || { cat "$work/build.log" >&2; exit 1; }
"$work/consumer/consumer" "$work/bifurcation.msh" | tee "$work/run.log"
grep -q '^5/5 wall$' "$work/run.log"
grep -q '^cancelled$' "$work/run.log"
grep -q MeshFormat "$work/bifurcation.msh"
