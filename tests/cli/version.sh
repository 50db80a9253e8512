# --version is one line; --verbose adds what a bug report needs.
rasp --version | grep -Ex 'rasp [0-9]+\.[0-9]+\.[0-9]+'  > /dev/null
rasp --version --verbose | sed '1d; s/   *[^ ].*//'
# versions of libraries as loaded, and as built with
rasp --version --verbose | grep -Ec "built with [0-9]+\.[0-9]+"
# rasp-modes says the same, and is asked in the same ways
for words in --version -V "--version --verbose" "-v -V"; do
    # shellcheck disable=SC2086
    cmp <(rasp $words) <(rasp-modes $words)
done
rasp-modes --version | grep -Ex 'rasp [0-9]+\.[0-9]+\.[0-9]+' > /dev/null
