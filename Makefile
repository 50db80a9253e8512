# make            build/rasp, rasp-modes     make check     set-up, build, tests (6 minutes; LONG=1: all)
# make demo       set-up, build, a tour      make help      the other targets and the variables

BUILD ?= build
OPT ?= -O2 -g
PREFIX ?= /usr/local
SECONDS ?= 60
JOBS ?= $(shell getconf _NPROCESSORS_ONLN)
ifeq ($(origin CC),default)
CC = gcc
endif

# ISA=v2|v3|v4 builds all of rasp for that level of x86-64 instead of choosing per function at run time.
ifdef ISA
ARCH ?= -march=x86-64-$(ISA) -DRASP_NO_CLONES
endif
# SAN=1: address and undefined-behaviour sanitizers; any finding ends the program.
ifeq ($(SAN),1)
SANITIZE = -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer -DRASP_NO_CLONES
else
SANITIZE = $(SAN)
endif

# clang reports loops it does not vectorise, as all are at -O0 and -O1: that is no fault.
WARN = -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Wvla -Wstrict-prototypes -Wmissing-prototypes \
       $(if $(findstring clang,$(CC)),-Wno-pass-failed)
PKGS = sndfile yaml-0.1 fftw3 gsl jansson libebur128 libcrypto libpng soxr
# -fno-tree-slp-vectorize: gcc 12 turns pairs such as a c + b s, b c - a s into vfmsubadd there, in spite of -ffp-contract=off.
# maytrap: clang divides and converts before it asks whether it should, and traps (--traps) would stop at what no line does.
# -fno-math-errno: nobody asks errno about a root, and a loop with one goes in lanes.
CFLAGS = -std=c11 -D_GNU_SOURCE -ffp-contract=off $(if $(findstring clang,$(CC)),-ffp-exception-behavior=maytrap) -fno-math-errno -fno-tree-slp-vectorize -fopenmp-simd $(OPT) $(WARN) $(WERROR) $(ARCH) $(SANITIZE) -Isrc
# A short scene takes less time than loading libraries does: those that the system has as archives too are linked in. ARCHIVES= loads all.
ARCHIVES = fftw3 gsl gslcblas crypto png16 z yaml jansson
LIBS := $(foreach l,$(shell pkg-config --libs $(PKGS)) -lz -lsleef -lm,$(if $(and $(filter $(ARCHIVES:%=-l%),$l),$(filter /%,$(shell \
    $(CC) -print-file-name=$(l:-l%=lib%.a)))),-l:$(l:-l%=lib%.a),$l))
# What rasp-modes needs besides. Loading these takes longer than rasp does for a short scene.
HEAVY = -lcholmod -llapacke -lopenblas
PACKAGES = $(shell for package in $(PKGS) sleef openblas lapacke; do printf '%s %s;' $$package $$(pkg-config --modversion $$package 2> /dev/null || echo '?'); done)

# Of a source archive (make dist) the file REVISION says it.
REVISION := $(shell head -n 1 REVISION 2> /dev/null || git describe --always --dirty --abbrev=12 2> /dev/null || echo unknown)
VERSION := $(shell sed -n 's/^.define VERSION "\(.*\)"/\1/p' src/base/version.h)

