# Who reads has read enough: exit code 74 and no words; a full disk has words.
rasp new -o scrape.yaml
for call in explain 'explain --schema=scene' 'plan scrape.yaml' 'plan --json scrape.yaml' 'render scrape.yaml -o -' 'help'; do
    mkfifo pipe && exec 3<> pipe 4> pipe 3>&-
    code=0
    # shellcheck disable=SC2086
    rasp $call >&4 || code=$?
    echo "$call: $code"
    exec 4>&- && rm pipe
done
rasp explain > /dev/full || echo $?
