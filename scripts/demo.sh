#!/usr/bin/env bash
# From a fresh checkout to two trajectories: installs what is missing, builds, simulates an RGB-D sequence of an office
# where people walk, runs rgbd_tum on it with the person detector and without, prints the errors of both and draws them in
# one picture. Everything is written to demo_output/. --exact-boxes gives the filter the simulator's boxes instead of the
# detector's; so it is where there is no detector's network, models/yc.weights.
#
#   demo.sh [--preset NAME] [--people N] [--frames N] [--seed N] [--exact-boxes] [--no-install]
set -euo pipefail
# shellcheck source=scripts/lib.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/lib.sh"

preset=
people=
frames=300
seed=1
install=yes
boxes=yolo
if [[ ! -f "$ROOT/models/yc.weights" ]]; then boxes=exact; fi
while (($#)); do
  case "$1" in
    --preset) preset="${2:?--preset needs a name}" && shift 2 ;;
    --people) people="${2:?--people needs a number}" && shift 2 ;;
    --frames) frames="${2:?--frames needs a number}" && shift 2 ;;
    --seed) seed="${2:?--seed needs a number}" && shift 2 ;;
    --exact-boxes) boxes=exact && shift ;;
    --no-install) install=no && shift ;;
    *) usage_error "unknown option '$1' (known: --preset NAME, --people N, --frames N, --seed N, --exact-boxes, --no-install)" ;;
  esac
done
# Six people before a turning camera: without the filter it is carried along with them.
if [[ -z $preset ]]; then preset=walking_rpy people="${people:-6}"; fi

if [[ $install == yes ]]; then "$ROOT/scripts/install_dependencies.sh"; fi
build_preset release simulate_tum rgbd_tum
readonly BIN="$ROOT/build/release/bin" OUTPUT="$ROOT/demo_output"
readonly SEQUENCE="$OUTPUT/sequence"
mkdir -p "$OUTPUT"

# run_on_sequence NAME [OPTION...]: rgbd_tum's results go to demo_output/NAME/.
run_on_sequence() {
  local output="$OUTPUT/$1"
  shift
  "$BIN/rgbd_tum" - "$SEQUENCE/settings.yaml" "$SEQUENCE" --output "$output" --seed "$seed" "$@"
}

say "Simulating $frames frames of '$preset' with the noise of a structured-light sensor"
"$BIN/simulate_tum" "$preset" "$SEQUENCE" --frames "$frames" --noise --seed "$seed" --force \
  ${people:+--people "$people"}

rm -rf -- "$OUTPUT/pictures" # those of an earlier, longer run
if [[ $boxes == yolo ]]; then
  say "Running rgbd_tum with the person detector, drawing what it removes"
  detector=(--detector yolo)
else
  say "Running rgbd_tum with the simulator's boxes of the people, drawing what it removes"
  detector=(--boxes "$SEQUENCE/person_boxes.txt")
fi
run_on_sequence filter "${detector[@]}" --draw "$OUTPUT/pictures"

say "Running rgbd_tum without a filter"
run_on_sequence no_filter --detector none

say "Errors of the trajectories"
"$ROOT/scripts/plot_trajectory.py" "$SEQUENCE/groundtruth.txt" \
  "$OUTPUT/filter/CameraTrajectory.txt" "$OUTPUT/no_filter/CameraTrajectory.txt" \
  --labels CP-SLAM "no filter" --title "$preset, $frames frames" --output "$OUTPUT/trajectory.png"

say "Done"
echo "sequence      $SEQUENCE"
echo "trajectories  $OUTPUT/{filter,no_filter}/CameraTrajectory.txt"
echo "statistics    $OUTPUT/{filter,no_filter}/stats.json"
echo "frames        $OUTPUT/pictures/: kept keypoints green, those on people red"
echo "plot          $OUTPUT/trajectory.png"
