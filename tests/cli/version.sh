# --version is one line; --verbose adds what a bug report needs.
rasp --version | grep -Ex 'rasp [0-9]+\.[0-9]+\.[0-9]+'  > /dev/null
rasp --version --verbose | sed '1d; s/   *[^ ].*//'
# versions of libraries as loaded, and as built with
rasp --version --verbose | grep -Ec "built with [0-9]+\.[0-9]+"
