# A ball that bounces: rasp accuracy says until when samples mean anything, and compares statistics after.
# Long: see tests/run.sh.
[ -z "${SANITIZED:-}" ] || { echo "too long under sanitizers, where cli/accuracy is run"; exit 77; }
mkdir tmp
export TMPDIR=$PWD/tmp
. "$ROOT/tests/cli/accuracy-make.inc"
rasp accuracy drop.yaml --runs 1 --knobs --excerpt=1s --csv drop.csv > table
awk -F, '
    NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }
    $1 == "asked" { asked++; refused += $at["exit_code"] == 65; next }
    { until = $at["diverges_s"]; rows++ }
    until <= 0.02 || until >= 0.25 { print "diverges when it falls, or never: " $0 }
    $at["contact_share"] <= 0 || $at["contact_share"] >= 1 { print "no share of contact: " $0 }
    $at["below_reference"] != 0 || $at["reference_snr_db"] != "inf" { print "an error of the reference is told, which nobody knows: " $0 }
    $1 == "preset" && $at["predicted_db"] != "" { print "an error is predicted of what diverges: " $0 }
    $1 == "preset" && $2 == "high" { print "high follows until it diverges:", ($at["follows_s"] <= until + 0.05 ? "yes" : "no"), ($at["third_octave_db"] > 0 && $at["spectral_db"] > 0 && $at["level_db"] != 0 ? "and has statistics" : "") }
    $1 == "preset" && $2 == "reference" { print "reference follows itself to the end:", ($at["follows_s"] > until ? "yes" : "no") }
    END { print "no error can be had of " refused " in " asked; print (rows > 8 ? "knobs too" : "no knobs") }' drop.csv
grep -o 'It is chaotic: from' table
grep -Eo 'level +follows +contact' table | tr -s ' '
ls tmp
# The render says so, too, and its measured error what it is worth.
rasp render drop.yaml -o x.wav --verify | grep -o 'renders of it diverge\|part: what can be compared are statistics'
