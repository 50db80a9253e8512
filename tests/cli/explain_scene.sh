# The effective scene: every default, the command line's keys, inputs by hash, file names as seen from here.
mkdir sub
printf 'place,x_m,y_m,mode,frequency_hz,decay_per_s,gain,phase_rad\na,0,0,1,440,10,1,0\n' > sub/bar.csv
cat > sub/scene.yaml << 'END'
rasp: 1
title: "quotes \" and \\ and: colons # and hashes"
surface: {roughness: {rms: 4 um}, response: bar.csv}
scraper: {mass: 20 g}
motion: {path: back_and_forth, to: [4.5 cm, 0], rate: 2 Hz, duration: 2 s}
END
rasp explain --set motion.rate='3 Hz' --set motion.rate=0.1 --seed=18446744073709551615 --set accuracy.oversampling=6 sub/scene.yaml
