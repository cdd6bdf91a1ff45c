#!/usr/bin/env bash
# Makes the Debian package of a build, installs it, uses everything in it, and removes it again:
# in the system where root runs this, else unpacked into a folder.
#   deb.sh BUILD_FOLDER WORK_FOLDER
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
build=$1
work=$2

fail() {
  echo "deb.sh: $*" >&2
  exit 1
}

make_package() {
  rm -rf "$work"
  mkdir -p "$work"
  cpack --config "$build/CPackConfig.cmake" -G DEB -B "$work" > "$work/cpack.log" 2>&1 ||
    { cat "$work/cpack.log" >&2; exit 1; }
  deb=$(echo "$work"/hexwall_*.deb)
  dpkg-deb -f "$deb" > "$work/control"
  for package in libvtk9 libtbb libcholmod libfmt libgmp python3-numpy 'python3 (<<'; do
    grep -q "^Depends:.*$package" "$work/control" || fail "does not depend on $package"
  done
}

install_package() {
  root=
  # One such test at a time; apt or dpkg may be busy with something else.
  exec 8> /tmp/hexwall-package-test.lock
  if ((EUID == 0)) && flock -w 300 8 && ! dpkg-query -s hexwall > /dev/null 2>&1; then
    trap remove_package EXIT
    for _ in {1..30}; do
      if dpkg -i "$deb" > "$work/dpkg.log" 2>&1; then return; fi
      grep -q 'lock' "$work/dpkg.log" || break
      sleep 2
    done
    cat "$work/dpkg.log" >&2
    fail "cannot be installed"
  fi
  root=$work/root
  dpkg-deb -x "$deb" "$root"
  export PATH=$root/usr/bin:$PATH
  export PYTHONPATH=$root/usr/lib/python3/dist-packages
}

remove_package() {
  trap - EXIT
  if [[ -n $root ]]; then return; fi
  dpkg -P hexwall > "$work/dpkg.log" 2>&1 || { cat "$work/dpkg.log" >&2; exit 1; }
}

use_programs() {
  [[ $(command -v hexwall) == "$root/usr/bin/hexwall" ]] || fail "another hexwall is in PATH"
  cd "$work"
  hexwall generate bifurcation --edge 0.3 -o surface.vtp
  hexwall mesh surface.vtp -o mesh --size 0.4 -q
  [[ -s mesh/wall.vtu ]] || fail "hexwall makes no mesh"
  hexwall-picture --version | grep -q '^hexwall-picture [0-9]' || fail "hexwall-picture does not run"
}

# Every option that --help shows is in the manual page and in the completion.
use_pages() {
  # shellcheck disable=SC1091
  source "$root/usr/share/bash-completion/completions/hexwall"
  # shellcheck disable=SC1091
  source "$root/usr/share/bash-completion/completions/hexwall-picture"
  local commands command option
  commands=$(hexwall --help | sed -n '/^Subcommands:/,/^$/s/^  \([a-z-]*\) .*/\1/p')
  [[ $commands == *mesh* ]] || fail "no commands found in --help"
  for command in $commands; do
    compare_options "hexwall-$command" hexwall "$command"
  done
  compare_options hexwall-picture hexwall-picture
  COMP_WORDS=(hexwall '') COMP_CWORD=1
  _hexwall
  for command in $commands; do
    [[ " ${COMPREPLY[*]} " == *" $command "* ]] || fail "$command is not completed"
  done
  COMP_WORDS=(hexwall mesh s.stl --side '=' i) COMP_CWORD=5
  _hexwall
  [[ ${COMPREPLY[*]} == in ]] || fail "--side=i is completed to ${COMPREPLY[*]}"
  COMP_WORDS=(hexwall mesh s.stl --write 'vtu,g') COMP_CWORD=4
  _hexwall
  [[ ${COMPREPLY[*]} == vtu,gmsh ]] || fail "--write vtu,g is completed to ${COMPREPLY[*]}"
}

compare_options() {
  local page=$root/usr/share/man/man1/$1.1.gz
  shift
  local text options
  text=$(gzip -dc "$page" | sed 's/\\//g')
  COMP_WORDS=("$@" --) COMP_CWORD=$#
  "_${1//-/_}"
  options=$("$@" --help | grep -oP '^  (-\w,)?--\K[\w-]+')
  for option in $options; do
    [[ " ${COMPREPLY[*]} " == *" --$option "* ]] || fail "$*: --$option is not completed"
    [[ $option == help || $option == version || $text == *"fB--$option"* ]] ||
      fail "--$option is not in $page"
  done
}

use_library() {
  "$here/../consumer/build.sh" "$root/usr" "$work" > /dev/null
}

use_python() {
  (cd / && /usr/bin/python3 - "$root/usr/lib/python3/dist-packages/hexwall/" << 'END'
import sys
import hexwall
assert hexwall.__file__.startswith(sys.argv[1]), hexwall.__file__
assert len(hexwall.mesh(hexwall.generate("bifurcation", edge=0.3), size=0.4).hexes) > 1000
END
  )
}

make_package
install_package
use_programs
use_pages
use_library
use_python
files=$(dpkg-deb -c "$deb" | awk '{print substr($6, 2)}' | grep hexwall)
remove_package
if [[ -z $root ]]; then
  for file in $files; do
    [[ ! -e $file ]] || fail "$file is left behind"
  done
fi
echo "installed into ${root:-the system}, used and removed: $(basename "$deb")"
