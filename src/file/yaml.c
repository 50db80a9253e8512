/* Nodes: making and finding them; see yaml.h. */
#include "file/yaml.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <yaml.h>

#include "base/memory.h"
#include "base/text.h"
#include "file/bytes.h"

struct yaml *yaml_open(struct arena *a)
{
    struct yaml *y = ARENA_TAKE(a, struct yaml, 1);
    y->arena = a;
    y->diag = diag_open(a);
    return y;
}

struct diag_source *yaml_source(struct yaml *y, const char *name, const char *text, size_t size)
{
    struct diag_source *s = ARENA_TAKE(y->arena, struct diag_source, 1);
    bool mark = size >= 3 && memcmp(text, "\xef\xbb\xbf", 3) == 0; /* of UTF-8, as editors of Windows write it */
    text += mark ? 3 : 0;
    size -= mark ? 3 : 0;
    *s = (struct diag_source){.name = name, .text = text, .size = size, .order = y->sources++};
    return s;
}

struct yaml_node *yaml_make(struct yaml *y, enum yaml_kind kind, struct diag_place at, const char *text)
{
    struct yaml_node *node = ARENA_TAKE(y->arena, struct yaml_node, 1);
    *node = (struct yaml_node){.kind = kind, .at = at, .text = text, .plain = true};
    return node;
}

void yaml_append(struct yaml_node *parent, struct yaml_node *key, struct yaml_node *value)
{
    value->key = key;
    value->next = NULL;
    *(parent->last ? &parent->last->next : &parent->first) = value;
    parent->last = value;
    parent->n++;
}

bool yaml_null(const struct yaml_node *node)
{
    return node->kind == YAML_SCALAR && node->plain &&
           (strcmp(node->text, "null") == 0 || strcmp(node->text, "~") == 0);
}

struct yaml_node *yaml_get(const struct yaml_node *map, const char *key)
{
    if (map->kind != YAML_MAP) return NULL;
    for (struct yaml_node *item = map->first; item; item = item->next)
        if (strcmp(item->key->text, key) == 0) return item;
    return NULL;
}

struct yaml_node *yaml_find(struct yaml_node *map, const char *path)
{
    char part[128];
    while (map) {
        size_t n = strcspn(path, ".");
        if (n >= sizeof part) return NULL;
        memcpy(part, path, n);
        part[n] = '\0';
        map = yaml_get(map, part);
        if (!path[n]) return map;
        path += n + 1;
    }
    return NULL;
}

/* Reads and checks the bytes of a YAML text. What is refused here libyaml would refuse too, but
   without a line, or take for an encoding other than UTF-8. */

enum { SIZE_MAX_BYTES = 4 << 20 };

const char *yaml_bytes_text(const char *file, struct arena *a, size_t *size)
{
    struct bytes b;
    if (bytes_piped(file)) return bytes_piped_read(file, SIZE_MAX_BYTES, size);
    FILE *in = memory_fopen(file, "rb");
    bool good = in && bytes_stream(in, 1 << 16, SIZE_MAX_BYTES, a, &b);
    int why = errno;
    if (in) fclose(in);
    errno = why;
    if (good) *size = b.n;
    return good ? b.at : NULL;
}

