# What an export is for plays it: the page by itself and jsPsych's own library, in headless Chromium, where a listener who is a program hears each sound to
# its end and answers; webMUSHRA's YAML in the parser that it bundles, and webMUSHRA itself where WEBMUSHRA names a folder with a copy of it.
# BIDS_VALIDATOR names bids-validator (npm, 700 MB) where it is to judge the folders for BIDS, too: no error, and of warnings those that are known.
# NODE_MODULES names a folder with what npm install jspsych ... gives; else it is fetched.
# shellcheck disable=SC1091
for browser in chromium chromium-browser google-chrome; do command -v $browser > /dev/null && break; browser=; done
[ -n "$browser" ] || { echo "no chromium"; exit 77; }
command -v node > /dev/null && command -v npm > /dev/null || { echo "no node, or no npm"; exit 77; }
. "$ROOT/tests/cli/export-make.inc"
answers() { timeout 120 node "$ROOT/tests/lib/browser.js" $browser "$1" "index.html?list=$2" | sed 's/,[0-9]*$//'; }
sed '/^trials/s/, within.*/, answers: [not at all, quite, exactly]}/' rate.yaml > single.yaml
ln -s set_rate set_single
lists=(rate:p01 single:p01 choose:p01 compare:p01_s2)
for of in "${lists[@]}"; do
    design=${of%:*}
    echo "-- $design, a page"
    rasp export $design.yaml set_$design --for page -o $design.page > /dev/null
    answers $design.page "${of#*:}"
done
rasp export choose.yaml set_choose --for jspsych -o choose.jspsych > /dev/null
modules=${NODE_MODULES:-}
if [ -z "$modules" ]; then
    mkdir npm && cp choose.jspsych/package.json npm/
    (cd npm && timeout 120 npm install --silent --no-audit --no-fund yamljs@0.3.0 > npm.log 2>&1) || { echo "jsPsych cannot be fetched by npm"; exit 77; }
    modules=$PWD/npm/node_modules
fi
for of in "${lists[@]}"; do
    design=${of%:*}
    rm -rf $design.jspsych
    rasp export $design.yaml set_$design --for jspsych -o $design.jspsych > /dev/null
    ln -s "$modules" $design.jspsych/node_modules
    answers $design.jspsych "${of#*:}" > $design.answers
    echo "-- $design, jsPsych: $(grep -c . $design.answers) rows, $(head -n 1 $design.answers)"
    cut -d, -f1-7 <(answers $design.page "${of#*:}") | diff - <(cut -d, -f1-7 $design.answers)
done
echo "-- webMUSHRA's YAML"
rasp export rate.yaml set_rate --for webmushra -o rate.mushra > /dev/null
NODE_PATH=$modules node -e 'console.log(JSON.stringify(require("yamljs").load("rate.mushra/configs/rate_p01.yaml")))' > read.json
python3 -c 'import json, yaml; a, b = json.load(open("read.json")), yaml.safe_load(open("rate.mushra/configs/rate_p01.yaml")); print(a == b, a["testname"], len(a["pages"]))'
if [ -n "${WEBMUSHRA:-}" ]; then
    # It loads the configuration, then every sound that the configuration names.
    cp -r "$WEBMUSHRA" mushra && cp -r rate.mushra/configs mushra/
    script='<script>addEventListener("load", () => setTimeout(() => fetch("/done", {method: "POST", body: document.title + "\n"}), 8000));</script>'
    timeout 120 node "$ROOT/tests/lib/browser.js" $browser mushra 'index.html?config=rate_p01.yaml' "$script" > mushra.txt
    diff mushra.txt <(echo 'Rating: "A & B" – π')
fi
if [ -n "${BIDS_VALIDATOR:-}" ]; then
    for of in "${lists[@]}"; do
        design=${of%:*}
        rasp export $design.yaml set_$design --for bids -o $design.bids -p 2 > /dev/null
        "$BIDS_VALIDATOR" $design.bids --json > bids.json 2> /dev/null
        python3 -c 'import json; i = json.load(open("bids.json"))["issues"]; k = {x["key"] for x in i["warnings"]} - {"UNUSED_STIMULUS", "NO_AUTHORS", "README_FILE_SMALL"}; assert not i["errors"] and not k, (i["errors"], k)'
    done
fi
