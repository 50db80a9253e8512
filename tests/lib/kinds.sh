# The kinds of tests: kind_KIND NAME runs one test in the empty folder it stands in and prints why it fails. Sourced by tests/run.sh.
# shellcheck shell=bash

kind_unit() {
    [ -x "$BUILD/unit" ] || { echo "not built: $BUILD/unit (make unit)"; return 1; }
    OPENBLAS_NUM_THREADS=1 "$BUILD/unit" "$1" # as rasp-modes sets it
}

kind_tidy() { bash "$ROOT/tests/tidy/$1.sh"; }
kind_faults() { bash "$ROOT/tests/faults/$1.sh"; }
kind_hard() { bash "$ROOT/tests/hard/$1.sh"; }
kind_bytes() { bash "$ROOT/tests/bytes/$1.sh"; }

# ------------------------------------------------------------------ cli: output, errors, exit code

kind_cli() {
    local part missed=0 base=$ROOT/tests/cli/$1 got
    got=$(mktemp -d "$SCRATCH/got.XXXXXXXX")
    cli_run "$1" "$got"
    [ "$(cat "$got/exit")" != 77 ] || { tail -n 1 "$got/out"; return 77; }
    for part in out err exit; do
        cli_expected "$base" $part | diff -u --label "expected $part" --label "$part" - "$got/$part" || missed=1
    done
    cli_left_over || missed=1
    return $missed
}

# Runs the case; out, err, exit go to folder $2, with the folders of this run named ROOT and TMP.
cli_run() {
    local code=0
    bash -eu -o pipefail "$ROOT/tests/cli/$1.sh" > "$2/out" 2> "$2/err" < /dev/null || code=$?
    sed -i -e "s|$PWD|TMP|g" -e "s|$ROOT|ROOT|g" "$2/out" "$2/err"
    echo $code > "$2/exit"
}

# What is not written down: no output, exit code 0.
cli_expected() {
    if [ -f "$1.$2" ]; then cat "$1.$2"; elif [ "$2" = exit ]; then echo 0; fi
}

cli_left_over() {
    local left
    left=$(find . -name '.*tmp*' -o -name '.rasp-*')
    [ -z "$left" ] || { echo "left behind:" $left; return 1; }
}

cli_set() {
    local part got base=$ROOT/tests/cli/$1
    got=$(mktemp -d "$SCRATCH/got.XXXXXXXX")
    cli_run "$1" "$got"
    for part in out err; do
        if [ -s "$got/$part" ]; then cp "$got/$part" "$base.$part"; else rm -f "$base.$part"; fi
    done
    if [ "$(cat "$got/exit")" = 0 ]; then rm -f "$base.exit"; else cp "$got/exit" "$base.exit"; fi
}

# ------------------------------------------------------------------ plans: what runs for each scene, and what does not

plan_of() { (cd "$ROOT" && rasp plan "scenes/$1.yaml"); }

kind_plans() {
    [ -f "$ROOT/tests/plans/$1.plan" ] || { echo "no tests/plans/$1.plan; tests/run.sh --set plans/$1 makes it"; return 1; }
    plan_of "$1" > plan || return
    diff -u --label "expected plan" --label plan "$ROOT/tests/plans/$1.plan" plan
}

plans_set() {
    mkdir -p "$ROOT/tests/plans"
    plan_of "$1" > plan && cp plan "$ROOT/tests/plans/$1.plan"
}

# ------------------------------------------------------------------ golden: the sound and the physics of each scene

# Kept: tests/golden/NAME/sound.wav, sound.csv and so on; the effective scene has to make the same.
kind_golden() { rasp golden check -q --effective -j 1 --kept "$ROOT/tests/golden" "$ROOT/scenes/$1.yaml"; }

golden_set() { rasp golden update -q -j 1 --kept "$ROOT/tests/golden" "$ROOT/scenes/$1.yaml"; }

# ------------------------------------------------------------------ docs: the examples of README and man pages are run

# With CI set README's twice in the same tree: who repeats it is not refused.
kind_docs() {
    local block n=0 blocks
    tree_copy tree
    mkdir blocks
    awk -v kind="${1##*.}" -f "$ROOT/tests/lib/examples.awk" "$ROOT/$1"
    blocks=(blocks/*)
    [ "$1" != README.md ] || [ -z "${CI:-}" ] || blocks+=(blocks/*)
    for block in "${blocks[@]}"; do
        n=$((n + 1))
        (cd tree && bash -e "../$block") > log 2>&1 && continue
        echo "example ${block#blocks/} of $1 fails:"
        sed 's/^/    /' "$block"
        tail -n 20 log
        return 1
    done
    [ $n -gt 0 ] || { echo "no examples in $1"; return 77; }
}

# The files of the tree an example may use or write beside; the built program is there too.
tree_copy() {
    local entry
    mkdir "$1"
    for entry in "$ROOT"/*; do
        case $entry in "$ROOT"/build* | "$ROOT"/out | "$BUILD") ;; *) cp -r "$entry" "$1/" ;; esac
    done
    ln -s "$BUILD" "$1/build"
}

# ------------------------------------------------------------------ --set

set_tests() {
    local test kind name folder
    SCRATCH=$(mktemp -d)
    for test; do
        kind=${test%%/*} name=${test#*/}
        declare -F "${kind}_set" > /dev/null || { echo "$test: only cli, plans and golden tests have expected files" >&2; return 64; }
        folder=$(mktemp -d "$SCRATCH/run.XXXXXXXX")
        (cd "$folder" && "${kind}_set" "$name") || { echo "$test: not set" >&2; return 1; }
    done
    rm -rf "$SCRATCH"
}