struct diag_source *yaml_bytes_read(struct yaml *y, const char *file, struct diag_place named)
{
    size_t size;
    struct stat s;
    bool waits = named.source && !named.source->made && stat(file, &s) == 0 &&
                 S_ISFIFO(s.st_mode); /* until somebody writes into it */
    const char *text = waits ? NULL : yaml_bytes_text(file, y->arena, &size);
    bool pipe = waits || (!text && errno == ENXIO);
    const char *why = pipe ? "it is a pipe" : text ? "" : strerror(errno);
    const char *near = text ? NULL : bytes_near(file, y->arena);
    if (near) near = arena_format(y->arena, "did you mean %s?", near);
    y->missing = y->missing || !text;
    if (!text && named.source)
        diag_add(y->diag, named,
                 pipe   ? "only what the command line names may be one: save it as a file"
                 : near ? near
                        : "a path in a file is relative to that file's folder",
                 "cannot read '%s': %s", file, why);
    else if (!text)
        diag_add(y->diag, (struct diag_place){yaml_source(y, file, "", 0), 0, 0, 0}, near, "cannot be read: %s", why);
    if (!text) return NULL;
    const char *name = arena_text(y->arena, file);
    struct yaml_file *f = ARENA_TAKE(y->arena, struct yaml_file, 1);
    f->name = name;
    *(y->last_file ? &y->last_file->next : &y->files) = f;
    y->last_file = f;
    struct diag_source *source = yaml_source(y, name, text, size);
    source->named = named;
    return source;
}

/* UTF-8 without NUL or control characters, at most 4 MiB; else an error is reported. */
static bool text_good(struct yaml *y, const struct diag_source *s)
{
    struct diag_place at = {s, 1, 1, 1}, whole = {s, 0, 0, 0};
    bool other = s->size >= 2 && (memcmp(s->text, "\xff\xfe", 2) == 0 || memcmp(s->text, "\xfe\xff", 2) == 0);
    if (s->size > SIZE_MAX_BYTES)
        return diag_add(y->diag, whole,
                        "is it a scene? measured data, and the cells of a large design (cells: FILE.csv), belong in "
                        "files of their own",
                        "larger than %d MiB", SIZE_MAX_BYTES >> 20);
    if (other) return diag_add(y->diag, whole, "save the file as UTF-8", "encoded as UTF-16 or UTF-32");
    if (s->size >= 4 && (memcmp(s->text, "RIFF", 4) == 0 || memcmp(s->text, "fLaC", 4) == 0))
        return diag_add(y->diag, whole, "rasp play plays it, rasp plot draws it", "is a sound, not a text");
    for (size_t i = 0; i < s->size;) {
        uint32_t code = 0;
        int length = text_utf8(s->text + i, s->size - i, &code);
        if (length == 0) return diag_add(y->diag, at, "save the file with the encoding UTF-8", "not valid UTF-8");
        if (code == 0) return diag_add(y->diag, at, "save the file as plain text in UTF-8", "a NUL byte");
        bool printable = code == '\t' || code == '\n' || code == '\r' || (code >= 0x20 && code <= 0x7e) ||
                         code == 0x85 || (code >= 0xa0 && code != 0xfeff && code != 0xfffe && code != 0xffff);
        if (!printable) return diag_add(y->diag, at, "remove it", "control character U+%04X", (unsigned)code);
        i += (size_t)length;
        at.column++;
        if (code == '\n' || (code == '\r' && (i == s->size || s->text[i] != '\n')) || code == 0x85 || code == 0x2028 ||
            code == 0x2029) {
            at.line++;
            at.column = 1;
        }
    }
    return true;
}

/* libyaml's events into nodes. libyaml itself takes duplicate keys silently and leaves aliases to its
   caller; an anchor counts from the end of its value, so that nothing can contain itself. */

enum { NODES_MAX = 100000, DEPTH_MAX = 64, KEYS_MAX = 1000, ANCHORS_MAX = 1000 };

struct event {
    yaml_event_type_t type;
    struct diag_place at;
    const char *text, *anchor;
    size_t size;
    bool plain, tagged;
};

struct anchor {
    const char *name;
    const struct yaml_node *node;
};

struct parse {
    struct yaml *y;
    const struct diag_source *source;
    yaml_parser_t *parser;
    int shift; /* characters before the parsed text on its first line */
    int depth;
    struct anchor *anchors;
    int n_anchors;
};

/* ------------------------------------------------------------------ events */

static int column_of(const struct parse *p, const yaml_mark_t *mark)
{
    return (int)mark->column + 1 + (mark->line == 0 ? p->shift : 0);
}