SRC = $(filter-out src/main%.c,$(wildcard src/*.c src/*/*.c))
OBJ = $(SRC:src/%.c=$(BUILD)/%.o)
UNIT = $(patsubst tests/unit/%.c,$(BUILD)/tests/%.o,$(wildcard tests/unit/test_*.c))
FUZZ = $(patsubst tests/fuzz/%.c,$(BUILD)/%,$(wildcard tests/fuzz/fuzz_*.c))
BENCH = $(patsubst tests/bench/%.c,$(BUILD)/bench/%,$(wildcard tests/bench/*.c))
SUB = @$(MAKE) --no-print-directory -j$(JOBS)

# V=1 shows the commands, -s nothing.
ifneq ($(V),1)
Q = @
say = @$(if $(findstring s,$(firstword -$(MAKEFLAGS))),:,echo '$(1) $(subst $(BUILD)/,,$@)')
endif

all: $(BUILD)/rasp $(BUILD)/rasp-modes

# -no-pie: else the loader mends 24 000 addresses in tables of keys, a sixth of what starting takes.
$(BUILD)/rasp: $(BUILD)/main.o $(BUILD)/librasp.a
	$(call say,link)
	$Q$(CC) $(CFLAGS) -no-pie -o $@ $^ $(LIBS)
# The same into another place, with a search path for libraries: scripts/bundle.sh.
program: $(BUILD)/main.o $(BUILD)/librasp.a
	$Q$(CC) $(CFLAGS) -no-pie -Wl,--disable-new-dtags,-rpath,'$(RPATH)' -o $(PROGRAM) $^ $(LIBS)
$(BUILD)/rasp-modes: $(BUILD)/main_modes.o $(BUILD)/librasp.a
	$(call say,link)
	$Q$(CC) $(CFLAGS) -o $@ $^ $(HEAVY) $(LIBS)

$(BUILD)/librasp.a: $(OBJ) $(BUILD)/files
	$Qrm -f $@ && ar rcs $@ $(OBJ)

$(BUILD)/%.o: src/%.c $(BUILD)/flags
	@mkdir -p $(@D)
	$(call say,$(CC))
	$Q$(CC) $(CFLAGS) $(DEFINES) -MMD -MP -c -o $@ $<

# A sqrt that may set errno is not vectorised.
$(BUILD)/force/path_integral.o $(BUILD)/surface/rolling_envelope.o: private DEFINES = -fno-math-errno
# gcc 12 turns products of complex numbers in loops, too, into vfmaddsub.
$(BUILD)/analysis/modal_search.o: private DEFINES = -fno-tree-vectorize
# -O3 alone keeps the sums of eight lanes in registers where these are narrower than eight.
$(BUILD)/num/eigen.o $(BUILD)/response/object.o $(BUILD)/analysis/modal_block.o $(BUILD)/num/phases.o $(BUILD)/convolution/coupled_gradient.o $(BUILD)/convolution/coupled.o: \
    private DEFINES = $(if $(filter -O2,$(OPT)),-O3)
# `rasp --version --verbose` says what it was made from.
$(BUILD)/cmd/version.o: private DEFINES = -DRASP_REVISION='"$(REVISION)"' -DRASP_FLAGS='"$(strip $(CFLAGS))"' -DRASP_PACKAGES='"$(PACKAGES)"'
$(BUILD)/cmd/version.o: $(BUILD)/revision

# One program of all unit tests, build/unit NAME, as linking takes longer than compiling: their main() is called after them, and a table has its address.
unit: $(BUILD)/unit
$(BUILD)/tests/%.o: tests/unit/%.c $(BUILD)/flags
	@mkdir -p $(@D)
	$(call say,$(CC))
	$Q$(CC) $(CFLAGS) -Dmain=$* -MMD -MP -Itests/unit -c -o $@ $<
$(BUILD)/tests/table.h: $(BUILD)/files
	@mkdir -p $(@D); printf 'TEST(%s)\n' $(notdir $(UNIT:.o=)) > $@
$(BUILD)/unit: tests/unit/unit.c $(BUILD)/tests/table.h $(UNIT) $(BUILD)/librasp.a
	$(call say,link)
	$Q$(CC) $(CFLAGS) -I$(BUILD)/tests -o $@ $< $(UNIT) $(BUILD)/librasp.a $(shell pkg-config --libs check) $(HEAVY) $(LIBS)

# Other flags, another compiler, another list of files in the same folder: what depends on them is made again.
$(BUILD)/flags: FORCE
	@mkdir -p $(@D); echo '$(CC) $(CFLAGS)' | cmp -s - $@ || echo '$(CC) $(CFLAGS)' > $@
$(BUILD)/files: FORCE
	@mkdir -p $(@D); echo '$(patsubst $(BUILD)/%,%,$(OBJ) $(UNIT))' | cmp -s - $@ || echo '$(patsubst $(BUILD)/%,%,$(OBJ) $(UNIT))' > $@
$(BUILD)/revision: FORCE
	@mkdir -p $(@D); echo '$(REVISION)' | cmp -s - $@ || echo '$(REVISION)' > $@

demo:
	@scripts/setup.sh build demo
	$(SUB) all
	BUILD=$(BUILD) scripts/demo.sh

check:
	@scripts/setup.sh build test
	$(SUB) all unit
	@BUILD=$(BUILD) CC=$(CC) AFTER=scripts/weight.sh tests/run.sh

# Every warning is an error, with both compilers.
warnings: warnings-gcc warnings-clang
warnings-gcc warnings-clang:
	$(SUB) BUILD=$(BUILD)/$@ CC=$(@:warnings-%=%) WERROR=-Werror all unit

# What runs OpenBLAS's code, once more by other kernels than this CPU's own; KERNELS=all: by all that it can run.
blas:
	$(SUB) all unit
	@BUILD=$(BUILD) tests/blas.sh

# With clang, whose instrumented code is up to three times faster than gcc's. -g1: lines are all a report shows, and 200 programs are linked in less time.
# Without instructions for it, fma() calls libm: such a program takes up to 2.5 times as long, so that this CPU's are used where it has them.
FUSED = $(if $(shell grep -wm1 avx2 /proc/cpuinfo),ISA=v3)
sanitize:
	$(SUB) BUILD=$(BUILD)/sanitize CC=clang SAN=1 OPT="-O2 -g1" $(FUSED) all unit
	@SANITIZED=1 BUILD=$(BUILD)/sanitize tests/run.sh faults unit cli faults/signals cli/batch-changed

# The same bytes from every build, on every CPU, in every run: tests/bytes/.
bytes: all
	@BUILD=$(BUILD) JOBS=$(JOBS) tests/run.sh bytes

# SECONDS in total, shared by the fuzz targets; what they find is left in build/fuzz/.
fuzz:
	$(SUB) BUILD=$(BUILD)/fuzz CC=clang SAN="-fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=all -DRASP_NO_CLONES" OPT="-O1 -g1" fuzzers
	@tests/fuzz/run.sh $(BUILD)/fuzz $(SECONDS)
fuzzers: $(FUZZ)
$(BUILD)/fuzz_%: tests/fuzz/fuzz_%.c tests/fuzz/fuzz.h $(BUILD)/librasp.a
	@mkdir -p $(@D)
	$(call say,$(CC))
	$Q$(CC) $(CFLAGS) -fsanitize=fuzzer -Itests/fuzz -o $@ $< $(BUILD)/librasp.a -Wl,--as-needed $(HEAVY) $(LIBS)

# Random scenes, a part of them with a fault planted, for SECONDS: tests/torture/. SEED=2 others. What is built with
# sanitizers runs one in four, and must make the same bytes.
SEED ?= 1
torture:
	$(SUB) all
	$(SUB) BUILD=$(BUILD)/sanitize CC=clang SAN=1 OPT="-O2 -g1" $(FUSED) all
	@tests/torture/torture.py --rasp $(BUILD)/rasp --sanitized $(BUILD)/sanitize/rasp --seed $(SEED) --limit 5 \
	    --seconds $(SECONDS) --jobs $(JOBS)

# What takes long: reports that are committed (evidence/), and timings (tests/bench/, programs and scripts).
evidence: all
	@BUILD=$(BUILD) scripts/run_all.sh evidence
bench: all $(BENCH)
	@BUILD=$(BUILD) scripts/run_all.sh tests/bench
$(BUILD)/bench/%: tests/bench/%.c $(BUILD)/librasp.a
	@mkdir -p $(@D)
	$(call say,$(CC))
	$Q$(CC) $(CFLAGS) -MMD -MP -o $@ $< $(BUILD)/librasp.a -Wl,--as-needed $(HEAVY) $(LIBS)

# The mode tables that ship, from the recipes beside them.
irs: all
	@BUILD=$(BUILD) scripts/irs.sh

# Where shells look for completions, below $(PREFIX).
BASHDIR ?= share/bash-completion/completions
ZSHDIR ?= share/zsh/site-functions
FISHDIR ?= share/fish/vendor_completions.d
TO = $(DESTDIR)$(PREFIX)

install: all
	install -D -m 755 $(BUILD)/rasp "$(TO)"/bin/rasp
	install -D -m 755 $(BUILD)/rasp-modes "$(TO)"/libexec/rasp/rasp-modes
	for page in man/*.1; do install -D -m 644 -t "$(TO)"/share/man/man1 $$page || exit 1; done
	for page in man/*.5; do install -D -m 644 -t "$(TO)"/share/man/man5 $$page || exit 1; done
	for page in man/*.7; do install -D -m 644 -t "$(TO)"/share/man/man7 $$page || exit 1; done
	for folder in scenes surfaces irs; do install -d "$(TO)"/share/rasp/$$folder && cp -R $$folder/. "$(TO)"/share/rasp/$$folder || exit 1; done
	install -m 644 -t "$(TO)"/share/rasp scripts/rasp.py
	chmod -R u+rwX,go+rX,go-w "$(TO)"/share/rasp
	for kind in scene design; do $(BUILD)/rasp explain --schema=$$kind > $(BUILD)/$$kind.schema.json && \
	    install -m 644 -t "$(TO)"/share/rasp $(BUILD)/$$kind.schema.json || exit 1; done
	for shell in bash zsh fish; do $(BUILD)/rasp completion $$shell > $(BUILD)/completion.$$shell || exit 1; done
	install -D -m 644 $(BUILD)/completion.bash "$(TO)"/$(BASHDIR)/rasp
	install -D -m 644 $(BUILD)/completion.zsh "$(TO)"/$(ZSHDIR)/_rasp
	install -D -m 644 $(BUILD)/completion.fish "$(TO)"/$(FISHDIR)/rasp.fish
	install -D -m 644 -t "$(TO)"/share/doc/rasp README.md LICENSE CHANGELOG.md CITATION.cff

# Folders that others may use too go only if nothing else is in them; of a real system those that it has from the start stay.
uninstall:
	rm -f "$(TO)"/bin/rasp "$(TO)"/share/man/man1/rasp.1 "$(TO)"/share/man/man1/rasp-*.1 "$(TO)"/share/man/man5/rasp-*.5 "$(TO)"/share/man/man7/rasp-*.7
	rm -f "$(TO)"/$(BASHDIR)/rasp "$(TO)"/$(ZSHDIR)/_rasp "$(TO)"/$(FISHDIR)/rasp.fish
	rm -rf "$(TO)"/share/rasp "$(TO)"/share/doc/rasp "$(TO)"/libexec/rasp
	for folder in libexec $(BASHDIR) $(ZSHDIR) $(FISHDIR) $(if $(DESTDIR),bin share/man/man1 share/man/man5 share/man/man7 share/doc); do \
	    [ ! -d "$(TO)"/$$folder ] || (cd "$(TO)" && rmdir -p --ignore-fail-on-non-empty $$folder) || exit 1; done

# The program with the libraries that it loads, to be unpacked anywhere.
bundle: all
	@BUILD=$(BUILD) scripts/bundle.sh $(BUILD)/rasp-$(VERSION)-x86_64.tar.gz

# The source archive: the same bytes from the same revision.
dist:
	@scripts/dist.sh $(BUILD)/rasp-$(VERSION).tar.gz
# A Debian package of it, checked and tried; INSTALL=1, as root: also installed, tried and purged.
deb:
	@scripts/setup.sh build package
	@scripts/deb.sh $(BUILD)/deb $(if $(INSTALL),--install)

clean:
	rm -rf $(BUILD)

help:
	@echo 'all (default)  $(BUILD)/rasp, -modes     unit       the unit test programs'
	@echo 'demo           set-up, build, tour    check      set-up, build, tests'
	@echo 'warnings       -Werror, gcc, clang    sanitize   unit, cli and faults under ASan and UBSan'
	@echo 'bytes          same bytes, all builds fuzz       SECONDS=60 of fuzzing'
	@echo 'torture        SECONDS=60, SEED=1       blas       by OpenBLAS of another CPU'
	@echo 'evidence       the long reports       bench      timings'
	@echo 'irs            irs/ from its recipes  install    PREFIX, DESTDIR'
	@echo 'dist           the source archive     deb        a Debian package'
	@echo 'clean          removes $(BUILD)       uninstall  what install put there'
	@echo 'variables: BUILD CC OPT ISA=v2|v3|v4 SAN=1 WERROR=-Werror JOBS V=1 PREFIX DESTDIR'
	@echo '           LONG=1 (check: the longest tests, too) ISAS OPTS (bytes: more builds)'

-include $(OBJ:.o=.d) $(BUILD)/main.d $(BUILD)/main_modes.d $(UNIT:.o=.d) $(BENCH:=.d)
FORCE:
.PHONY: all program bundle unit demo check blas warnings warnings-gcc warnings-clang sanitize bytes fuzz fuzzers torture evidence bench irs install uninstall dist deb clean \
    help FORCE
