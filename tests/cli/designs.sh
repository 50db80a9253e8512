# The designs that ship have nothing wrong with them.
rasp check "$ROOT"/scenes/designs/*.yaml