static void syntax_error(struct parse *p)
{
    if (p->parser->error == YAML_MEMORY_ERROR) memory_out("for %.200s", p->source->name);
    const char *problem = p->parser->problem ? p->parser->problem : "cannot be read";
    const char *context = p->parser->context ? p->parser->context : "",
               *cure = "check quotes, brackets and indentation near here";
    const yaml_mark_t *mark = &p->parser->problem_mark, *began = &p->parser->context_mark;
    bool earlier = *context && began->line < mark->line, colon = strstr(problem, "expected ':'") != NULL;
    if (earlier && strstr(context, "quoted scalar")) {
        problem = "these quotes are not closed";
        cure = "put the same quotes behind the text";
        mark = began;
    } else if (earlier && strstr(context, "flow") && !p->source->option)
        cure = arena_format(p->y->arena, "close the bracket that opens on line %d, or put a comma between its entries",
                            (int)began->line + 1);
    else if (strstr(problem, "cannot start any token") || strstr(problem, "tab character"))
        cure = "indent with spaces, not tabs; put quotes around a text that starts with @, ` or %";
    else if (strstr(problem, "mapping values"))
        cure = "check the indentation, and the key above for its ': '; put quotes around a text that holds ': '";
    else if (strstr(problem, "expected key") || strstr(problem, "block end") || colon)
        cure = "check the indentation, and that each key is followed by ': ' with a space";
    if (earlier && colon) mark = began; /* the key that lacks it; it is missed on a later line only */
    const struct diag_place at = {p->source, (int)mark->line + 1, column_of(p, mark), 1};
    diag_add(p->y->diag, at, cure, "not valid YAML: %s", problem);
}

static const char *copy_of(struct parse *p, const yaml_char_t *s, size_t size)
{
    char *copy = arena_take(p->y->arena, size + 1, 1);
    memcpy(copy, s, size);
    return copy;
}

static bool event_next(struct parse *p, struct event *ev)
{
    yaml_event_t raw;
    if (!yaml_parser_parse(p->parser, &raw)) {
        syntax_error(p);
        return false;
    }
    const yaml_mark_t *from = &raw.start_mark, *to = &raw.end_mark;
    bool one_line = from->line == to->line;
    int width = one_line && to->column > from->column ? (int)(to->column - from->column) : one_line;
    *ev = (struct event){.type = raw.type, .at = {p->source, (int)from->line + 1, column_of(p, from), width}};
    const yaml_char_t *anchor = NULL;
    if (raw.type == YAML_SCALAR_EVENT) {
        ev->text = copy_of(p, raw.data.scalar.value, raw.data.scalar.length);
        ev->size = raw.data.scalar.length;
        ev->plain = raw.data.scalar.style == YAML_PLAIN_SCALAR_STYLE;
        ev->tagged = raw.data.scalar.tag != NULL;
        anchor = raw.data.scalar.anchor;
    } else if (raw.type == YAML_SEQUENCE_START_EVENT) {
        ev->tagged = raw.data.sequence_start.tag != NULL;
        anchor = raw.data.sequence_start.anchor;
    } else if (raw.type == YAML_MAPPING_START_EVENT) {
        ev->tagged = raw.data.mapping_start.tag != NULL;
        anchor = raw.data.mapping_start.anchor;
    } else if (raw.type == YAML_ALIAS_EVENT)
        anchor = raw.data.alias.anchor;
    ev->anchor = anchor ? copy_of(p, anchor, strlen((const char *)anchor)) : NULL;
    yaml_event_delete(&raw);
    return true;
}

/* ------------------------------------------------------------------ nodes */

/* NULL: there are too many, by the fault of what stands at `cause`. */
static struct yaml_node *node_new(struct parse *p, enum yaml_kind kind, struct diag_place at, const char *text,
                                  struct diag_place cause)
{
    if (++p->y->nodes <= NODES_MAX) return yaml_make(p->y, kind, at, text);
    diag_add(p->y->diag, cause,
             "a scene needs a few hundred, and a design has many cells in a table (cells: FILE.csv); look for aliases "
             "(*name) of aliases",
             "more than %d values after expanding aliases", NODES_MAX);
    return NULL;
}

