# Good scenes are named on stdout, bad ones on stderr; all are checked, and the worst code is returned.
rasp new -o good.yaml
rasp new contacts -o two.yaml
sed 's/rms: 4 um/rms: 4 g/; s/rate: 2 Hz/raet: 2 Hz/' good.yaml > bad.yaml
rasp check good.yaml bad.yaml missing.yaml two.yaml
