#!/usr/bin/env bash
# The results of a campaign do not depend on how it is run: on threads, shards, kills and resumes.
#
#   tests/campaigns/same_bytes.sh [RUNS]      (cotama on the PATH, or COTAMA=path)
#
# For the patrol and the delivery: 1, 2 and 4 threads; 3 and 7 shards merged; three kills (-9) and
# resumes. Says the processor time of one thread, and runs a second of it.
set -euo pipefail
runs=${1:-100000}
cotama=${COTAMA:-cotama}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

# Exit code 1 says that a requirement is broken, which is no error here.
campaign() { "$cotama" campaign "$@" --shrink 0 >/dev/null 2>&1 || [ $? = 1 ]; }
same() {
    for file in runs.jsonl runs.sums campaign.json; do cmp "$1/$file" "$2/$file"; done
}

for mission in patrol delivery; do
    TIMEFORMAT=%U
    seconds=$({ time campaign "$mission" --runs "$runs" --jobs 1 --out "$mission-1"; } 2>&1)
    awk -v m="$mission" -v n="$runs" -v s="$seconds" \
        'BEGIN { printf "%s: %d runs in %.1f s of processor time: %d a second and core\n", m, n, s, n / s }'
    for jobs in 2 4; do
        campaign "$mission" --runs "$runs" --jobs "$jobs" --out "$mission-j$jobs"
        same "$mission-1" "$mission-j$jobs"
        echo "$mission: $jobs threads, the same bytes"
    done
    for shards in 3 7; do
        parts=()
        for ((i = 1; i <= shards; i++)); do
            campaign "$mission" --runs "$runs" --shard "$i/$shards" --out "$mission-$i-of-$shards"
            parts+=("$mission-$i-of-$shards")
        done
        campaign merge "${parts[@]}" --out "$mission-s$shards"
        same "$mission-1" "$mission-s$shards"
        echo "$mission: $shards shards merged, the same bytes"
    done
    kills=0
    for part in 2 5 8; do
        "$cotama" campaign "$mission" --runs "$runs" --jobs 2 --shrink 0 --out "$mission-k" \
            >/dev/null 2>&1 &
        lines=0
        while kill -0 $! 2>/dev/null && [ "$lines" -lt $((runs * part / 10)) ]; do
            sleep 0.05
            lines=$(cat "$mission-k/runs.jsonl" 2>/dev/null | wc -l)
        done
        kill -9 $! 2>/dev/null && kills=$((kills + 1))
        wait $! 2>/dev/null || true
        # As if the last line had been torn.
        [ ! -s "$mission-k/runs.jsonl" ] || truncate -s -5 "$mission-k/runs.jsonl"
        echo "$mission: killed at $(wc -l <"$mission-k/runs.jsonl") of $runs lines"
    done
    campaign "$mission" --runs "$runs" --jobs 2 --out "$mission-k"
    same "$mission-1" "$mission-k"
    echo "$mission: $kills kills and resumes, the same bytes"
    "$cotama" campaign "$mission" --runs "$runs" --shrink 0 --out "$mission-1" --json |
        grep '"digest"' || true
done
