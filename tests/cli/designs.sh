# The designs that ship have nothing wrong with them.
rasp check "$ROOT"/scenes/designs/*.yaml
# One is known by its first key, in either style.
rasp new -o scrape.yaml
for text in '{rasp-design: 1, base: scrape.yaml, factors: {motion.rate: [1 Hz]}}' '{"rasp-design": 1, base: scrape.yaml}' '"rasp-design": 1\nbase: scrape.yaml' '{\n  rasp-design: 1,\n  base: scrape.yaml\n}'; do
    # shellcheck disable=SC2059
    printf "$text\n" > style.yaml
    rasp check style.yaml
done
