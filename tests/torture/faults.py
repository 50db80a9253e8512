"""Faults that are planted: in a scene's text, some of which must be told at their very line, and in the files that it
names."""
import os
import re

from keys import UNITS


def plant(scene):
    """One fault. scene.planted says what it is, scene.expected where it must be told (None: it may be told anywhere, or
    be none)."""
    rng = scene.rng
    files = [name for name in scene.files if (scene.folder / name).exists()]
    if files and rng.random() < 0.5:
        name = rng.choice(files)
        fault = rng.choice(FILE_FAULTS)
        scene.planted = f"file ({scene.files[name]}): {fault.__doc__}"
        return lambda: fault(rng, file_of(scene.folder / name))
    fault = rng.choice(TEXT_FAULTS)
    scene.planted = f"text: {fault.__doc__}"
    return lambda: fault(scene)


def file_of(path):
    """The file itself, or one of those in a folder of responses."""
    if path.is_dir() and not path.is_symlink():
        return sorted(path.iterdir())[-1]
    return path


# ------------------------------------------------------------------ text

def at_key(scene, want, text):
    """Gives a key of the scene another text, and says that this must be told there."""
    keys = [where for where in scene.lines if want(scene, where)]
    if not keys:
        scene.planted = "none fitted"
        return
    where = scene.rng.choice(sorted(keys))
    file, line = scene.lines[where]
    lines = scene.texts[file].split("\n")
    name = where.split(".")[-1]
    old = value_of(lines[line - 1], name)
    if old is None or len(re.findall(rf"\b{re.escape(name)}: ", lines[line - 1])) > 1:  # two of that name in one line
        scene.planted = "none fitted"
        return
    lines[line - 1] = lines[line - 1].replace(f"{name}: {old}", text(scene, where, name, old), 1)
    scene.texts[file] = "\n".join(lines)
    scene.expected = (file, line)


def value_of(line, name):
    """The scalar after `name:` in a line, in a block or within a flow map."""
    m = re.search(rf"(?:^|[ {{]){re.escape(name)}: (\"[^\"]*\"|\[[^\]]*\]|[^,}}\[{{]+?)(?=[,}}]|$)", line)
    return m and m[1]


def key_of(scene, where):
    """The key that stands at a place such as contacts.0.motion.rate."""
    parts = where.split(".")
    return scene.keys.all.get(".".join(parts[2:] if parts[0] == "contacts" else parts))


def has_range(scene, where):
    key = key_of(scene, where)
    return key and key.low is not None and key.numbers == 1 and not key.words and not key.type.startswith("list")


def has_unit(scene, where):
    key = key_of(scene, where)
    return has_range(scene, where) and UNITS.get(key.unit)


def out_of_range(scene):
    """out of range"""
    def text(scene, where, name, old):
        key = key_of(scene, where)
        beyond = [key.high * 1.01 + 1, key.low - abs(key.low) * 0.01 - 1e-12, 1e301, -1e301]
        return f"{name}: {scene.rng.choice(beyond[:1] + beyond[2:] if key.whole else beyond)!r}"
    at_key(scene, has_range, text)


def wrong_unit(scene):
    """wrong unit"""
    other = {"m": "s", "s": "m", "Hz": "m", "kg": "N", "N": "kg"}
    at_key(scene, has_unit,
        lambda scene, where, name, old: f"{name}: 1 {other.get(key_of(scene, where).unit, 'parsec')}")


NO_NUMBERS = ["many", ".nan", ".inf", "0x10", "1_000", "1,5", "true", "1e", "--1", "1 2"]


def no_number(scene):
    """no number"""
    at_key(scene, has_range,
        lambda scene, where, name, old: f"{name}: {scene.rng.choice(NO_NUMBERS)}")


def wrong_type(scene):
    """a list or a map for a number"""
    at_key(scene, has_range,
        lambda scene, where, name, old: f"{name}: {scene.rng.choice(['[1, 2]', '{a: 1}', '[[]]', '[]'])}")


def no_word(scene):
    """a word that is none"""
    at_key(scene, lambda s, w: key_of(s, w) and key_of(s, w).words,
        lambda scene, where, name, old: f"{name}: {scene.rng.choice([old + 'x', 'nothing', '7', '[]'])}")


def unknown_key(scene):
    """an unknown key"""
    at_key(scene, lambda s, w: key_of(s, w), lambda scene, where, name, old: f"{name}z: {old}")


def twice(scene):
    """a key given twice"""
    tops = [w for w in scene.lines if "." not in w and w != "contacts"]
    where = scene.rng.choice(sorted(tops))
    file = scene.lines[where][0]
    scene.texts[file] += f"{where}: 1\n"
    scene.expected = (file, scene.texts[file].count("\n"))


