# Modes above half the sample rate do not ring; the warning outlives the run that found them (make sanitize).
rasp render "$ROOT/scenes/basswood_scrape.yaml" --quiet --set 'output.sample_rate=16 kHz' --set 'motion.duration=0.1 s'
