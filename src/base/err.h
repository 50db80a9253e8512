/* One error and the trail of where it happened. Its kinds are the exit codes of the program (man rasp, EXIT STATUS). */
#ifndef BASE_ERR_H
#define BASE_ERR_H
#include <stdbool.h>

enum err_kind {
    ERR_NONE = 0,
    ERR_DIFFERS = 1,     /* compare: the two differ                              */
    ERR_USAGE = 64,      /* the command line                                     */
    ERR_SCENE = 65,      /* the scene or the data it names; a refused promise    */
    ERR_INPUT = 66,      /* an input file is missing or unreadable               */
    ERR_UNBUILT = 69,    /* the feature is not built in                          */
    ERR_NUMBERS = 70,    /* not finite, energy grew: a numerical failure         */
    ERR_MEMORY = 71,     /* out of memory                                        */
    ERR_CREATE = 73,     /* an output cannot be created                          */
    ERR_IO = 74,         /* reading or writing failed half-way                   */
    ERR_INTERRUPTED = 75 /* stopped by a signal, or others are at work: run again */
};

struct err_place { /* where in a text file that stands; file 0: not said, and line 0: in no line of it */
    int file,
        message; /* the text begins with this many bytes of the file's name, and from that byte on with what is wrong */
    int line, column, width; /* width 0: not known */
};

struct err {
    enum err_kind kind;
    char text[1024];
    struct err_place place;
    const char *contact, *key; /* of the scene: what the error is about (scene/scene_places.h); NULL: not said */
};

/* Sets the error, unless one is set already (the first cause wins), and returns false, so that
   `return err_set(e, ERR_INPUT, "...")` is the whole of a failure. Its text is one line: a line feed in a file's name,
   say, is shown as \n (text_show). */
bool err_set(struct err *e, enum err_kind kind, const char *format, ...) __attribute__((format(printf, 3, 4)));

/* What a call of the system failed of, by errno: ERR_MEMORY if there was no memory, else what is said here. */
enum err_kind err_system(enum err_kind otherwise);

/* Says which key of a contact (NULL: of the scene itself) the error is about, unless that is said already, and returns
   false. Both texts must live as long as the scene. */
bool err_about(struct err *e, const char *contact, const char *key);

/* Puts "where: " before the text of an error that is set; returns false. */
bool err_at(struct err *e, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* What a program says that ends here and now: one line on standard error, made without memory, by any thread. */

/* From now on that line is a JSON object, as of rasp's --diagnostics=json (cmd/message.h). Before there are threads. */
void err_last_words_as_json(void);

/* "rasp: error: text". Standard error that takes nothing for 0.1 s gets nothing. */
void err_last_words(enum err_kind kind, const char *text);

#endif
