# The tables that webMUSHRA's service writes (their columns are tried here, not its code) say the same as those of the page without library.
# shellcheck disable=SC1091
. "$ROOT/tests/cli/export-make.inc"
sed 's/anchors/training: 1, anchors/' rate.yaml > trained.yaml
sed 's/reference: [^ ]* real}], //' rate.yaml > likert.yaml
ln -s set_rate set_trained && ln -s set_rate set_likert
cat > listen.py << 'END'
# What listeners answer: by a number of the listener, the trial and the sound. listen.py DESIGN: DESIGN.csv as webMUSHRA's, DESIGN.page.csv as the page's.
import csv, glob, json, re, sys, yaml
design = sys.argv[1]
number = lambda *of: sum(sum(map(ord, o)) for o in of) * 7 % 5
rows, kind = [], None
for f in sorted(glob.glob(f"{design}.mushra/configs/*.yaml")):
    c = yaml.safe_load(open(f, encoding="utf-8"))
    for p in c["pages"]:
        for sound in ["reference"] * ("reference" in p) + list(p.get("stimuli", ())):
            path = p["reference"] if sound == "reference" else p["stimuli"][sound]
            n = number(c["testId"][-2:], p["id"].replace("training_", ""), path.split("/")[-1])
            if p["type"] == "mushra": rows.append([c["testId"], "44", "an-uuid", p["id"], sound, 25 * n, 12345, ""])
            else:
                answer = p["response"][n % len(p["response"])]["value"]
                blank = " " * (p["type"] == "likert_multi_stimulus")
                rows.append([c["testId"], "44", p["id"], blank + answer + blank, sound, 12345])
            kind = p["type"]
head = ["session_test_id", "age"]
head += ["session_uuid", "trial_id", "rating_stimulus", "rating_score", "rating_time", "rating_comment"] if kind == "mushra" else ["trial_id", "stimuli_rating", "stimuli", "rating_time"]
csv.writer(open(design + ".csv", "w"), lineterminator="\n").writerows([head] + rows)
rows = []
for f in sorted(glob.glob(f"{design}.page/lists/*.js")):
    s = json.loads(re.fullmatch(r"study = (.*);\n", open(f).read(), re.S)[1])
    for t in s["trials"]:
        for sound in t["sounds"]:
            n = number(s["participant"][-2:], t["trial_id"], sound["file"].split("/")[-1])
            first = dict(participant=f"{design}_" + s["participant"], trial_id=t["trial_id"], training=t["training"], stimulus_id=sound["stimulus_id"], role=sound["role"], **sound["levels"])
            rows.append(first | (dict(rating=25 * n) if s["task"] == "rate" else dict(played=t["played"], chosen=s["answers"][n % len(s["answers"])]["label"])))
w = csv.DictWriter(open(design + ".page.csv", "w"), list(rows[0]), lineterminator="\n")
w.writeheader()
w.writerows(rows)
END
for design in rate trained likert choose; do
    action=ratings also=()
    [ $design = choose ] && action=choices also=(--column condition=role)
    rasp export $design.yaml set_$design --for webmushra -o $design.mushra -p 4 > /dev/null
    rasp export $design.yaml set_$design --for page -o $design.page -p 4 > /dev/null
    python3 listen.py $design
    rasp judge $action $design.csv --design $design.yaml "${also[@]}" > webmushra.txt 2>&1 || true
    rasp judge $action $design.page.csv "${also[@]}" > page.txt 2>&1 || true
    echo "-- $design"
    diff webmushra.txt <(sed "s/$design.page.csv/$design.csv/" page.txt)
    head -n 6 webmushra.txt
done
try() { rasp judge "$@" 2>&1 || echo "exit code $?"; }
try ratings rate.csv
try ratings rate.csv --design choose.yaml
try ratings rate.csv --design stroke.yaml
sed 's/rating_score/score/' rate.csv > broken.csv && try ratings broken.csv --design rate.yaml
# what webMUSHRA would lose on its way is refused
printf '%s\n' 'trials: {task: choose, answers: [wood & bark, "it'"'"'s metal"], question: Which?}' > lost.txt
(sed '/^trials/d' choose.yaml && cat lost.txt) > lost.yaml
ln -s set_choose set_lost
rasp export lost.yaml set_lost --for webmushra -o out 2>&1 || echo "exit code $?"
ls out 2> /dev/null || true
