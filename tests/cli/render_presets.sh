# Every preset of accuracy renders every kind of force, load and convolution; the finer agree better with the reference.
for scene in basswood_scrape paper_force ceramic_stroke; do
    for preset in draft standard high reference; do
        rasp render "$ROOT/scenes/$scene.yaml" --set accuracy=$preset --set motion.duration=0.15s --set output.tail=0 \
            --set output.level=null --set output.level.full_scale=1 --set output.encoding=float64 -q -o $scene.$preset.wav
    done
    for preset in draft standard high; do
        { rasp compare $scene.reference.wav $scene.$preset.wav --snr 1000 || true; } | sed -n 's/^SNR *\([-0-9]*\).*/\1/p'
    done | tr '\n' ' ' | awk -v scene=$scene '{ print scene, ($1 < $2 && $2 < $3 && $3 > 20) ? "ok" : "not ordered: " $0 }'
done
