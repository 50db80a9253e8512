/* The report of a command: described once, printed as text for people or as JSON.

   A command walks what it found and says each figure with its JSON key, its label, or both. report_set, report_object
   and report_list are for JSON alone, report_text, report_row and report_note for text alone; report_figure is for
   both. Each does nothing where the report is of the other form. */
#ifndef CMD_REPORT_H
#define CMD_REPORT_H
#include <jansson.h>
#include <stdbool.h>
#include <stdio.h>

#include "base/err.h"
#include "file/json_value.h"

struct report {
    FILE *out;
    bool json, ascii; /* ascii: other characters of JSON as \\u.... */
    struct json_value_open open;
};

/* Opens the outermost object; text is printed from here on. */
struct report report_open(FILE *out, bool json);
/* The same with a list as the outermost. */
struct report report_open_list(FILE *out, bool json);

/* Prints the JSON with so many significant digits (0: all), and ends its line. ERR_IO */
bool report_close(struct report *r, int digits, struct err *e);

/* Members as json_value_put has them; of JSON alone. */
void report_set(struct report *r, const char *members, ...);

/* A member of the object that is open (a later one of a list: key NULL), open until report_end. */
void report_object(struct report *r, const char *key);
void report_list(struct report *r, const char *key);
void report_end(struct report *r);

void report_text(struct report *r, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* "  label               value" on a line of its own. */
void report_row(struct report *r, const char *label, const char *format, ...) __attribute__((format(printf, 3, 4)));
/* A line wrapped behind `head`, as wide as that. */
void report_note(struct report *r, const char *head, const char *text);
/* A number of JSON, which text shows as a row. */
void report_figure(struct report *r, const char *key, double x, const char *label, const char *format, ...)
    __attribute__((format(printf, 5, 6)));

#endif
