#!/usr/bin/env bash
# Follows the tutorial with the programs of build/.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

out=${1:-build/cases/tutorial}
PATH=$PWD/build:$PATH PYTHONPATH=$PWD/build/python /usr/bin/python3 cases/tutorial/follow.py "$out"
