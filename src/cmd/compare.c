/* rasp compare: two sounds or two tables, the first being the reference, or one of them and a hash. The parts are compare_sound.c,
   compare_table.c and compare_hash.c. */
#include "cmd/compare.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "base/hash.h"
#include "base/memory.h"
#include "base/text.h"
#include "cmd/cmd.h"

/* By its first bytes, else by its name; a pipe is a table, for its bytes could not be read twice. ERR_INPUT: not there. */
bool compare_is_sound(const char *path, bool *sound, struct err *e)
{
    static const char *const magics[] = {"RIFF", "RF64", "riff", "FORM", "fLaC", "OggS", "caff", ".snd", NULL};
    static const char *const names[] = {".wav", ".w64", ".aif", ".aiff", ".flac", ".ogg", ".caf", ".au", NULL};
    struct stat s;
    char head[5] = "";
    *sound = false;
    if (stat(path, &s) != 0)
        return err_set(e, ERR_INPUT, "%s: %s", path, strerror(errno));
    FILE *f = S_ISREG(s.st_mode) ? memory_fopen(path, "rb") : NULL;
    if (f) {
        head[fread(head, 1, 4, f)] = '\0';
        fclose(f);
    }
    const char *dot = strrchr(path, '.');
    for (int i = 0; magics[i]; i++)
        *sound = *sound || !strcmp(head, magics[i]) || (dot && !strcasecmp(dot, names[i]));
    return true;
}

/* NAME=ABS,REL; the name may hold = itself. */
static bool column_tolerance(const char *text, struct table_distance_tolerance *t, struct arena *a, struct err *e)
{
    char *name = arena_text(a, text), *equals = strrchr(name, '='), *comma = equals ? strchr(equals, ',') : NULL;
    if (comma) {
        *equals = *comma = '\0';
        *t = (struct table_distance_tolerance){.column = name};
        if (text_double(equals + 1, &t->abs) && text_double(comma + 1, &t->rel) && t->abs >= 0 && t->rel >= 0)
            return true;
    }
    return err_set(e, ERR_USAGE, "--column: '%s' is not of the form NAME=ABS,REL, as in speed_m_per_s=1e-6,0.001", text);
}

/* Of the tolerances for all others the first counts, of those for one column the last: so the command line overrides the file. */
static bool gather_tolerances(const struct args *g, const char *folder, struct compare_ask *ask, struct err *e)
{
    static const double range[2] = {0, HUGE_VAL};
    const struct table_distance_tolerance *file = NULL;
    const char *path = args_value(g, "tolerance");
    int columns, n = 0, rows = 0;
    const char **texts = args_values(g, "column", &columns);
    if (path && folder && *path != '/')
        path = arena_format(ask->arena, "%s/%s", folder, path);
    if (path && !(file = table_distance_read(path, ask->arena, e)))
        return false;
    while (file && file[rows].column)
        rows++;
    struct table_distance_tolerance *list = ARENA_TAKE(ask->arena, struct table_distance_tolerance, rows + columns + 2);
    ask->tolerances = list;
    if (args_given(g, "abs") || args_given(g, "rel"))
        list[n++].column = "*";
    if (!args_number(g, "abs", range, &list[0].abs, e) || !args_number(g, "rel", range, &list[0].rel, e))
        return false;
    for (int i = 0; i < rows; i++)
        list[n++] = file[i];
    for (int i = 0; i < columns; i++)
        if (!column_tolerance(texts[i], &list[n++], ask->arena, e))
            return false;
    return true;
}

static bool gather_limits(const struct args *g, struct compare_ask *ask, struct err *e)
{
    static const double any[2] = {-HUGE_VAL, HUGE_VAL}, positive[2] = {0, HUGE_VAL};
    return args_number(g, "snr", any, &ask->snr, e) && args_number(g, "lsb", positive, &ask->lsb, e) &&
           args_number(g, "third-octave", positive, &ask->third_octave, e) && args_number(g, "within", positive, &ask->within, e);
}

bool compare_limits(const struct args *g, const char *folder, struct compare_ask *ask, struct err *e)
{
    ask->snr = ask->lsb = ask->third_octave = NAN;
    ask->within = 60;
    if (args_given(g, "within") && !args_given(g, "third-octave"))
        return err_set(e, ERR_USAGE, "--within says which bands --third-octave compares: give both");
    return gather_limits(g, ask, e) && gather_tolerances(g, folder, ask, e);
}

/* The first of the options that was given, or NULL. */
static const char *given_of(const struct args *g, const char *const *names)
{
    for (; *names; names++)
        if (args_given(g, *names))
            return *names;
    return NULL;
}

const char *compare_limit_of_sounds(const struct args *g)
{
    static const char *const names[] = {"snr", "lsb", "third-octave", "within", NULL};
    return given_of(g, names);
}

const char *compare_limit_of_tables(const struct args *g)
{
    static const char *const names[] = {"tolerance", "column", "abs", "rel", NULL};
    return given_of(g, names);
}

