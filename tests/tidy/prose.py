#!/usr/bin/env python3
"""Sentences of README.md and the manual pages that are too long to be read once: none over 40 words, a median below 20, no paragraph over 120.

    tests/tidy/prose.py [--all] FILE...        --all: prints the lengths of each file, too

Prose is what stands outside of code, tables and lists of synopses. A sentence ends at . ! ? : or ; before a blank and a capital or the paragraph's end; the
two last only where what follows is a sentence of its own is no question for a script, so that : and ; do not end one.
"""
import re
import statistics
import subprocess
import sys

MOST, MEDIAN, PARAGRAPH = 40, 20, 120


def paragraphs_of_markdown(text):
    text = re.sub(r"^```.*?^```", "", text, flags=re.S | re.M)
    for block in re.split(r"\n\s*\n", text):
        items, lines = [], [line for line in block.split("\n") if not line.startswith(("|", "#", "![", "    "))]
        for line in lines:
            if re.match(r"\s*([-*]|\d+\.) ", line) or not items:
                items.append("")
            items[-1] += " " + re.sub(r"^\s*([-*]|\d+\.) ", "", line)
        for item in items:
            yield re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", re.sub(r"`[^`]*`", "CODE", item))


def paragraphs_of_mdoc(path):
    """As mandoc lays them out: paragraphs are parted by blank lines, and what is indented literally is no prose."""
    source = re.sub(r"^\.Bd .*?^\.Ed", "", open(path, encoding="utf-8").read(), flags=re.S | re.M)
    source = re.sub(r"^\.TS.*?^\.TE", "", source, flags=re.S | re.M)
    source = re.sub(r"^\.Sh SYNOPSIS.*?^\.Sh", ".Sh", source, flags=re.S | re.M)
    for block in re.split(r"^\.(?:Pp|Sh|Ss|It|Bl|El|Bd|Ed)\b.*$", source, flags=re.M):
        words = []
        for line in block.split("\n"):
            if line.startswith((".\\\"", ".Dd", ".Dt", ".Os", ".Nd", ".Nm ,")):
                continue
            if line.startswith("."):  # a macro: its arguments are words of the sentence, a mark at its end stays
                mark = line.split()[-1] if line.split()[-1] in (".", ",", ";", ":", ")", ").") else ""
                words.append("CODE" + (mark if mark in (".", ").") else ""))
            else:
                words.append(line)
        yield " ".join(words)


def sentences(paragraph):
    for sentence in re.split(r"(?<=[.!?])[\"')]*\s+(?=[A-Z\"'(`])", paragraph.strip()):
        words = re.findall(r"[A-Za-z][A-Za-z'-]*|\d[\d.]*", sentence)
        if len(words) > 2:
            yield len(words), sentence


def main():
    files = [a for a in sys.argv[1:] if a != "--all"]
    bad = 0
    for path in files:
        text = open(path, encoding="utf-8").read()
        lengths = []
        for paragraph in paragraphs_of_markdown(text) if path.endswith(".md") else paragraphs_of_mdoc(path):
            of = list(sentences(paragraph))
            lengths += [n for n, _ in of]
            if sum(n for n, _ in of) > PARAGRAPH:
                bad += 1
                print(f"{path}: a paragraph of {sum(n for n, _ in of)} words: {paragraph.strip()[:90]}...")
            for n, sentence in of:
                if n > MOST:
                    bad += 1
                    print(f"{path}: a sentence of {n} words: {sentence[:90]}...")
        median = statistics.median(lengths) if lengths else 0
        if median >= MEDIAN:
            bad += 1
            print(f"{path}: a median of {median:g} words a sentence")
        if "--all" in sys.argv:
            print(f"{path}: {len(lengths)} sentences, median {median:g}, longest {max(lengths, default=0)}")
    sys.exit(bad > 0)


main()
