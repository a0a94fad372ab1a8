#!/usr/bin/env bash
# Whether many recordings come out the same, to the byte, however they are calibrated: by one process, by shards side by side,
# by Ray (where it is installed), and by a run that is killed three times and goes on.
#
#   examples/batch/check.sh EYEBOLT FOLDER [COUNT]     the program, where all goes, and how many recordings are simulated (200)
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
eyebolt=$(realpath "${1:?"name the program"}")
folder=${2:?"name a folder"}
count=${3:-200}
python=${PYTHON:-python3}

mkdir -p "$folder/recordings"
folder=$(realpath "$folder")
cd "$folder"
simulate() {
    local recording="recordings/$1.mcap"
    [[ -e "$recording" ]] || "$eyebolt" simulate -o "$recording" --seed "$1" --configurations 4 --frames 2 --moving-frames 0 --backgrounds 0 --threads 1 >/dev/null
}
export -f simulate
export eyebolt
seq 1 "$count" | xargs -P "$(nproc)" -I{} bash -c 'simulate {}'
seq -f "$folder/recordings/%g.mcap" 1 "$count" >list.txt
rm -rf calibrated
mkdir calibrated
cd calibrated

echo "one process"
"$eyebolt" batch --list ../list.txt -o serially >/dev/null
echo "five shards side by side"
seq 0 4 | xargs -P 5 -I{} "$eyebolt" batch --list ../list.txt -o sharded --shard {}/5 --threads 1 >/dev/null
if "$python" -c 'import ray' 2>/dev/null; then
    echo "Ray"
    PATH="$(dirname "$eyebolt"):$PATH" "$python" "$here/ray_batch.py" ../list.txt ray --shards 5 >/dev/null
else
    echo "SKIPPED: no Ray to calibrate with"
fi
for done in $((count / 5)) $((count / 2)) $((count * 4 / 5)); do
    "$eyebolt" batch --list ../list.txt -o killed >/dev/null &
    run=$!
    until (($(find killed/lines -name '*.json' 2>/dev/null | wc -l) >= done)) || ! kill -0 "$run"; do sleep 0.05; done
    kill -KILL "$run" || { echo "it had ended before it was killed: more recordings take longer" && exit 1; }
    wait "$run" 2>/dev/null || true
    echo "killed with $(find killed/lines -name '*.json' | wc -l) of $count done"
done
"$eyebolt" batch --list ../list.txt -o killed >/dev/null
others=(sharded killed)
[[ ! -d ray ]] || others+=(ray)
for other in "${others[@]}"; do
    # What a killed run was writing.
    diff -r --exclude '.tmp*' serially "$other"
done
echo "all $count the same (${others[*]}): $(find serially -type f | wc -l) files"
