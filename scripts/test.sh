#!/usr/bin/env bash
# Installs what is needed, builds everything and runs every test. Real cities are tested where PLAT_DATA_DIR has them.
#   scripts/test.sh [ctest arguments...]
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/install_dependencies.sh test
cmake --preset release -DPLAT_TESTS=ON -DPLAT_BENCHMARKS=ON
cmake --build --preset release
cmake --build --preset release --target all_verify_interface_header_sets
ctest --preset release --parallel "$(nproc)" "$@"
