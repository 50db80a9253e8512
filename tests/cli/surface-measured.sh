# The seven measured profiles, as a study of them with other tools found them: rms height (its last digit), seam, band limit (half an octave), the
# resampled ends of the longer ones, the image rows that acrylic is made of.
data=$ROOT/../shared/data/surfaces
[ -f "$data/acrylic.npy" ] || { echo "no measured profiles in ../shared/data/surfaces"; exit 77; }
command -v python3 > /dev/null || { echo "no python3"; exit 77; }
rasp surface info --json --pitch 1.394068um "$data"/*.npy > report.json
python3 - << 'END'
import json, os
# name: samples, rms um, its tolerance, cycles per sample, seam um from .. to
known = {'acrylic': (100800, 1.31, .005, .0625, 0, 2.6), 'bass_wood': (100800, 5.73, .005, .0625, 0, 2.6), 'plywood': (100800, 4.74, .005, .0625, 0, 2.6),
         'ceramic': (403490, 5.66, .005, .0156, 7, 37), 'poplar_wood': (387693, 5.63, .005, .0156, 7, 37), 'pvc': (403490, 15.4, .05, .0156, 7, 37),
         'sandpaper': (390462, 4.94, .005, .0156, 7, 37)}
for s in json.load(open('report.json'))['surfaces']:
    name = os.path.basename(s['file'])[:-4]
    samples, rms, tolerance, band, low, high = known.pop(name)
    limit = s['band_x']['limit_cycles_per_m'] * s['pitch_x_m']
    seam = s['ends_x']['jump_repeated_m'] * 1e6
    fall = s['ends_x']['fall_samples'][1]
    long = band < .03
    good = [s['columns'] == samples and s['rows'] == 1, abs(s['heights']['sq_m'] * 1e6 - rms) <= tolerance, .7 < limit / band < 1.42,
            low <= seam <= high, (fall > 0) == long, s['missing'] == 0, s['repetition']['stands_out'] == (name == 'acrylic')]
    if name == 'acrylic':
        good += [1019 <= s['repetition']['lag_samples'] <= 1034, abs(s['repetition']['autocorrelation'] - .37) < .02]
    print(name, 'as known' if all(good) else ('differs', good, limit, seam, fall, s['heights'], s['repetition']))
assert not known, known
END