/* A copy keeps the place of what it is a copy of; too many are the alias's fault. */
static struct yaml_node *node_copy(struct parse *p, const struct yaml_node *from, struct diag_place alias)
{
    struct yaml_node *copy = node_new(p, from->kind, from->at, from->text, alias);
    if (!copy) return NULL;
    copy->plain = from->plain;
    for (const struct yaml_node *item = from->first; item; item = item->next) {
        struct yaml_node *value = node_copy(p, item, alias);
        if (!value) return NULL;
        yaml_append(copy, item->key, value);
    }
    return copy;
}

static struct yaml_node *node_read(struct parse *p, const struct event *ev);

/* A map or list starts with an event of its own; its place is widened to its end when that is on the same line. */
static void close_place(struct yaml_node *node, const struct event *end)
{
    if (end->at.line == node->at.line && end->at.column >= node->at.column)
        node->at.width = end->at.column + end->at.width - node->at.column;
    else
        node->at.width = 0;
}

static struct yaml_node *list_read(struct parse *p, const struct event *start)
{
    struct yaml_node *list = node_new(p, YAML_LIST, start->at, NULL, start->at), *item;
    struct event ev;
    while (list && event_next(p, &ev)) {
        if (ev.type == YAML_SEQUENCE_END_EVENT) {
            close_place(list, &ev);
            return list;
        }
        if (!(item = node_read(p, &ev))) return NULL;
        yaml_append(list, NULL, item);
    }
    return NULL;
}

static bool pair_read(struct parse *p, struct yaml_node *map, const struct event *key_event)
{
    struct yaml_node *key = node_read(p, key_event), *value = NULL;
    struct event ev;
    if (!key || !event_next(p, &ev) || !(value = node_read(p, &ev))) return false;
    if (map->n == KEYS_MAX) return diag_add(p->y->diag, key->at, NULL, "more than %d keys in one map", KEYS_MAX);
    const struct yaml_node *same = key->kind == YAML_SCALAR ? yaml_get(map, key->text) : NULL;
    if (key->kind != YAML_SCALAR)
        diag_add(p->y->diag, key->at, "write a word, a colon and a space", "a key must be a word, not a map or list");
    else if (key->plain && strcmp(key->text, "<<") == 0)
        diag_add(p->y->diag, key->at, "write the keys out, or put them into a file of their own and include: it",
                 "'<<' is not supported");
    else if (same)
        diag_add(p->y->diag, key->at, arena_format(p->y->arena, "first set on line %d", same->key->at.line),
                 "duplicate key '%s'", diag_shown(p->y->diag, key->text));
    else
        yaml_append(map, key, value);
    return true;
}

static struct yaml_node *map_read(struct parse *p, const struct event *start)
{
    struct yaml_node *map = node_new(p, YAML_MAP, start->at, NULL, start->at);
    struct event ev;
    while (map && event_next(p, &ev)) {
        if (ev.type == YAML_MAPPING_END_EVENT) {
            close_place(map, &ev);
            return map;
        }
        if (!pair_read(p, map, &ev)) return NULL;
    }
    return NULL;
}

