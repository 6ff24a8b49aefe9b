#!/usr/bin/env bash
# Runs the harnesses of core and models with Kani itself; all inputs within their bounds.
#
#   tests/evidence/proofs/kani.sh [NAME...]    the harnesses whose names hold one of these
#
# Needs `cargo kani` and its bundle; docs/proofs.md says how both are installed, also offline. Those
# of verification build lists and texts, which a solver does not follow: they are not run here.
# KANI_SECONDS (default 300) is the limit of a harness. Exit status 1 when one fails.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../../.."
options=(--output-format terse -Z unstable-options --harness-timeout "${KANI_SECONDS:-300}s")
for name in "$@"; do options+=(--harness "$name"); done
for room in units nets executive allocation assignment; do
    cargo kani -p "cotama-$room" "${options[@]}"
done
cargo kani -p cotama-models --no-default-features "${options[@]}"
