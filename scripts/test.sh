#!/usr/bin/env bash
# Installs what is missing, builds and runs all tests. With --sanitizers also the builds with AddressSanitizer and
# UndefinedBehaviorSanitizer and with ThreadSanitizer (much slower).
#
#   test.sh [--sanitizers] [--no-install]
set -euo pipefail
# shellcheck source=scripts/lib.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/lib.sh"

presets=(release)
install=yes
for argument in "$@"; do
  case "$argument" in
    --sanitizers) presets=(asan tsan release) ;;
    --no-install) install=no ;;
    *) usage_error "unknown option '$argument' (known: --sanitizers, --no-install)" ;;
  esac
done

if [[ $install == yes ]]; then "$ROOT/scripts/install_dependencies.sh"; fi
cd -- "$ROOT"
# TSan cannot see into OpenCV's uninstrumented thread pool and hangs there without this; it still sees our threads.
export TSAN_OPTIONS="ignore_noninstrumented_modules=1:halt_on_error=1${TSAN_OPTIONS:+:$TSAN_OPTIONS}"
export UBSAN_OPTIONS="halt_on_error=1:print_stacktrace=1${UBSAN_OPTIONS:+:$UBSAN_OPTIONS}"
for preset in "${presets[@]}"; do
  build_preset "$preset"
  say "Testing preset $preset"
  ctest --preset "$preset" --parallel "$(build_jobs)"
done
