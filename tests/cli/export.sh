# A set as each format: counts and files, the rules of each reader, one list of trials in all of them, the same bytes again, whole or not at all.
# shellcheck disable=SC1091
command -v python3 > /dev/null || { echo "no python3"; exit 77; }
python3 -c 'import yaml' 2> /dev/null || { echo "no python3-yaml"; exit 77; }
. "$ROOT/tests/cli/export-make.inc"
cat > check.py << 'END'
import csv, glob, hashlib, json, os, re, sys, wave, yaml
folder, form, design = sys.argv[1:]
at = lambda *parts: os.path.join(folder, *parts)
read = lambda name: open(at(name), encoding="utf-8", newline="").read()
manifest = {r["stimulus_id"]: r for r in csv.DictReader(open(f"set_{design}/manifest.csv", encoding="utf-8"))}
files = sorted(os.path.relpath(os.path.join(d, f), folder) for d, _, fs in os.walk(folder) for f in fs)
sums = dict(reversed(l.split("  ")) for l in read("SHA256SUMS").splitlines()[1:])
assert sorted(sums) + ["SHA256SUMS"] == sorted(sums) + [f for f in files if f not in sums], files
assert all(hashlib.sha256(open(at(f), "rb").read()).hexdigest() == h for f, h in sums.items())

# The table of the sounds: every column of the manifest, its sounds beside it, seeds as text.
def sounds(table, delimiter=","):
    rows = list(csv.DictReader(open(at(table), encoding="utf-8"), delimiter=delimiter, quoting=csv.QUOTE_NONE if delimiter == "\t" else csv.QUOTE_MINIMAL))
    name = "stim_file" if delimiter == "\t" else "file_name"
    side = json.load(open(at(os.path.splitext(table)[0] + ".json")))
    assert list(side) and set(side) == set(rows[0]), set(side) ^ set(rows[0])
    for r in rows:
        m = manifest[r["stimulus_id"]]
        path = os.path.join(os.path.dirname(table), r[name])
        assert open(at(path), "rb").read() == open(f"set_{design}/{m['file_name']}", "rb").read()
        assert r["seed"] == ("n/a" if m["seed"] == "n/a" else "s" + m["seed"])
        assert all(r[k] == v for k, v in m.items() if k not in ("file_name", "seed"))
    return rows

# What a trial is, in any format: training, its sounds in order.
def lists():
    found = {}
    for f in files:
        if form in ("jspsych", "page") and f.startswith("lists/"):
            study = json.loads(read(f)[len("study = "):-2])
            found[f[6:-3]] = [(t["training"], [s["stimulus_id"] for s in t["sounds"]], t["text"], t["played"]) for t in study["trials"]]
            assert all(os.path.exists(at(s["file"])) for t in study["trials"] for s in t["sounds"])
        elif form == "psychopy" and f.startswith("conditions") or form == "bids" and f.endswith("_beh.tsv"):
            rows = table(f, "\t" if form == "bids" else ",")
            sitting = re.search(r"sub-(\d+)(?:_ses-(\d+))?", os.path.basename(f)) if form == "bids" else re.search(r"p(\d+)(?:_s(\d+))?", os.path.basename(f))
            name = "p" + sitting[1] + ("_s" + sitting[2] if sitting[2] else "")
            n = sum(k.startswith("stimulus_") for k in rows[0])
            none = lambda v: None if v == "n/a" else v
            found[name] = [(int(r["training"]), [r[f"stimulus_{k + 1}"] for k in range(n)], none(r["text"]), none(r["played"])) for r in rows]
    return found

def table(f, delimiter):
    text = read(f)
    assert text.endswith("\n") and "\r" not in text
    rows = list(csv.DictReader(text.splitlines(), delimiter=delimiter, quoting=csv.QUOTE_NONE if delimiter == "\t" else csv.QUOTE_MINIMAL))
    for r in rows:
        assert None not in r and all(v for v in r.values()), r
        for k, v in r.items():
            assert re.fullmatch("[a-z][a-z0-9_]*", k), k
            # PsychoPy (data/utils.py): names of variables; texts must not become numbers or be computed
            if k not in ("trial", "block", "training"):
                assert not re.fullmatch(r"[-+]?[0-9.,]+(e[-+]?\d+)?|\[.*\]", v), v
            if re.fullmatch(r"file_\d+", k):
                assert os.path.exists(at(v)), v
            if re.fullmatch(r"stim_file_\d+", k): # BIDS: below stimuli/, of these letters
                assert re.fullmatch(r"[0-9A-Za-z+/_.-]+", v) and os.path.exists(at("stimuli", v)), v
    return rows

