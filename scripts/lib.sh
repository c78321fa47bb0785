# shellcheck shell=bash
# Shared by the shell scripts: source it, do not run it.

ROOT="$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd)"
readonly ROOT

say() { printf '\n==> %s\n' "$*" >&2; }

# usage_error TEXT: one line and status 2.
usage_error() {
  printf '%s: %s\n' "$(basename -- "$0")" "$*" >&2
  exit 2
}

# How many compilers may run at once: each takes up to 2 GiB, and make -j without a number has killed machines.
build_jobs() {
  local cores gib jobs
  cores="$(nproc)"
  gib="$(awk '/^MemTotal:/ { print int($2 / 1048576) }' /proc/meminfo)"
  jobs=$((gib / 2 < cores ? gib / 2 : cores))
  echo $((jobs < 1 ? 1 : jobs))
}

# build_preset PRESET [TARGET...]: configures and builds; all targets when none is named.
build_preset() {
  local preset="$1"
  shift
  say "Building preset $preset"
  (
    cd -- "$ROOT" || exit 1
    cmake --preset "$preset"
    cmake --build --preset "$preset" --parallel "$(build_jobs)" ${1:+--target "$@"}
  ) >&2
}

# missing_packages PACKAGE...: those of the Debian packages that are not installed, one per line.
missing_packages() {
  local package
  for package in "$@"; do
    [[ "$(dpkg-query --show --showformat='${db:Status-Status}' "$package" 2>/dev/null || true)" == installed ]] ||
      echo "$package"
  done
}

# apt_install PACKAGE...: installs Debian packages, as root or through sudo.
apt_install() {
  local command=(env DEBIAN_FRONTEND=noninteractive apt-get)
  if ((EUID != 0)); then
    command -v sudo >/dev/null ||
      usage_error "packages are missing and there is no sudo: run as root: apt-get install $*"
    command=(sudo "${command[@]}")
  fi
  "${command[@]}" update >&2
  "${command[@]}" install --yes --no-install-recommends "$@" >&2
}
