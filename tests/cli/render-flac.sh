# FLAC: the samples of a WAV of as many bits, by output.encoding or by the file's name; sets, recordings and exports of them.
. "$ROOT/tests/cli/batch-make.inc"
for bits in 16 24; do
    rasp render tiny.yaml -o a.wav -q --set "output.encoding=pcm$bits"
    rasp render tiny.yaml -o folder/ -q --set "output.encoding=flac$bits"
    rasp render tiny.yaml -o b.flac -q --set "output.encoding=pcm$bits"
    for file in folder/tiny.flac b.flac; do rasp compare -q a.wav $file && echo "$file: flac$bits is pcm$bits"; done
    grep encoding b.scene.yaml
    rasp render b.scene.yaml -o again/ -q && cmp again/b.flac b.flac && cmp folder/tiny.flac b.flac
    rm -r folder again ./*.flac
done
rasp render tiny.yaml -o a.flac -q # which tells of a.wav
rm a.flac
rasp render tiny.yaml -o - --set output.encoding=flac16 > s.wav && head -c 4 s.wav && rm s.wav
echo " to standard output"
tell() { rasp "$@" || echo "exit code $?"; }
tell render tiny.yaml -o c.flac --set output.encoding=float32
tell render tiny.yaml -o c.wav --set output.encoding=flac24
tell check tiny.yaml --set output.encoding=flac24 --set output.channels=9
tell render tiny.yaml -o c.ogg
ls
# A set whose gain waits for all, with a recording, in two parts: the samples are those of WAVs.
rasp render tiny.yaml -o tap.wav -q
(cat six.yaml && echo 'recordings: [{file: tap.wav}]') > wav.yaml
sed 's/^seed/set: {output.encoding: flac24}\nseed/' wav.yaml > flac.yaml
rasp batch wav.yaml -o wav -q
for i in 1 2; do rasp batch flac.yaml -o parts -q --shard $i/2; done
rasp batch flac.yaml -o parts -q
rasp batch flac.yaml -o flac -q && same flac parts && (cd flac && sha256sum --quiet -c SHA256SUMS)
columns flac/manifest.csv file_name encoding true_peak_dbtp status
diff <(columns wav/manifest.csv stimulus_id audio_sha256 peak_dbfs) <(columns flac/manifest.csv stimulus_id audio_sha256 peak_dbfs) && echo "the same samples"
rasp export flac.yaml flac --for audiofolder -o data && ls data/train
if command -v gnuplot > /dev/null; then rasp plot data/train/tap.flac > /dev/null && test -s data/train/tap.png; fi
