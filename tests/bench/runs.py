"""What pipeline.py and peers.py share: one process at a time, its CPU time; the yardstick; noise as a force."""
import array, json, os, random, struct, subprocess, time

ROOT, BUILD = os.environ["ROOT"], os.environ["BUILD"]
REPEATS = int(os.environ.get("REPEATS", "5"))
RATE = 44100
QUIET = subprocess.DEVNULL


def run(command, errors=None):
    """CPU seconds, wall seconds."""
    start = time.monotonic()
    child = subprocess.Popen([str(word) for word in command], stdin=QUIET, stdout=QUIET, stderr=errors)
    _, status, used = os.wait4(child.pid, 0)
    child.returncode = os.waitstatus_to_exitcode(status)
    if child.returncode != 0:
        raise RuntimeError(f"exit code {child.returncode}: {' '.join(map(str, command))}")
    return used.ru_utime + used.ru_stime, time.monotonic() - start


def yardstick():
    """Core clock in Hz and seconds a sample of the scalar loop, now."""
    clock, scalar = subprocess.run([BUILD + "/bench/yardstick"], capture_output=True, text=True, check=True).stdout.split()
    return float(clock), float(scalar)


def noise(n, seed=1):
    draw = random.Random(seed).random
    return array.array("d", (2 * draw() - 1 for _ in range(n)))


def write_npy(path, x, rows=None):
    shape = f"{rows}, {len(x) // rows}" if rows else f"{len(x)},"
    head = f"{{'descr': '<f8', 'fortran_order': False, 'shape': ({shape}), }}"
    head += " " * (-(len(head) + 11) % 64) + "\n"
    with open(path, "wb") as out:
        out.write(b"\x93NUMPY\x01\x00" + struct.pack("<H", len(head)) + head.encode())
        x.tofile(out)


def write_wav(path, x, rate=RATE):
    """32-bit floating point, mono."""
    data = array.array("f", x).tobytes()
    with open(path, "wb") as out:
        out.write(b"RIFF" + struct.pack("<I", 36 + len(data)) + b"WAVEfmt " + struct.pack("<IHHIIHH", 16, 3, 1, rate, 4 * rate, 4, 32) + b"data" + struct.pack("<I", len(data)) + data)
