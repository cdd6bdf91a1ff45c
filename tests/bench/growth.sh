#!/usr/bin/env bash
# Seconds and memory per triangle and per quad as surfaces and meshes grow: a table in the terminal.
#
#   tests/bench/growth.sh [FOLDER]     # the surfaces are made there once, in about 10 minutes
#
# The generated aortic aneurysm with 10^4 to 4 10^6 triangles, and with 4 10^3 to 5 10^6 quads.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

folder=${1:-build/bench/growth}
mkdir -p "$folder"

# Prints seconds, peak memory in bytes, triangles and quads of a run.
run() {
  rm -rf "$folder/out"
  build/hexwall mesh "$@" -o "$folder/out" --no-report --quiet
  /usr/bin/python3 - "$folder/out/report.json" << 'END'
import json, sys
r = json.load(open(sys.argv[1]))
seconds, peak = r["seconds"]["total"], r["peak_memory_bytes"]
triangles, quads = r["input"]["faces"], r["quads"]["count"]
print(f"| {triangles} | {quads} | {seconds:.2f} | {1e6 * seconds / triangles:.1f} "
      f"| {1e6 * seconds / quads:.1f} | {peak / 1e6:.0f} | {peak / triangles:.0f} "
      f"| {peak / quads:.0f} |")
END
}

echo "| triangles | quads | s | µs/triangle | µs/quad | MB | B/triangle | B/quad |"
echo "|---|---|---|---|---|---|---|---|"
for edge in 2 1 0.312 0.156; do
  surface=$folder/aaa_$edge.vtp
  [[ -f $surface ]] || build/hexwall generate aaa --edge "$edge" -o "$surface" > /dev/null
  run "$surface"
done
surface=$folder/aaa.vtp
[[ -f $surface ]] || build/hexwall generate aaa -o "$surface" > /dev/null
for size in 3 1.9 0.6 0.19 0.085; do
  run "$surface" --size "$size"
done
