#!/usr/bin/env bash
# From nothing to a report: installs what is needed, builds plat, fetches the default data set, divides its blocks by
# every strategy, compares with the observed plots, and makes a page to open.
#   scripts/demo.sh [--data NAME] [--out DIR]
set -euo pipefail
cd "$(dirname "$0")/.."

data=san_francisco_us
out=
while [ $# -gt 0 ]; do
  case "$1" in
    --data) data="${2:?--data needs a name}"; shift 2 ;;
    --out) out="${2:?--out needs a folder}"; shift 2 ;;
    *) sed -n '2,4s/^# *//p' "$0" >&2; exit 2 ;;
  esac
done
out="${out:-out/$data}"

step() { printf '\n== %s (%d s so far)\n' "$1" "$SECONDS"; }

step "installing packages"
scripts/install_dependencies.sh run
step "building plat"
cmake --preset release -DPLAT_TESTS=OFF -DPLAT_BENCHMARKS=OFF
cmake --build --preset release --target plat
step "fetching $data"
build/release/plat data check "$data" >/dev/null 2>&1 || build/release/plat data fetch "$data"
step "running the comparison"
status=0
build/release/plat run parcels_vs_observed --data "$data" --out "$out" || status=$?
[ "$status" -le 1 ] || exit "$status"  # 1: done, with blocks that could not be divided listed as rows
step "making the report"
build/release/plat report "$out"
step "done"
echo "open $PWD/$out/report.html in a browser, and $PWD/$out/layout_$data.gpkg in QGIS"
