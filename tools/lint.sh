#!/usr/bin/env bash
# Checks the format, the scripts, and all sources with clang-tidy. Any finding fails.
# Arguments are the sources to check with clang-tidy instead of all: tools/lint.sh src/hex/*.cpp
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

our_files() {
  find src exporters tools tests cases -name "$1" | LC_ALL=C sort
}

{ our_files '*.h'; our_files '*.cpp'; } | xargs clang-format --dry-run -Werror
shellcheck .ci/run tools/*.sh cases/*/*.sh tests/*/*.sh tools/package/{postinst,prerm} \
  tools/cohort/profiles/*/*.sh
[[ -f build/compile_commands.json ]] || cmake --preset release > /dev/null

# Only what is compiled can be checked; headers are checked where they are included.
compiled() {
  while read -r file; do
    if grep -qF "/$file\"," build/compile_commands.json; then echo "$file"; fi
  done
}

# The largest files first, so that no long one is left for the end. What goes to stderr besides
# errors is the number of warnings in system headers, which clang-tidy suppresses.
{ if (($#)); then printf '%s\n' "$@"; else our_files '*.cpp'; fi; } | compiled | xargs -r ls -S |
  xargs -r -P2 -n1 clang-tidy --quiet -p build 2> >(grep -v ' warnings\? generated' >&2 || true)