/* FILE --hash HEX. */
static int compare_run_hash(const struct cmd_call *c, struct compare_ask *ask, struct err *e)
{
    const char *sounds = compare_limit_of_sounds(&c->args), *tables = compare_limit_of_tables(&c->args);
    const char *other = args_given(&c->args, "exact") ? "exact" : sounds ? sounds : tables;
    char *hex = arena_text(c->arena, args_value(&c->args, "hash"));
    bool sound;
    if (c->args.n_operands != 1)
        err_set(e, ERR_USAGE, "--hash takes one file, not two: the hash is the reference");
    else if (other)
        err_set(e, ERR_USAGE, "--hash leaves no room for --%s: a hash is met or it is not", other);
    else if (strlen(hex) != HASH_TEXT - 1 || strspn(hex, "0123456789abcdefABCDEF") != HASH_TEXT - 1)
        err_set(e, ERR_USAGE, "--hash: '%s' is not a SHA-256: 64 hexadecimal digits, as `rasp compare FILE FILE` prints them", hex);
    if (e->kind || !compare_is_sound(ask->files[0], &sound, e))
        return (int)e->kind;
    for (char *p = hex; *p; p++)
        *p = *p >= 'A' && *p <= 'F' ? (char)(*p + 'a' - 'A') : *p;
    ask->hash = hex;
    return compare_hash(ask, sound, e);
}

static int compare_run(struct cmd_call *c, struct err *e)
{
    const char **files = c->args.operands, *sounds = compare_limit_of_sounds(&c->args), *tables = compare_limit_of_tables(&c->args);
    bool a, b, exact = args_given(&c->args, "exact");
    struct compare_ask ask = {.files = {files[0], files[1]}, .json = args_given(&c->args, "json"), .quiet = args_given(&c->args, "quiet"),
                              .exact = exact || (!sounds && !tables), .out = stdout, .arena = c->arena};
    if (args_given(&c->args, "hash"))
        return compare_run_hash(c, &ask, e);
    if (c->args.n_operands < 2) {
        err_set(e, ERR_USAGE, "operands are missing; usage: rasp compare A B, or rasp compare FILE --hash SHA256");
        return (int)e->kind;
    }
    if (!compare_is_sound(files[0], &a, e) || !compare_is_sound(files[1], &b, e))
        return (int)e->kind;
    if (a != b)
        err_set(e, ERR_USAGE, "%s is a %s and %s is a %s: they cannot be compared", files[0], a ? "sound" : "table", files[1],
                b ? "sound" : "table");
    else if (a ? tables != NULL : sounds != NULL)
        err_set(e, ERR_USAGE, "--%s is for %s, and these are %s", a ? tables : sounds, a ? "tables" : "sounds", a ? "sounds" : "tables");
    else if (exact && tables)
        err_set(e, ERR_USAGE, "--exact leaves no room for --%s", tables);
    if (e->kind || !compare_limits(&c->args, NULL, &ask, e))
        return (int)e->kind;
    return a ? compare_sound(&ask, e) : compare_table(&ask, e);
}

static const struct args_option options[] = {
    {"exact", 'e', NULL, false, "every sample or cell must be the same (the default when no limit is given)"},
    COMPARE_SOUND_LIMITS,
    COMPARE_TABLE_LIMITS,
    {"hash", 0, "SHA256", false, "checks one FILE against a stored hash of 64 hexadecimal digits; only --json and --quiet may stand beside it"},
    {"json", 'j', NULL, false, "prints the figures as one JSON object; null stands for an infinite figure or one that is not there"},
    {"quiet", 'q', NULL, false, "prints nothing when all criteria are met"},
    {0}};

const struct command compare_command = {
    .name = "compare",
    .summary = "compare two sounds or two tables within tolerances",
    .does = "Says whether B is A, the reference, and by how much it is not: for sounds the number of differing samples, the first, the "
            "largest difference, the signal-to-noise ratio and the third-octave levels; for tables (CSV, or NPY with named fields) the misses of each column and the "
            "worst of them; for both a SHA-256. Limits given together must all be met. Cells agree when |B - A| <= ABS + REL |A|.\n"
            "Sounds of different sample rates are not compared sample by sample: difference, LSB and SNR are left out, and every criterion "
            "but --third-octave fails.\n"
            "The SHA-256 of a sound is that of its audio, not of its file: the rate in Hz, the number of channels, then all samples frame by "
            "frame (integers of n bits as multiples of 2^(1-n)), each as a little-endian IEEE 754 double, -0 counted as +0; so A and B have "
            "the same exactly when --exact holds. That of a table is that of the file's bytes. With --hash there is one FILE, which must "
            "have the hash that is given.\n"
            "The exit code is 0 when the criteria are met, 1 when they are not, and never 0 when a file is missing or empty.",
    .operands = "A B | FILE --hash SHA256",
    .least = 1,
    .most = 2,
    .options = options,
    .examples = "rasp compare golden.wav new.wav\n"
                "rasp compare --snr 80 --third-octave 0.1 golden.wav new.wav\n"
                "rasp compare --lsb 1 golden.wav new.wav\n"
                "rasp compare --tolerance tolerance.csv golden.csv new.csv\n"
                "rasp compare --abs 1e-9 --rel 1e-6 --column events=0,0 golden.csv new.csv\n"
                "rasp compare --quiet --hash \"$(cat new.sha256)\" new.wav\n",
    .run = compare_run,
};
