# Command lines that mean nothing: exit 64 each, with what was probably meant.
try() { local code=0; "$@" || code=$?; echo "$code"; }
try rasp expalin
try rasp xylophone
try rasp help expalin
try rasp --verison
try rasp --verbose
try rasp check
try rasp explain motion surface
try rasp check --st seed=1 x.yaml
try rasp check --seed=1 --seed=2 x.yaml
try rasp check --seed
try rasp new --force=yes
try rasp new scrap
try rasp explain motion.rat
try rasp explain rate
try rasp explain xylophone
