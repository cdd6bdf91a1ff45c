#!/usr/bin/env bash
# Installs the Debian packages of tools/packages.txt that are missing. Does nothing if none is.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

missing=()
while read -r package _; do
  [[ -z $package || $package == '#'* ]] && continue
  status=$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null || true)
  [[ $status == installed ]] || missing+=("$package")
done < tools/packages.txt
((${#missing[@]})) || exit 0

as_root=()
if ((EUID != 0)); then
  if ! command -v sudo > /dev/null; then
    echo "tools/setup.sh: run it as root, or install: ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo)
fi

log=$(mktemp)
trap 'rm -f "$log"' EXIT
run_quietly() {
  "$@" > "$log" 2>&1 < /dev/null || { cat "$log" >&2; exit 1; }
}
echo "Installing ${#missing[@]} packages: ${missing[*]}"
# Java, which libvtk9-dev depends on, fails to install where a slim container has no manual pages.
run_quietly "${as_root[@]}" mkdir -p /usr/share/man/man1
run_quietly "${as_root[@]}" apt-get update
run_quietly "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
  apt-get install -y --no-install-recommends "${missing[@]}"
