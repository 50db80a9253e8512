# The schema of scenes: it is one; every scene that ships, every starter, the reference scene and every effective scene are valid by it; a scene with one wrong key,
# word, unit, list or number is not, and rasp check refuses that one too. Designs that ship are valid by theirs.
python3 -c 'import jsonschema, yaml' 2> /dev/null || { echo "python3-jsonschema and python3-yaml are not installed"; exit 77; }
rasp explain --schema=scene > scene.json
rasp explain --schema=design > design.json
mkdir starters effective mutants
rasp new --list | while read -r name _; do rasp new "$name" -o "starters/$name.yaml"; done
rasp explain > starters/reference.yaml
for scene in "$ROOT"/scenes/*.yaml; do rasp explain "$scene" > "effective/${scene##*/}"; done
printf '%s\n' 'rasp-design: 1' 'base: a.yaml' 'factors: {motion.rate: [1 Hz, 2 Hz, 3 Hz], scraper.mass: [10 g, 20 g]}' 'exclude: [{motion.rate: [1 Hz, 3 Hz], scraper.mass: 10 g}]' > starters/excluding.yaml
cat > validate.py <<'X'
import copy, glob, json, os, re
import jsonschema, yaml

root = os.environ["ROOT"]
validators = {}
for name in "scene", "design":
    schema = json.load(open(name + ".json"))
    jsonschema.Draft202012Validator.check_schema(schema)
    validators[name] = jsonschema.Draft202012Validator(schema)

def read(file):
    return yaml.load(open(file), Loader=getattr(yaml, "CSafeLoader", yaml.SafeLoader))

def errors(scene):
    kind = "design" if "rasp-design" in scene else "scene"
    return kind, ["/".join(map(str, e.absolute_path)) + ": " + e.message[:150] for e in validators[kind].iter_errors(scene)]

count = {"scene": 0, "design": 0}
for file in glob.glob(root + "/scenes/**/*.yaml", recursive=True) + glob.glob(root + "/tests/effects/*.yaml") + glob.glob("starters/*") + glob.glob("effective/*"):
    kind, wrong = errors(read(file))
    count[kind] += 1
    for line in wrong:
        print(file, line)
print("scenes:", "some hundred" if count["scene"] > 100 else count["scene"])
if glob.glob(root + "/scenes/designs/*.yaml") and not count["design"]:
    print("no designs were tried")

# The keys of designs are those that the reader has.
reader = re.search(r"keys\[\] = \{(.*?),\s*NULL\}", open(root + "/src/batch/design.c").read(), re.S).group(1)
differ = set(re.findall(r'"([^"]+)"', reader)) ^ set(validators["design"].schema["properties"])
if differ:
    print("keys of designs that the schema or the reader lacks:", differ)

# What is likely to be wrong in designs, and what looks so and is right.
for wrong, part in (True, {"factors": {"motion.raet": [1]}}), (True, {"factors": {"kind": [{"label": "a", "of": "cells"}]}}), (True, {"recordings": [{"fil": "x.wav"}]}), \
                   (True, {"factors": {"a b": [1]}}), (False, {"factors": {"kind": [{"label": "a", "of": "recordings"}], "contacts.rod.motion.rate": [1], "accuracy": ["draft"]}, "recordings": [{"file": "x", "kind": "a"}]}):
    if bool(errors({"rasp-design": 1, "base": "a.yaml"} | part)[1]) != wrong:
        print("the schema of designs", "takes" if wrong else "refuses", part)

# One thing wrong at a time, at every place of these scenes.
def places(node, path=()):
    yield path, node
    for key, value in node.items() if isinstance(node, dict) else enumerate(node) if isinstance(node, list) else ():
        yield from places(value, path + (key,))

def at(node, path):
    for key in path:
        node = node[key]
    return node

def mutants(scene):
    for path, node in places(scene):
        if isinstance(node, dict) and path[:1] != ("inputs",):
            yield path + ("nonsense",), 1
        elif isinstance(node, str) and path[-1] not in ("title", "file", "name", "recipe", "height_map", "response", "sha256") and path[0] != "include":
            yield path, "no word" if path[-1] == "material" else "nonsense" # a material may be one of the scene's own
            if node[0].isdigit():
                yield path, node.split()[0] + " furlongs"
        elif isinstance(node, (int, float)):
            yield path, "nonsense"
        elif isinstance(node, list) and node and path[-1] not in ("contacts", "include", "inputs"):
            yield path, "nonsense"
            yield path, []

tried = 0
for name in "basswood_scrape", "two_contacts", "roll", "rolling_impacts", "scribble":
    scene = read(f"{root}/scenes/{name}.yaml")
    for path, value in mutants(scene):
        mutant = copy.deepcopy(scene)
        at(mutant, path[:-1])[path[-1]] = value
        tried += 1
        if not errors(mutant)[1]:
            print(f"{name}: the schema takes {path}: {value}")
        yaml.safe_dump(mutant, open(f"mutants/{tried}.yaml", "w"), sort_keys=False)
print("mutants:", "more than 100" if tried > 100 else tried)
X
python3 validate.py
sed -i 's|: \.\./|: ROOT_/|' mutants/*.yaml
sed -i "s|ROOT_/|$ROOT/|" mutants/*.yaml
good=$({ rasp check --json mutants/*.yaml 2> err || true; } | python3 -c 'import json, sys; print(*(o["file"] for o in json.load(sys.stdin) if o["ok"]))')
[ -z "$good" ] || echo "rasp check takes what the schema refuses: $good"
