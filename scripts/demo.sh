#!/usr/bin/env bash
# From a fresh checkout to a trajectory: installs what is missing, builds, simulates an RGB-D sequence, runs rgbd_tum
# on it, prints its errors and draws them. Everything is written to demo_output/.
#
#   demo.sh [--preset NAME] [--frames N] [--seed N] [--no-install]
set -euo pipefail
# shellcheck source=scripts/lib.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/lib.sh"

preset=office_halfsphere
frames=300
seed=1
install=yes
while (($#)); do
  case "$1" in
    --preset) preset="${2:?--preset needs a name}" && shift 2 ;;
    --frames) frames="${2:?--frames needs a number}" && shift 2 ;;
    --seed) seed="${2:?--seed needs a number}" && shift 2 ;;
    --no-install) install=no && shift ;;
    *) usage_error "unknown option '$1' (known: --preset NAME, --frames N, --seed N, --no-install)" ;;
  esac
done

if [[ $install == yes ]]; then "$ROOT/scripts/install_dependencies.sh"; fi
build_preset release simulate_tum rgbd_tum
readonly BIN="$ROOT/build/release/bin" OUTPUT="$ROOT/demo_output"
mkdir -p "$OUTPUT"

say "Simulating $frames frames of '$preset' with the noise of a structured-light sensor"
"$BIN/simulate_tum" "$preset" "$OUTPUT/sequence" --frames "$frames" --noise --seed "$seed" --force

say "Running rgbd_tum"
"$BIN/rgbd_tum" - "$OUTPUT/sequence/settings.yaml" "$OUTPUT/sequence" --output "$OUTPUT" --seed "$seed"

say "Errors of the trajectory"
"$ROOT/scripts/plot_trajectory.py" "$OUTPUT/sequence/groundtruth.txt" "$OUTPUT/CameraTrajectory.txt" \
  --labels CP-SLAM --title "$preset, $frames frames" --output "$OUTPUT/trajectory.png"

say "Done"
echo "sequence    $OUTPUT/sequence"
echo "trajectory  $OUTPUT/CameraTrajectory.txt"
echo "statistics  $OUTPUT/stats.json"
echo "picture     $OUTPUT/trajectory.png"
