#!/bin/bash
# Makes the pages of all shipped models, studies, comparisons, records and links, and opens them in headless Chromium:
# console, requests, width, weight, charts (browser.mjs). Pictures and PDFs of them go to FOLDER/pictures.
#
#     crates/report/tests/pages.sh [FOLDER] [PROGRAM]
#
# FOLDER: target/pages by default; pages that are there are made again. PROGRAM: target/release/trilith.
set -euo pipefail
cd "$(dirname "$0")/../../.."
folder=${1:-target/pages}
program=${2:-target/release/trilith}
mkdir -p "$folder"
# A run may end with status 1 and still leave a page: one that did not converge is a page as well.
make() { echo "trilith $*"; "$program" "$@" > "$folder/last.txt" || echo "  status $?"; }

for model in models/*.ron; do
  make run "$model" --out "$folder/run/$(basename "$model" .ron)"
done
for study in models/studies/*.ron; do
  make sweep "$study" --out "$folder/study/$(basename "$study" .ron)"
done
make compare models/pounding_frames.ron --no-cause --out "$folder/compare/pounding_frames"
make compare models/rigid_block.ron --no-cause --out "$folder/compare/rigid_block"
make record models/records/synthetic_1.csv --unit g --damping 0.02,0.05 --out "$folder/record/synthetic_1"
make elements --page "$folder/catalogue.html"
for page in target/validation/report.html target/benchmark/report.html; do
  if [ -e "$page" ]; then cp "$page" "$folder/$(basename "$(dirname "$page")").html"; fi
done
# Validation holds the figures of some two hundred cases.
find "$folder" -name '*.html' -print0 | sort -z | xargs -0 node crates/report/tests/browser.mjs --out "$folder/pictures"
