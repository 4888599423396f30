#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The lightstripe authors
# SPDX-License-Identifier: Apache-2.0
#
# scripts/night on a real Slurm of one node that this test starts: killed runs, a restarted node, a part that fails; the merged files
# have the bytes of one run.
# usage: night.sh BINARY SOURCE_FOLDER [FRAMES [PARTS [KILLS]]]; exit code 77 (skipped) without Slurm or root
set -euo pipefail
binary=$(realpath "$1") source=$(realpath "$2") frames=${3:-240} parts=${4:-4} kills=${5:-3}
night=$source/scripts/night slurm=$source/scripts/one_node_slurm
work=$(mktemp -d)
finish() {
  "$slurm" stop "$work/slurm" >/dev/null || true
  rm -rf "$work"
}
trap finish EXIT
die() { echo "FAILED: $*"; exit 1; }
"$slurm" start "$work/slurm" 2 >"$work/start.log" || { code=$?; cat "$work/start.log"; exit $code; }
export SLURM_CONF=$work/slurm/slurm.conf
cd "$work"

"$binary" simulate "$source/testdata/one_sensor.yaml" -o data --quiet
mkdir long
python3 - "$frames" <<'PYTHON'
import os, sys
with open("travel.csv", "w") as travel:
    travel.write("frame,travel_mm\n")
    for i in range(int(sys.argv[1])):
        os.link(f"data/scan/solo/000{i % 4}.png", f"long/{i}.png")
        travel.write(f"{i},{0.5 * i}\n")
PYTHON
printf "rig: data/truth/rig.yaml\nframes: {solo: 'long/*.png'}\ntravel: {file: travel.csv}\n" >scan.yaml

# The same frames as one run, on the same node by the same number of cores as all tasks together.
start=$(date +%s%N)
"$binary" reconstruct scan.yaml -o whole.ply --profiles whole.csv --quiet --threads 2
milliseconds=$((($(date +%s%N) - start) / 1000000))

"$night" scan.yaml -o cloud.ply --profiles cloud.csv --parts "$parts" --cores 1 --binary "$binary" --dry-run >dry.txt
grep -q "^#SBATCH --array=0-$((parts - 1))$" dry.txt || die "the dry run prints no array: $(cat dry.txt)"
[ ! -e cloud.night ] || die "the dry run leaves a folder"

# A part that cannot succeed: retried, named, and the others are kept.
cat >broken <<BROKEN
#!/bin/bash
case "\$*" in *--frames\ 0:*) echo "error: disk: is away; wait" >&2; exit 1 ;; esac
exec "$binary" "\$@"
BROKEN
chmod +x broken
if [ "$frames" -le 1000 ]; then
  "$night" scan.yaml -o cloud.ply --profiles cloud.csv --parts "$parts" --cores 1 --binary "$work/broken" --wait >broken.txt && die "a broken part was taken for done"
  grep -q "frames_0_$((frames / parts)): failed, 0 of $((frames / parts)) frames: error: disk: is away; wait" broken.txt ||
    die "the failed part is not named: $(cat broken.txt)"
  grep -q "$((parts - 1)) of $parts parts are complete, not merged yet" broken.txt || die "wrong count: $(cat broken.txt)"
  [ ! -e cloud.ply ] || die "an incomplete night was merged"
  # Another number of parts for what is left.
  "$night" scan.yaml -o cloud.ply --profiles cloud.csv --parts 2 --cores 1 --binary "$binary" --wait >second.txt || die "$(cat second.txt)"
  cmp cloud.ply whole.ply && cmp cloud.csv whole.csv || die "the second submission gives other bytes"
  rm -r cloud.ply cloud.csv cloud.night
fi

"$night" scan.yaml -o cloud.ply --profiles cloud.csv --parts "$parts" --cores 1 --binary "$binary" >submitted.txt
killed=0
while [ "$killed" -lt "$kills" ] && [ -n "$(squeue -h -n night)" ]; do
  sleep "$((RANDOM % (frames / 25000 + 1))).$((RANDOM % 9 + 1))"
  mapfile -t running < <(pgrep -f "^$binary reconstruct $work/scan.yaml" || true)
  [ ${#running[@]} -gt 0 ] || continue
  kill -KILL "${running[RANDOM % ${#running[@]}]}" 2>/dev/null && killed=$((killed + 1))
  [ "$killed" != 1 ] || "$slurm" restart-node "$work/slurm"
done
# Each question takes Slurm and this node 50 ms: seldom where the rate is looked at.
for _ in $(seq 3000); do [ -n "$(squeue -h)" ] || break; sleep "$((frames / 50000)).2"; done
"$night" -o cloud.ply --status >status.txt || die "not complete: $(cat status.txt cloud.night/log/*)"
cat status.txt
cmp cloud.ply whole.ply && cmp cloud.csv whole.csv || die "other bytes than one run"
"$night" scan.yaml -o cloud.ply --binary "$binary" 2>again.txt && die "a complete night was begun anew"
grep -q "is complete and merged; remove" again.txt || die "$(cat again.txt)"
echo "$killed runs killed, one restart of slurmd; bytes equal; one run by two cores: $((frames * 1000 / milliseconds)) frames/s"
