#!/usr/bin/env bash
# From a fresh Debian 12 to a checked hex mesh of an aneurysm's wall, with pictures, in build/demo.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

demo=build/demo
mesh=$demo/aneurysm
surface=$demo/aneurysm_data.stl
packed=/usr/share/doc/gmsh-doc/doc/gmsh/demos/api/aneurysm_data.stl.gz

# Slim containers leave out /usr/share/doc when they install: then take the file from the package.
unpack_from_package() {
  (
    cd "$demo"
    rm -f gmsh-doc_*.deb
    apt-get download -qq gmsh-doc || { update_package_lists && apt-get download -qq gmsh-doc; }
    dpkg-deb -x gmsh-doc_*.deb gmsh-doc
    rm -f gmsh-doc_*.deb
  )
  packed=$demo/gmsh-doc$packed
}

update_package_lists() {
  if ((EUID == 0)); then apt-get update -qq; else sudo apt-get update -qq; fi
}

check() {
  echo "Checking the mesh with OpenFOAM"
  (cd "$mesh/openfoam" && WM_PROJECT_DIR=${WM_PROJECT_DIR:-/usr/share/openfoam} \
    checkMesh -allGeometry -allTopology > ../checkMesh.log 2>&1) || true
  grep -q '^Mesh OK' "$mesh/checkMesh.log" && return
  cat "$mesh/checkMesh.log" >&2
  echo "tools/demo.sh: checkMesh refuses the mesh" >&2
  exit 1
}

tools/setup.sh
cmake --preset release
cmake --build --preset release --target hexwall hexwall-picture

mkdir -p "$demo"
[[ -f $packed ]] || unpack_from_package
gzip -dc "$packed" > "$surface"
build/hexwall mesh "$surface" -o "$mesh" --size 0.8 --pictures
check

cat << END

Mesh OK, says checkMesh: $mesh/checkMesh.log

Open in a browser:
  $PWD/$mesh/report.html    numbers, pictures, a 3-D view (with Node.js at build time)
Open in ParaView:
  $PWD/$mesh/wall.vtu       the hexahedra: colour by layer, quad or zone
  $PWD/$mesh/quads.vtp      the quads
  $PWD/$mesh/surface.vtp    the surface with its texture coordinates
  $PWD/$mesh/critical.vtp   the critical lines that cut it into cylinders
OpenFOAM case:
  $PWD/$mesh/openfoam
Pictures:
  $PWD/$mesh/pictures
END