if form == "webmushra":
    keys = {"generic": {"id", "name", "content"}, "finish": {"name", "content", "popupContent", "showResults", "writeResults"},
            "mushra": {"id", "name", "content", "showWaveform", "enableLooping", "strict", "reference", "createAnchor35", "createAnchor70", "randomize", "showConditionNames", "switchBack", "stimuli"},
            "likert_multi_stimulus": {"id", "name", "content", "mustRate", "mustPlayback", "stimuli", "response"},
            "likert_single_stimulus": {"id", "name", "content", "mustRate", "mustPlayback", "stimuli", "response"}}
    for f in files:
        if not f.endswith(".yaml"): continue
        text = read(f)
        assert "\\" not in re.sub(r"\\[\"\\]", "", text) # yaml.js takes no other escape as it should
        c = yaml.safe_load(text)
        assert set(c) == {"testname", "testId", "bufferSize", "stopOnErrors", "showButtonPreviousPage", "remoteService", "language", "pages"}
        assert c["bufferSize"] in (256, 512, 1024, 2048, 4096, 8192, 16384) and re.fullmatch(r"[\w-]+", c["testId"])
        assert [p["type"] for p in c["pages"]].index("finish") == len(c["pages"]) - 1
        for p in c["pages"]:
            assert set(p) - {"type"} == keys[p["type"]], p
            paths = list(p.get("stimuli", {}).values()) + [p[k] for k in ("reference",) if k in p]
            assert all(os.path.exists(at(v)) for v in paths)
            if "reference" in p: # BS.1534: of one length; webMUSHRA adds the reference itself
                assert len({wave.open(at(v)).getnframes() for v in paths}) == 1 and p["reference"] not in p["stimuli"].values()
            assert "<" not in re.sub("</?(p|i)>", "", p["content"]), p["content"]
        print(f, c["testname"], [len(p.get("stimuli", ())) for p in c["pages"]])
    assert len(sounds(f"configs/resources/audio/{design}/stimuli.csv")) == len(manifest)
elif form == "audiofolder":
    tables = sorted(f for f in files if f.endswith("metadata.csv"))
    rows = [r for t in tables for r in sounds(t)]
    assert sorted(r["stimulus_id"] for r in rows) == sorted(manifest)
    assert all(os.path.dirname(t) in ("train", "validation", "test") for t in tables)
    assert sum(f.endswith(".wav") for f in files) == len(rows)
    print([(t, read(t).count("\n") - 1) for t in tables])
else:
    assert len(sounds("stimuli/stimuli.tsv", "\t") if form == "bids" else sounds("sounds/stimuli.csv")) == len(manifest)
    if form == "bids":
        d = json.load(open(at("dataset_description.json")))
        assert d["Name"] and re.fullmatch(r"\d+\.\d+\.\d+", d["BIDSVersion"])
        side = json.load(open(glob.glob(at("task-*_beh.json"))[0]))
        for f in (f for f in files if f.endswith("_beh.tsv")):
            s = re.fullmatch(r"(sub-\d+)/(?:(ses-\d+)/)?beh/(sub-\d+)(?:_(ses-\d+))?_task-([A-Za-z0-9]+)_beh.tsv", f)
            assert s and s[1] == s[3] and s[2] == s[4] and s[5] == side["TaskName"], f
            assert set(table(f, "\t")[0]) == set(side) - {"TaskName", "TaskDescription", "Instructions"}
        assert read("participants.tsv").split() == ["participant_id"] + sorted({f[:f.index("/")] for f in files if f.startswith("sub-")})
    found = lists()
    old = f"{design}.lists"
    if os.path.exists(old):
        assert json.load(open(old)) == json.loads(json.dumps(found)), "another list than in the format before"
    json.dump(found, open(old, "w"))
    for name, trials in sorted(found.items()):
        print(name, len(trials), "trials,", sum(t[0] for t in trials), "for training;", trials[0][1:])
END
export_as() { # DESIGN FORM OPTION...
    local design=$1 form=$2
    shift 2
    echo "-- $design for $form"
    rasp export $design.yaml set_$design --for $form -o $design.$form "$@"
    python3 check.py $design.$form $form $design
    rasp export ./$design.yaml set_$design/ -o again --for=$form "$@" > /dev/null # in the place of the one before
    diff -r $design.$form again
}
for design in rate choose compare; do
    for form in psychopy jspsych page bids; do export_as $design $form --participants 2; done
done
export_as rate webmushra -p 2
export_as choose webmushra -p 1
sed 's/reference: [^ ]* real}], //' rate.yaml > likert.yaml
ln -s set_rate set_likert
export_as likert webmushra
# training with a reference of its own
sed 's/anchors/training: [{speed: slow}], anchors/' rate.yaml > trained.yaml
ln -s set_rate set_trained
export_as trained webmushra
export_as trained psychopy
cut -d, -f4,5,16-18 trained.psychopy/conditions_p01.csv
echo 'splits: {train: 4, validation: 1, test: 1}' >> compare.yaml
rasp batch -q compare.yaml -o set_compare --no-render
export_as compare audiofolder
export_as rate audiofolder
echo "-- takes of a cell stay together"
(cat choose.yaml && printf '%s\n' 'replicates: 9' 'seed: 2' 'splits: {test: 1, train: 1}') > takes.yaml
rasp batch -q takes.yaml -o set_takes 2> /dev/null
export_as takes audiofolder
ls takes.audiofolder/*/*.wav | sed 's/_r[0-9].wav//' | sort | uniq -c
echo "-- a participant more changes nobody's order; another seed does"
rasp export compare.yaml set_compare --for page -o more -p 9 > more.txt
diff -r compare.page/lists/p01_s1.js more/lists/p01_s1.js && diff compare.page/lists/p02_s2.js more/lists/p02_s2.js
rasp export compare.yaml set_compare --for page -o other --seed 18446744073709551615 > more.txt
cmp -s compare.page/lists/p01_s1.js other/lists/p01_s1.js || echo "another seed, another order"
rm -r again more other
