#!/usr/bin/env bash
# Installs the library of a build to a folder of its own, moves that, and builds and runs a project
# that finds it there.
#   run.sh BUILD_FOLDER WORK_FOLDER
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
build=$1
work=$2

rm -rf "$work"
mkdir -p "$work"
cmake --install "$build" --component library --prefix "$work/first" > /dev/null
mv "$work/first" "$work/installed"  # nothing may depend on where it was installed to
"$here/build.sh" "$work/installed" "$work"
