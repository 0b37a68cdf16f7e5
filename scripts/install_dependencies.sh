#!/usr/bin/env bash
# Installs what Plat needs from Debian 12, as root or with sudo. Asks apt only for what is missing.
#   scripts/install_dependencies.sh run    to build and run plat
#   scripts/install_dependencies.sh test   that, and to build and pass the tests
#   scripts/install_dependencies.sh dev    that, and clang, clang-tidy and the fuzzers
set -euo pipefail

run_packages=(
  g++ cmake ninja-build pkg-config ccache mold git ca-certificates
  libboost-dev libcgal-dev libcli11-dev libexpected-dev libfmt-dev libgdal-dev libgeos-dev libgmp-dev libmpfr-dev
  libcairo2-dev libeigen3-dev libopenmesh-dev libssl-dev libtbb-dev libtinygltf-dev nlohmann-json3-dev
  gdal-bin povray python3 python3-matplotlib python3-pandas python3-geopandas)
test_packages=(
  libgtest-dev libgmock-dev libbenchmark-dev librapidcheck-dev clang-format-19
  jupyter-nbconvert python3-ipykernel python3-nbformat python3-jsonschema python3-networkx python3-osmnx)
dev_packages=(clang-19 clang-tidy-19 libclang-rt-19-dev)

level="${1:-run}"
case "$level" in
  run) packages=("${run_packages[@]}") ;;
  test) packages=("${run_packages[@]}" "${test_packages[@]}") ;;
  dev) packages=("${run_packages[@]}" "${test_packages[@]}" "${dev_packages[@]}") ;;
  *) echo "usage: $0 run|test|dev" >&2; exit 2 ;;
esac
# npm fetches the default data set; any npm will do.
command -v npm >/dev/null || packages+=(npm)

missing=()
for package in "${packages[@]}"; do
  status=$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null || true)
  [ "$status" = installed ] || missing+=("$package")
done
[ "${#missing[@]}" -eq 0 ] && exit 0

if ! command -v apt-get >/dev/null; then
  echo "these Debian 12 packages are needed: ${missing[*]}" >&2
  exit 1
fi
as_root=()
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null || { echo "run this as root, or install sudo; needed: ${missing[*]}" >&2; exit 1; }
  as_root=(sudo)
fi
echo "installing ${#missing[@]} packages: ${missing[*]}"
"${as_root[@]}" apt-get update -qq
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
