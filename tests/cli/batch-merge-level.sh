# A merge joins what the shards of this state say, though the folder knows the same sounds from a state with another level: a loudness is asked of records that have it.
. "$ROOT/tests/cli/batch-make.inc"
shards() { for k in $(seq "$1"); do rasp batch six.yaml -o parts -q --shard "$k/$1"; done; }
sed -i 's/\[200 ms, 250 ms, 300 ms\]/[500 ms, 600 ms]/; s/^factors/length: own\nlevel: {common: {peak: -6 dB}}\nfactors/' six.yaml
shards 3
cp -r parts peaks
echo "-- recordings have their loudness by themselves"
python3 -c '
import math, struct, wave
with wave.open("real.wav", "wb") as w:
    w.setnchannels(1), w.setsampwidth(2), w.setframerate(48000)
    w.writeframes(b"".join(struct.pack("<h", int(8000 * math.sin(0.1 * i))) for i in range(24000)))'
(mkdir with && cp ./*.yaml ./*.csv ./*.wav with && cd with && sed -i 's/peak: -6 dB/lufs: -30/' six.yaml && echo 'recordings: [{file: real.wav}]' >> six.yaml && shards 2 && rasp merge parts -q && rasp batch six.yaml -o whole -q &&
    same whole parts && echo "the same as whole")
echo "-- another level"
for levels in '600 ms, 2 s]' '600 ms]'; do
    rm -r parts
    cp -r peaks parts
    sed -i "s/peak: -6 dB/lufs: -30/; s/600 ms\(, 2 s\)*\]/$levels/" six.yaml
    rm parts/manifest.*
    shards 2
    rasp merge parts -q
    rasp batch six.yaml -o whole -q
    same whole parts && echo "the same as whole"
    rm -r whole
done
