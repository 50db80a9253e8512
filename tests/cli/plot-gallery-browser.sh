# The page of a set in headless Chromium, from a file: filtered, sorted, played, two sounds compared; 3000 rows of which few exist.
command -v chromium > /dev/null && command -v chromedriver > /dev/null || { echo "no chromium, or no chromedriver"; exit 77; }
command -v python3 > /dev/null || { echo "no python3"; exit 77; }
cat > stroke.yaml << 'END'
rasp: 1
surface: {roughness: {}, response: modes.csv}
scraper: {mass: 10 g}
motion: {path: line, to: [1 cm, 0 cm], speed: 20 cm/s}
output: {sample_rate: 8 kHz, tail: 2 s}
END
printf '%s\n' '# poles: shared' '# quantity: velocity' place,x_m,y_m,mode,frequency_hz,decay_per_s,gain,phase_rad a,0,0,1,1000,2,1,0 > modes.csv
cat > design.yaml << 'END'
rasp-design: 1
title: Light <and> heavy
base: stroke.yaml
factors:
  motion.speed: [9 cm/s, 10 cm/s, 20 cm/s]
  tool:
    - {label: light, set: {scraper.mass: 1 g}}
    - {label: heavy, set: {scraper.mass: 50 g}}
END
rasp batch -q design.yaml -o set
rasp plot --gallery set
cat > use.py << 'END'
import sys
sys.path.insert(0, sys.argv[1])
from browse import Browser
NAMES = "return [...document.querySelectorAll('td.name')].map(td => td.firstChild.textContent)"
FILL = "const f = document.querySelectorAll('thead input, thead select')[%d]; f.value = '%s'; f.dispatchEvent(new Event('input'));"
with Browser("set/gallery.html") as b:
    assert b.run("return document.title") == "Light <and> heavy"
    assert len(b.run(NAMES)) == 6
    b.until("return [...document.images].every(i => i.complete && i.naturalHeight === set.height)")
    b.run(FILL % (0, 10))
    b.run(FILL % (2, 1))
    assert b.run(NAMES) == ["10cm_s_heavy", "20cm_s_heavy"], b.run(NAMES)
    assert "2 of 6" in b.run("return document.body.innerText")
    b.run("document.getElementById('clear').click()")
    b.run("document.querySelectorAll('th > button')[1].click(); document.querySelectorAll('th > button')[1].click()")
    assert b.run(NAMES)[0] == "20cm_s_light" and b.run(NAMES)[-1] == "9cm_s_heavy"
    b.press("/LIGHT")
    assert b.run(NAMES) == ["20cm_s_light", "10cm_s_light", "9cm_s_light"]
    b.press("\ue00c")  # escape
    playing = "return !audio.paused && audio.currentTime > %g && document.querySelector('tr.now .name').title"
    b.press("n")
    assert b.until(playing % 0) == "20cm_s_light"
    b.press("nan")
    assert b.until(playing % 0.3) == "9cm_s_light"
    b.press("bx")
    assert b.until(playing % 0.3) == "10cm_s_light"
    b.press(" ")
    assert b.run("return audio.paused && audio.currentTime > 0.3")
    b.press("x")
    assert b.until(playing % 0.3) == "9cm_s_light"
    b.press("s")
    assert b.run("return audio.paused && audio.currentTime === 0")
    # Many rows: those in view exist, wherever that is.
    b.run("document.getElementById('find').value = ''; for (let k = 6; k < 3000; k++) set.items.push({...set.items[k % 6], k}); update()")
    assert len(b.run(NAMES)) < 40
    b.run("order = null; update(); list.scrollTop = 1500 * HEIGHT")
    b.until("return rows.has(set.items[1500])")
    assert len(b.run(NAMES)) < 40
    assert b.complaints() == [], b.complaints()
with Browser("set/gallery.html", dark=True) as b:
    assert b.run("return getComputedStyle(document.body).backgroundColor") == "rgb(22, 24, 27)"
END
timeout 120 python3 use.py "$ROOT/tests/lib"
