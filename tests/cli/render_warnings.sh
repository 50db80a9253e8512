# Modes above half the sample rate do not ring; the warning outlives the run that found them (make sanitize).
rasp render "$ROOT/scenes/basswood_scrape.yaml" --quiet --set 'output.sample_rate=16 kHz' --set 'motion.duration=0.1 s'
# A load beyond the range that the limiter's alpha is given for.
rasp render "$ROOT/scenes/basswood_scrape.yaml" --quiet -o out.wav --set 'motion.duration=0.1 s' --set 'contact.limiter.force_range=[0.01 N, 0.02 N]'