static struct yaml_node *node_read(struct parse *p, const struct event *ev)
{
    if (ev->tagged)
        diag_add(p->y->diag, ev->at, "remove the tag (!...); put quotes around a text that starts with !",
                 "tags are not supported");
    if (p->depth == DEPTH_MAX) {
        diag_add(p->y->diag, ev->at, NULL, "nested more than %d deep", DEPTH_MAX);
        return NULL;
    }
    p->depth++;
    struct yaml_node *node = NULL;
    if (ev->type == YAML_ALIAS_EVENT) {
        int i = p->n_anchors - 1;
        while (i >= 0 && strcmp(p->anchors[i].name, ev->anchor) != 0)
            i--;
        if (i >= 0)
            node = node_copy(p, p->anchors[i].node, ev->at);
        else
            diag_add(p->y->diag, ev->at,
                     "an anchor (&name) must stand before its aliases (*name); put quotes around a text that starts "
                     "with *",
                     "no anchor '%s' before this", diag_shown(p->y->diag, ev->anchor));
    } else if (ev->type == YAML_SCALAR_EVENT) {
        node = node_new(p, YAML_SCALAR, ev->at, ev->text, ev->at);
        if (node) node->plain = ev->plain;
        if (node && strlen(ev->text) != ev->size) {
            diag_add(p->y->diag, ev->at, "remove \\0 or \\x00", "a text must not hold a NUL character");
            node = NULL;
        }
    } else if (ev->type == YAML_SEQUENCE_START_EVENT)
        node = list_read(p, ev);
    else if (ev->type == YAML_MAPPING_START_EVENT)
        node = map_read(p, ev);
    p->depth--;
    if (!node || !ev->anchor || ev->type == YAML_ALIAS_EVENT) return node;
    if (p->n_anchors == ANCHORS_MAX) {
        diag_add(p->y->diag, ev->at, NULL, "more than %d anchors", ANCHORS_MAX);
        return NULL;
    }
    p->anchors = arena_more(p->y->arena, p->anchors, p->n_anchors, sizeof *p->anchors);
    p->anchors[p->n_anchors++] = (struct anchor){ev->anchor, node};
    return node;
}

/* ------------------------------------------------------------------ documents */

static struct yaml_node *document_read(struct parse *p)
{
    struct event ev;
    if (!event_next(p, &ev) || !event_next(p, &ev)) /* the stream's start, then the document's */
        return NULL;
    if (ev.type == YAML_STREAM_END_EVENT) {
        diag_add(p->y->diag, (struct diag_place){p->source, 0, 0, 0}, "rasp new prints a scene to start from",
                 "there is nothing in it");
        return NULL;
    }
    if (!event_next(p, &ev)) return NULL;
    struct yaml_node *root = node_read(p, &ev);
    if (!root || !event_next(p, &ev) || !event_next(p, &ev)) /* the document's end, then the stream's */
        return NULL;
    if (ev.type == YAML_STREAM_END_EVENT) return root;
    diag_add(p->y->diag, ev.at, "one file holds one document: put the second into a file of its own",
             "a second document starts here");
    return NULL;
}

static struct yaml_node *text_read(struct yaml *y, const struct diag_source *source, size_t from)
{
    yaml_parser_t parser;
    if (!yaml_parser_initialize(&parser)) memory_out("for %.200s", source->name);
    struct parse p = {.y = y, .source = source, .parser = &parser, .shift = (int)text_utf8_count(source->text, from)};
    yaml_parser_set_encoding(&parser, YAML_UTF8_ENCODING);
    yaml_parser_set_input_string(&parser, (const unsigned char *)source->text + from, source->size - from);
    struct yaml_node *root = document_read(&p);
    yaml_parser_delete(&parser);
    return root;
}

struct yaml_node *yaml_parse(struct yaml *y, const struct diag_source *source)
{
    return text_good(y, source) ? text_read(y, source, 0) : NULL;
}

struct yaml_node *yaml_parse_value(struct yaml *y, const struct diag_source *source, size_t from)
{
    if (!text_good(y, source)) return NULL;
    from += strspn(source->text + from, " \t");
    if (source->text[from] && strchr("[{\"'", source->text[from])) return text_read(y, source, from);
    size_t size = source->size - from;
    while (size > 0 && strchr(" \t\r\n", source->text[from + size - 1]))
        size--;
    int column = (int)text_utf8_count(source->text, from) + 1, width = (int)text_utf8_count(source->text + from, size);
    struct diag_place at = {source, 1, column, width > 0 ? width : 1};
    return yaml_make(y, YAML_SCALAR, at, arena_format(y->arena, "%.*s", (int)size, source->text + from));
}
