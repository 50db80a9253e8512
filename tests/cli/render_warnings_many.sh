# Of several scenes warnings come at the end, and one that several have is told once; what was warned of before a failure is told, too.
for name in a b c d e f g; do
    sed "s|\.\./|$ROOT/|" "$ROOT/scenes/basswood_scrape.yaml" > "$name.yaml"
done
few=(--quiet --set 'output.sample_rate=16 kHz' --set 'motion.duration=50 ms')
rasp render a.yaml b.yaml "${few[@]}" -o out/
echo --- >&2
rasp render [a-g].yaml "${few[@]}" -o out/ --set 'surface.modes=60'
echo --- >&2
rasp render a.yaml b.yaml "${few[@]}" -o out/ --diagnostics=json
echo --- >&2
# With other numbers in several scenes: told once in text, one by one in JSON. The 29 modes are the same in all.
for t in 40 45 50; do
    printf 'include: [a.yaml]\nmotion: {duration: 500 ms}\noutput: {duration: %d ms}\n' $t > cut$t.yaml
done
rasp render cut40.yaml cut45.yaml cut50.yaml --quiet --set 'output.sample_rate=16 kHz' -o out/
echo --- >&2
rasp render cut40.yaml cut45.yaml --quiet --diagnostics=json --set 'output.sample_rate=16 kHz' -o out/
echo --- >&2
printf 'include: [a.yaml]\noutput: {level: {peak: null, full_scale: 1e-12}}\n' > c.yaml
rasp render a.yaml b.yaml c.yaml "${few[@]}" -o out/