def tab(scene):
    """a tab that indents"""
    lines = scene.texts["scene.yaml"].split("\n")
    inner = [i for i, text in enumerate(lines) if text.startswith("  ")]
    if inner:
        i = scene.rng.choice(inner)
        lines[i] = "\t" + lines[i].lstrip(" ")
        scene.texts["scene.yaml"] = "\n".join(lines)


def bytes_of(change):
    def fault(scene):
        data = change(scene.rng, bytearray(scene.texts["scene.yaml"].encode()))
        scene.texts["scene.yaml"] = bytes(data)
    fault.__doc__ = change.__doc__
    return fault


@bytes_of
def byte(rng, data):
    """a random byte"""
    for _ in range(rng.choice([1, 1, 1, 5])):
        data[rng.randrange(len(data))] = rng.randrange(256)
    return data


@bytes_of
def cut(rng, data):
    """cut off"""
    return data[:rng.randrange(len(data))]


@bytes_of
def deep(rng, data):
    """deep nesting"""
    n = rng.choice([60, 1000, 100000])
    return data + b"title: " + b"[" * n + b"]" * n + b"\n"


@bytes_of
def line_gone(rng, data):
    """a line taken out"""
    lines = data.split(b"\n")
    del lines[rng.randrange(len(lines))]
    return b"\n".join(lines)


@bytes_of
def odd_ends(rng, data):
    """ends of line of another system, or a mark of byte order"""
    return rng.choice([data.replace(b"\n", b"\r\n"), b"\xef\xbb\xbf" + data, data.replace(b"\n", b"\r"),
        data.decode().encode("utf-16")])


@bytes_of
def aliases(rng, data):
    """anchors that multiply"""
    return data + b"title: &a [x, x, x, x, x, x, x, x, x]\n" + b"".join(b"b%d: &b%d [*a, *a, *a, *a]\n" % (i, i)
        for i in range(5))


TEXT_FAULTS = [out_of_range, out_of_range, wrong_unit, no_number, wrong_type, no_word, unknown_key, twice, tab, byte,
    byte, byte, cut, deep, line_gone, odd_ends, aliases]


# ------------------------------------------------------------------ files

def changed(change):
    def fault(rng, path):
        path.write_bytes(bytes(change(rng, bytearray(path.read_bytes()))))
    fault.__doc__ = change.__doc__
    return fault


@changed
def file_cut(rng, data):
    """cut off"""
    return data[:rng.randrange(len(data)) if data else 0]


@changed
def file_empty(rng, data):
    """empty"""
    return b""


@changed
def file_head(rng, data):
    """a wrong header"""
    for _ in range(3):
        data[rng.randrange(min(len(data), 80))] = rng.randrange(256)
    return data


@changed
def file_byte(rng, data):
    """random bytes"""
    for _ in range(rng.choice([1, 10])):
        data[rng.randrange(len(data))] = rng.randrange(256)
    return data


@changed
def file_number(rng, data):
    """a number that is none"""
    if data[:200].isascii() and b"," in data:
        numbers = list(re.finditer(rb"[0-9][0-9.e+-]*", data))
        at = rng.choice(numbers)
        return data[:at.start()] + rng.choice([b"nan", b"inf", b"-inf", b"1e999", b"", b"x", b"1e300", b"-1",
            b"0"]) + data[at.end():]
    at = rng.randrange(len(data) // 8 or 1) * 8
    return data[:at] + rng.choice([b"\0\0\0\0\0\0\xf8\x7f", b"\0\0\0\0\0\0\xf0\x7f",
        b"\0\0\xc0\x7f\0\0\xc0\x7f"]) + data[at + 8:]


@changed
def file_columns(rng, data):
    """a column more or less in one row"""
    lines = data.split(b"\n")
    i = rng.randrange(len(lines))
    lines[i] = lines[i].rpartition(b",")[0] if rng.random() < 0.5 else lines[i] + b",1"
    return b"\n".join(lines)


@changed
def file_rows(rng, data):
    """rows in another order, or twice"""
    lines = data.split(b"\n")
    i, j = rng.randrange(len(lines)), rng.randrange(len(lines))
    lines[i], lines[j] = lines[j], lines[rng.choice([i, j])]
    return b"\n".join(lines)


@changed
def file_other(rng, data):
    """another kind of file"""
    return rng.choice([b"RIFF\x24\0\0\0WAVEfmt \x10\0\0\0", b"\x89PNG\r\n\x1a\n", b"\x93NUMPY\x01\0", b"GWYP",
        b"Gwyddion Simple Field 1.0\n", b"a,b\n1,2\n", b"\0" * 1000, b"rasp: 1\n"])


def file_missing(rng, path):
    """missing"""
    path.unlink()


def file_folder(rng, path):
    """a folder in its place"""
    path.unlink()
    path.mkdir()


def file_loop(rng, path):
    """a link to itself"""
    path.unlink()
    os.symlink(path.name, path)


FILE_FAULTS = [file_cut, file_empty, file_head, file_byte, file_number, file_number, file_columns, file_rows,
    file_other, file_missing, file_folder, file_loop]
