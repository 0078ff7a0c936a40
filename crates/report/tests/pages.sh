#!/bin/bash
# Makes the pages of all shipped models, studies, comparisons, records and links, and opens them in headless Chromium:
# console, requests, width, weight, charts (browser.mjs). Pictures and PDFs of them go to FOLDER/pictures, pages of paper
# beside them as PNG where there is pdftoppm. With AXE, axe-core looks for what keeps readers from them (axe.mjs).
#
#     crates/report/tests/pages.sh [FOLDER] [PROGRAM]
#
# FOLDER: target/pages by default; pages that are there are made again. PROGRAM: target/release/trilith.
# AXE: path of axe.min.js, from `npm install axe-core` in a folder elsewhere.
# ONLY: part of a name; only such models, studies and comparisons.
set -euo pipefail
cd "$(dirname "$0")/../../.."
folder=${1:-target/pages}
program=${2:-target/release/trilith}
only=${ONLY:-}
mkdir -p "$folder"
# A run may end with status 1 and still leave a page: one that did not converge is a page as well.
make() { [[ "$*" == *"$only"* ]] || return 0; echo "trilith $*"; "$program" "$@" > "$folder/last.txt" || echo "  status $?"; }

for model in models/*.ron; do
  make run "$model" --out "$folder/run/$(basename "$model" .ron)"
done
for study in models/studies/*.ron; do
  make sweep "$study" --out "$folder/study/$(basename "$study" .ron)"
done
# A building whose storeys are one superelement.
make reduce models/isolated_building.ron --part 'column*,beam x*,beam y*,floor*,mass*' --keep 'centre 6' --modes 30 --out "$folder/reduced"
if [ -e "$folder/reduced/model.ron" ]; then make run "$folder/reduced/model.ron" --out "$folder/run/reduced_building"; fi
make compare models/pounding_frames.ron --no-cause --out "$folder/compare/pounding_frames"
make compare models/rigid_block.ron --no-cause --out "$folder/compare/rigid_block"
make record models/records/synthetic_1.csv --unit g --damping 0.02,0.05 --out "$folder/record/synthetic_1"
make elements --page "$folder/catalogue.html"
# A model of 10⁵ equations; how fast it moves is told by frames.mjs.
make generate frame --preset P1e5 --out "$folder/P1e5.ron"
if [ -e "$folder/P1e5.ron" ]; then make run "$folder/P1e5.ron" --out "$folder/large/P1e5"; fi
# Pages with the engine in them, where it is built.
if make view models/rigid_block.ron --out "$folder/view_block.html" 2>/dev/null; then
  make view models/isolated_frame.ron --out "$folder/view_frame.html"
  make view models/studies/mode_chart.ron --runs "$folder/study/mode_chart" --out "$folder/view_chart.html"
fi
for page in target/validation/report.html target/benchmark/report.html; do
  if [ -e "$page" ]; then cp "$page" "$folder/$(basename "$(dirname "$page")").html"; fi
done
pages() { find "$folder" -name '*.html' "$@" -print0 | sort -z; }
# Validation holds the figures of some two hundred cases.
pages -not -name 'view_*' | xargs -0 node crates/report/tests/browser.mjs --out "$folder/pictures" || failed=1
if [ -e "$folder/large/P1e5/report.html" ]; then node crates/report/tests/frames.mjs "$folder/large/P1e5/report.html" || failed=1; fi
if [ -n "${AXE:-}" ]; then pages | xargs -0 node crates/report/tests/axe.mjs --axe "$AXE" || failed=1; fi
if command -v pdftoppm > /dev/null; then
  for paper in "$folder"/pictures/*.pdf; do pdftoppm -r 60 -png "$paper" "${paper%.pdf}-paper"; done
fi
exit "${failed:-0}"
