/* One rule for every command that writes: a file that is there already is replaced only if it bears rasp's mark, a
   symbolic link never; --force does both.

   A sound bears the mark in its comment, a picture and a page of pictures in their text, a summary in what it lists.
   Tables, series of impacts and effective scenes have no room for one: the summary beside them lists their hashes. What
   is written to be used elsewhere or edited (starter scenes, mode tables, heights, scene parts, tables of accuracy)
   bears none, and replaces no file without --force. */
#ifndef OUTPUT_MARK_H
#define OUTPUT_MARK_H
#include <jansson.h>
#include <stdbool.h>

#include "base/arena.h"
#include "base/err.h"

#define MARK_PAGE "<meta name=\"generator\" content=\"rasp\">" /* within a page's first kilobytes */

#define MARK_TEXT "<!-- made by rasp -->\n" /* at the end of a text of XML */

/* The rule. What is neither a file nor a link to one is left to outfile_open. ERR_CREATE */
bool mark_permits(const char *path, const char *summary, bool force, struct err *e);

/* The rule of what bears no mark itself: it replaces nothing. ERR_CREATE */
bool mark_absent(const char *path, bool force, struct err *e);

/* The part of it about links, of files that are known otherwise to be rasp's. ERR_CREATE */
bool mark_links(const char *path, bool force, struct err *e);

/* Of a summary that is about to be replaced: what it lists, or listed itself as older, that is still there and is none
   of the files that the new one lists; [{name, sha256}]. So a table that a later render does not write stays known. */
json_t *mark_older(const char *summary, const json_t *files, struct arena *a);

/* Puts the mark into a picture that is complete. False: errno */
bool mark_picture(int fd, bool svg);

#endif
