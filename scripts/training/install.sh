#!/usr/bin/env bash
# Installs what train_detector.py needs besides scripts/install_dependencies.sh: PyTorch and OpenCV for Python, as
# Debian has them. Building, testing and running CP-SLAM need neither; the tests of the training are skipped without.
set -euo pipefail
# shellcheck source=scripts/lib.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/../lib.sh"

readonly PACKAGES=(python3-torch python3-opencv python3-numpy python3-matplotlib)

main() {
  (($# == 0)) || usage_error "unknown option '$1' (none is known)"
  local missing=()
  mapfile -t missing < <(missing_packages "${PACKAGES[@]}")
  if ((${#missing[@]} == 0)); then
    say "All of ${PACKAGES[*]} are there"
    return
  fi
  say "Installing ${missing[*]}"
  apt_install "${missing[@]}"
}

main "$@"
