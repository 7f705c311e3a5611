#!/bin/sh
# ./run golden-archive makes the same bytes twice, what is in it verifies by itself, and no link leads out of it. The runners
# refuse files that are unfit.
# $1: the project's folder.
set -eu
cd "$1"
links=$PWD/tests/house/links_test.py
archive=$(./run golden-archive)
first=$(sha256sum "$archive")
touch docs/golden.md # of another time
[ "$(./run golden-archive && sha256sum "$archive")" = "$archive
$first" ]
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
# Without git there is no list of what belongs there: status 1, and no file.
mkdir "$folder/tree" && cp -r run CMakeLists.txt packaging "$folder/tree"
! (cd "$folder/tree" && GIT_CEILING_DIRECTORIES="$folder" ./run golden-archive) 2>"$folder/said"
grep -q "run it in a clone" "$folder/said"
[ -z "$(ls "$folder/tree/build")" ]
tar -xzf "$archive" -C "$folder"
cd "$folder"/lorentz-golden-*
(cd data/golden && sha256sum --quiet -c SHA256SUMS)
python3 data/check.py data/golden/ties.ndjson data/golden/smoke/smoke.ndjson
python3 "$links" . 7
python3 docs/examples/golden/runner.py data/golden/smoke/smoke.ndjson data/golden/smoke/answers/15-digits.ndjson >verdicts
cut -f 1,4 data/golden/smoke/answers/verdicts.tsv | tail -n +2 | tr '\t' ' ' | diff - verdicts
test -f README.md && test -f docs/examples/golden/runner.py && test -f docs/golden.md && test -f LICENSE

set=data/golden/smoke/smoke.ndjson right=data/golden/smoke/answers/right.ndjson
head -n -1 $set >part
cat $right $right >twice
: >empty
refuses() { # $@: a runner
  for words in "part $right" "empty $right" ". $right" "$right $right" "$set ." "$set twice"; do
    bad=${words#"$set "} status=0
    "$@" $words >verdicts 2>said || status=$?
    [ $status -eq 2 ] && grep -q "^${bad% "$right"}:" said || { echo "$*, $words: $status, $(cat said)" && exit 1; }
  done
}
refuses python3 docs/examples/golden/runner.py
! command -v node >node || refuses node docs/examples/golden/runner.js
! cc docs/examples/golden/runner.c -lcjson -lm -o c-runner 2>said || refuses ./c-runner
! c++ docs/examples/golden/runner.cpp -o c++-runner 2>said || refuses ./c++-runner
