#!/usr/bin/env bash
# Installs the Debian packages that are missing, and nothing else.
# Usage: install_dependencies.sh run|test|check
#   run    what building and running the program needs
#   test   and what its tests and benchmarks need
#   check  and what the checks of .ci/run need
set -euo pipefail

run_packages=(g++ cmake ninja-build make pkg-config git ccache libtomlplusplus-dev libmuparser-dev libfmt-dev
  nlohmann-json3-dev libcli11-dev libcairo2-dev zlib1g-dev libfftw3-dev libeigen3-dev libhdf5-dev)
test_packages=(libgtest-dev librapidcheck-dev python3 python3-vtk9)
check_packages=(clang-format)
# Optional: with it, the integrators cvode and arkode. Debian's package brings PETSc and MPI along, so only checks ask.
check_packages+=(libsundials-dev)

case "${1:-run}" in
  run) packages=("${run_packages[@]}") ;;
  test) packages=("${run_packages[@]}" "${test_packages[@]}") ;;
  check) packages=("${run_packages[@]}" "${test_packages[@]}" "${check_packages[@]}") ;;
  *)
    echo "error: unknown group '$1'. Choose one of: run, test, check" >&2
    exit 1
    ;;
esac

if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
  if [ -n "${PERITHERM_SKIP_INSTALL:-}" ]; then exit 0; fi
  cat >&2 <<TEXT
error: this is no Debian-like system, so nothing can be installed for you.
Install a C++20 compiler with OpenMP, CMake 3.25 or later, Ninja and pkg-config, and the development files of toml++ 3.3,
muParser, fmt, nlohmann-json, CLI11, Eigen 3.4, cairo and zlib, FFTW if you want the fft backend and HDF5 for reduced models; for the tests GoogleTest, RapidCheck and Python 3.11.
Debian calls them: ${packages[*]}
Then run the same command again with PERITHERM_SKIP_INSTALL=1.
TEXT
  exit 1
fi

# A package that was removed but left its settings behind is still known to dpkg, so the state must be asked for.
installed=$(dpkg-query --show --showformat='${Package} ${db:Status-Status}\n' "${packages[@]}" 2>/dev/null |
  awk '$2 == "installed" { print $1 }' || true)
missing=()
for package in "${packages[@]}"; do
  grep --quiet --line-regexp --fixed-strings -- "$package" <<<"$installed" || missing+=("$package")
done
if [ ${#missing[@]} -eq 0 ]; then exit 0; fi

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  if ! command -v sudo >/dev/null; then
    echo "error: ${missing[*]} must be installed, and neither root nor sudo is there. Ask your administrator" >&2
    exit 1
  fi
  as_root=(sudo)
fi

echo "Installing with apt-get: ${missing[*]}"
"${as_root[@]}" apt-get update --quiet=2 </dev/null
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
  apt-get install --yes --quiet=2 --no-install-recommends "${missing[@]}" </dev/null
