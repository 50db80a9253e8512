/* The keys of a scene and the words of its choices as tables, for the reader, the effective scene, `explain`, `new`
   and the man page. */
#ifndef SCENE_KEYS_H
#define SCENE_KEYS_H
#include <stdbool.h>
#include <stddef.h>

enum key_struct { KEY_SCENE, KEY_CONTACT };
enum key_type {
    KEY_NUMBER,       /* double, NAN when not given                      */
    KEY_WHOLE,        /* double that must be a whole number              */
    KEY_TIME_OR_AUTO, /* double, NAN for the word auto                   */
    KEY_COUNT,        /* int                                             */
    KEY_SEED,         /* uint64_t                                        */
    KEY_TEXT,         /* const char *, NULL when not given               */
    KEY_FILE,         /* const char *, resolved path                     */
    KEY_POINT,        /* double[2]                                       */
    KEY_POINTS,       /* const double *, [n][2], and int n, see below    */
    KEY_PLACES,       /* const double *, [n][3], and int n               */
    KEY_RANGE,        /* double[2], first < second, NAN when not given   */
    KEY_LIST,         /* const char **, NULL-terminated; NULL not given  */
    KEY_CHOICE        /* int, index into choices                         */
};
enum key_dimension {
    KEY_NONE,
    KEY_LENGTH,
    KEY_TIME,
    KEY_FREQUENCY,
    KEY_MASS,
    KEY_FORCE,
    KEY_SPEED,
    KEY_ACCELERATION,
    KEY_ANGLE,
    KEY_PER_AREA,
    KEY_DECIBEL,
    KEY_LUFS,
    KEY_FORCE_COEFFICIENT,
    KEY_OUTPUT,
    KEY_PRESSURE,
    KEY_DENSITY,
    KEY_FORCE_PER_LENGTH,
    KEY_PER_TIME,
    KEY_STIFFNESS,
    KEY_STIFFNESS_PER_MASS,
    KEY_PER_SPEED,
    KEY_DISSIPATION
};

struct choice {
    const char *word, *meaning; /* a table ends with word NULL */
};

struct params;

struct key {
    enum key_struct of;
    size_t offset; /* of the field: of `in` within the contact's block of parameters, else in struct scene or contact */
    const char *path;
    enum key_type type;
    enum key_dimension dimension;
    double low, high;     /* inclusive, SI */
    const char *standard; /* the default, as one would write it; NULL: must be given; "": may be left out */
    /* NULL, or "key=word|word": it may only be given, and has its default only, where that key has one of these words;
       or "key" (of type KEY_FILE or KEY_NUMBER): where that key is given; or "!key": where it is not. A key whose
       deciding key does not itself apply does not apply either. */
    const char *applies;
    const char
        *meaning; /* a sentence, with what the default means when it is not a value; NULL: other rows stand here */
    const struct choice *choices;
    const char
        *example; /* where there is no default: a value that shows what is meant; NULL: made of its type and unit */
    const char *shown;       /* where there is no default: the reference scene's value, if it is not `example` */
    bool on;                 /* may be left out, but is on in the reference scene */
    const struct params *in; /* whose row it is (scene/params.h); NULL: the scene's own */
};

struct key_section {
    enum key_struct of;
    size_t offset; /* of its bool */
    const char *path, *meaning;
    const struct params *in; /* as of a key */
};

enum { KEYS_RIVALS = 15 };

struct key_alternative {
    const char *applies;                /* as of a key; NULL: always */
    int least, most;                    /* how many of them may be given; most: 1, or more: all */
    const char *paths[KEYS_RIVALS + 1]; /* ends with NULL; "*": all parts of the surface that have a section */
};

/* What a knob counts, and so how its error is expected to follow it. */
enum key_scale {
    KEY_STEPS,  /* steps, or points, in something: the more, the finer     */
    KEY_SAMPLES /* audio samples from one to the next: the fewer, the finer */
};

struct key_knob {
    const char *name;
    double low, high;
    int whole;
    enum key_scale scale;
    double order;     /* power with which its error falls */
    double preset[4]; /* draft, standard, high, reference */
    size_t offset;    /* of its double in struct accuracy */
    const char *meaning;
};

/* Tables end with a NULL path (name). */
struct keys {
    const struct key *table;
    const struct key_section *sections;
    const struct key_alternative *alternatives; /* ends with paths[0] NULL */
};

/* The scene's own rows, and those of all files that have some (scene/params.h); put together once. */
const struct keys *keys_all(void);
#define keys_table (keys_all()->table)
#define keys_sections (keys_all()->sections)
#define keys_alternatives (keys_all()->alternatives)

/* The field of a key, and the bool of a section, of a struct scene or contact. */
void *keys_field(const struct key *k, const void *owner);
bool *keys_given(const struct key_section *s, const void *owner);

extern const struct key_knob keys_knobs[];
extern const char *const keys_presets[5]; /* ends with NULL */

const struct key *keys_find(const char *path);

/* What to write instead of a key that is no longer there or, where word is not "", of a choice's word; NULL: there
 * never was one. */
const char *keys_former(const char *path, const char *word);

/* The key that decides whether this one applies; NULL: it always does. */
const struct key *keys_decider(const struct key *k);
/* The words of that key with which this one applies, such as "circle|scribble"; NULL: it applies where that key is
 * given, or is not. */
const char *keys_words(const struct key *k);
/* Does this key apply where the one that decides has the word? */
bool keys_applies_with(const struct key *k, const char *word);

/* Does it apply where the key that decides (if there is one, and it has no words) is given, or is not? */
bool keys_applies_beside(const struct key *k, bool given);

/* The alternative's condition as that of a key, for what is asked of keys. */
struct key keys_condition(const struct key_alternative *t);

/* KEY_POINTS, KEY_PLACES: how many there are; `field` is that of the list, which the number follows. Numbers in each: 2
 * or 3. */
int *keys_points_count(const void *field);
int keys_points_width(const struct key *k);

/* The first key of the table with the same table of words; NULL: this is the first, or has none. */
const struct key *keys_same_words(const struct key *k);

#endif
