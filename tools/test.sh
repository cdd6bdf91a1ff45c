#!/usr/bin/env bash
# Builds hexwall and runs all tests. Arguments go to ctest, for instance: tools/test.sh -R openfoam
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

tools/setup.sh
cmake --preset release
cmake --build --preset release
ctest --test-dir build -j2 --output-on-failure "$@"
