#!/usr/bin/env bash
# Installs the Debian packages that building, testing and the scripts need, and that are not there yet.
# Does nothing, and asks for nothing, when all are there. Thirdparty/README.md says what each one is for.
#
#   install_dependencies.sh            install what is missing
#   install_dependencies.sh --missing  print what is missing, install nothing
set -euo pipefail
# shellcheck source=scripts/lib.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/lib.sh"

readonly PACKAGES=(
  g++ cmake ninja-build ccache
  libopencv-dev libeigen3-dev libceres-dev libsuitesparse-dev libcli11-dev nlohmann-json3-dev
  libopenni2-dev liboctomap-dev libglfw3-dev libimgui-dev libepoxy-dev fonts-inter
  libgtest-dev libgmock-dev libbenchmark-dev xvfb libx11-dev
  python3 python3-numpy python3-matplotlib python3-pil python3-pytest
)
# Another path is for the tests.
readonly OS_RELEASE="${CPSLAM_OS_RELEASE:-/etc/os-release}"

main() {
  local missing=()
  mapfile -t missing < <(missing_packages "${PACKAGES[@]}")
  case "${1:-}" in
    "") ;;
    --missing)
      ((${#missing[@]} == 0)) || printf '%s\n' "${missing[@]}"
      return
      ;;
    *) usage_error "unknown option '$1' (only --missing is known)" ;;
  esac
  if ((${#missing[@]} == 0)); then
    say "All ${#PACKAGES[@]} Debian packages are there"
    return
  fi
  check_system
  say "Installing ${#missing[@]} packages: ${missing[*]}"
  apt_install "${missing[@]}"
}

# Debian from 12 and Ubuntu from 24.04 on have every package under these names.
check_system() {
  local system="unknown" name="an unknown system"
  if [[ -r "$OS_RELEASE" ]]; then
    # shellcheck source=/dev/null
    system="$(. "$OS_RELEASE" && echo "${ID:-unknown} ${VERSION_ID:-0}")"
    # shellcheck source=/dev/null
    name="$(. "$OS_RELEASE" && echo "${PRETTY_NAME:-$system}")"
  fi
  if is_supported "$system" && command -v apt-get >/dev/null; then return; fi
  usage_error "this is $name; only Debian 12 and Ubuntu 24.04 (or newer) are known here. Install the counterparts" \
    "of these packages yourself and run the script that you came from with --no-install: ${missing[*]}"
}

is_supported() {
  local id="${1% *}" version="${1#* }" least
  case "$id" in
    debian) least=12 ;;
    ubuntu) least=24.04 ;;
    *) return 1 ;;
  esac
  [[ "$(printf '%s\n' "$least" "$version" | sort --version-sort | head -n 1)" == "$least" ]]
}

main "$@"
