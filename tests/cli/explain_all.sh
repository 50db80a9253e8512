# The reference scene is a scene, and so is its effective scene, which is the effective scene of itself.
rasp explain > every.yaml
rasp check every.yaml
rasp explain every.yaml > effective.yaml
rasp explain effective.yaml > again.yaml
cmp effective.yaml again.yaml
[ "$(grep -c . every.yaml)" -gt 150 ]
