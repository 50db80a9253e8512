# --version is one line; --verbose adds what a bug report needs.
rasp --version | grep -Ex 'rasp [0-9]+\.[0-9]+\.[0-9]+'  > /dev/null
rasp --version --verbose | sed '1d; s/   *[^ ].*//'
