#!/usr/bin/env bash
# clang-tidy 19 over every translation unit of ours; any finding is an error.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/install_dependencies.sh dev
cmake --preset tidy
cmake --build --preset tidy
