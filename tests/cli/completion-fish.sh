# The completion of fish, asked by fish itself.
command -v fish > /dev/null || { echo "fish is not installed"; exit 77; }
export HOME=$PWD XDG_CONFIG_HOME=$PWD/home XDG_DATA_HOME=$PWD/home
rasp completion fish > completion
fish --no-config -n completion
touch a.yaml c.wav d.csv
mkdir folder

# ask LINE: what its last word may become, without descriptions.
ask() { echo "$1| $(fish --no-config -c "source completion; complete -C '$1'" | cut -f 1 | tr '\n' ' ')"; }
ask 'rasp pl'
ask 'rasp --v'
ask 'rasp help an'
ask 'rasp new sc'
ask 'rasp check a'
ask 'rasp plot --form'
ask 'rasp plot --format '
ask 'rasp plot --format=s'
ask 'rasp plot -f p'
ask 'rasp plot --panels w'
ask 'rasp plot -p force,mo'
ask 'rasp plot --panels=force,n'
ask 'rasp plan --set motion.pa'
ask 'rasp plan --set=motion.pa'
ask 'rasp plan --set motion.path=sc'
ask 'rasp plan --set=motion.path=sc'
ask 'rasp plan -s accuracy.pre'
ask 'rasp explain motion.pr'
ask 'rasp surface '
ask 'rasp surface info --p'
ask 'rasp surface convert --cr'
ask 'rasp surface info --cr'
ask 'rasp modes object --quantity v'
ask 'rasp completion '
