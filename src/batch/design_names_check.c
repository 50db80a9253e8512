/* See design_names_check.h. A stimulus NAME has the files NAME.wav, NAME.scene.yaml, NAME.json, and NAME.WORD.wav or NAME.WORD.csv of stems and of contacts.

   Sets are rendered here and played there: what Windows, macOS and memory sticks cannot tell apart, or cannot hold, is no name either. They do not tell a from A; Windows takes CON, and
   CON.wav, for a device, and leaves off a dot at the end. */
#include "batch/design_names_check.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum { PART_LONGEST = 200, NAME_LONGEST = 1000 };

/* ------------------------------------------------------------------ one name */

static bool ends_in(const char *s, size_t n, const char *ending)
{
    size_t m = strlen(ending);
    return n >= m && strncasecmp(s + n - m, ending, m) == 0;
}

static bool is_device(const char *s, size_t n)
{
    static const char *const words[] = {"con", "prn", "aux", "nul", NULL}, *const numbered[] = {"com", "lpt", NULL};
    size_t stem = strcspn(s, "./");
    stem = stem < n ? stem : n;
    for (int i = 0; words[i]; i++)
        if (stem == 3 && strncasecmp(s, words[i], 3) == 0)
            return true;
    for (int i = 0; numbered[i]; i++)
        if (stem == 4 && strncasecmp(s, numbered[i], 3) == 0 && s[3] >= '1' && s[3] <= '9')
            return true;
    return false;
}

/* What is wrong with a part between slashes; NULL: nothing. */
static const char *part_fault(const char *s, size_t n, const char **cure)
{
    static const char *const endings[] = {".wav", ".csv", ".npy", ".json", ".yaml", ".yml", NULL};
    *cure = "write another template for name:, or other labels";
    if (n == 0)
        return "has a folder without a name";
    if (s[0] == '.')
        return "has a part that begins with a dot: it would be hidden, or lie outside of the output folder";
    if (n > PART_LONGEST)
        return "has a part of more than 200 letters";
    if (s[n - 1] == '.')
        return "has a part that ends with a dot, which Windows leaves off";
    if (is_device(s, n))
        return "has a part that is a device on Windows, which cannot have such a file";
    *cure = "leave the ending out: each file gets its own";
    for (int i = 0; endings[i]; i++)
        if (ends_in(s, n, endings[i]))
            return "ends as a file does";
    return NULL;
}

static const char *name_fault(const char *name, const char **cure)
{
    const char *fault = NULL;
    for (const char *s = name; !fault; s++) {
        size_t n = strcspn(s, "/");
        fault = part_fault(s, n, cure);
        s += n;
        if (!*s)
            break;
    }
    if (!fault && strlen(name) > NAME_LONGEST) {
        *cure = "write a shorter template for name:";
        fault = "has more than 1000 letters";
    }
    size_t first = strcspn(name, "/"); /* a folder SHA256SUMS/ would stand where the file shall be */
    if (!fault && (strcasecmp(name, "manifest") == 0 || strncasecmp(name, "manifest.", 9) == 0 || strcasecmp(name, "timings") == 0 || (first == 10 && strncasecmp(name, "SHA256SUMS", first) == 0))) {
        *cure = "write another template for name:";
        fault = "is that of a table of the set";
    }
    return fault;
}

/* ------------------------------------------------------------------ two names */

static int by_name(const void *pa, const void *pb)
{
    const struct design_stimulus *const *a = pa, *const *b = pb;
    int order = strcasecmp((*a)->name, (*b)->name);
    return order ? order : *a < *b ? -1 : *a > *b;
}

static int name_only(const void *name, const void *p)
{
    return strcasecmp(name, (*(const struct design_stimulus *const *)p)->name);
}

/* "wood, 2 Hz, replicate 2", "the recording wood.wav" */
static const char *called(const struct design_reading *r, const struct design_stimulus *s)
{
    const char *labels = design_reading_labels(r->design, s->level, r->arena);
    if (s->recording)
        return arena_format(r->arena, "the recording %s", s->recording);
    labels = *labels ? labels : "the scene";
    return r->design->replicates > 1 ? arena_format(r->arena, "%s, replicate %d", labels, s->replicate) : labels;
}

/* What would tell the two apart. */
static const char *apart(const struct design_reading *r, const struct design_stimulus *a, const struct design_stimulus *b)
{
    if (a->recording || b->recording)
        return "give the recording a name: of its own";
    for (int f = 0; f < r->design->n_factors; f++)
        if (a->level[f] != b->level[f])
            return yaml_get(r->root, "name") ? arena_format(r->arena, "put {%s} into name:, or write labels that differ in letters or digits", r->design->factors[f].name)
                                             : "write labels that differ in letters or digits, or a template for name:";
    return a->replicate != b->replicate ? "put {replicate} into name:" : "the cell is listed twice: remove one, or write replicates:";
}

static struct diag_place place_of(const struct design_reading *r, const struct design_stimulus *s)
{
    const struct yaml_node *entry = r->cells[s->cell].entry, *name = yaml_get(s->recording ? entry : r->root, "name"), *factors = yaml_get(r->root, "factors");
    return name ? name->at : entry ? entry->at : factors ? factors->key->at : r->root->at;
}

static void clash(const struct design_reading *r, const struct design_stimulus *a, const struct design_stimulus *b)
{
    const struct design_stimulus *first = a->cell < b->cell || (a->cell == b->cell && a->replicate < b->replicate) ? a : b, *second = first == a ? b : a;
    if (strcmp(a->name, b->name) == 0)
        diag_add(r->yaml->diag, place_of(r, second), apart(r, a, b), "two stimuli would be named '%s': %s; and %s", diag_shown(r->yaml->diag, a->name), called(r, first),
                 called(r, second));
    else if (strcasecmp(a->name, b->name) == 0)
        diag_add(r->yaml->diag, place_of(r, second), "write labels that differ in more than capitals, or another template for name:",
                 "two stimuli would be named '%s' and '%s', which Windows and macOS take for one name", diag_shown(r->yaml->diag, first->name), diag_shown(r->yaml->diag, second->name));
    else
        diag_add(r->yaml->diag, place_of(r, second), "write another template for name:, or other labels",
                 "files of '%s' and of '%s' could have one name, as .WORD may follow a name", diag_shown(r->yaml->diag, first->name),
                 diag_shown(r->yaml->diag, second->name));
}

/* The stimulus whose name the name continues with a dot and a word; NULL: there is none. */
static const struct design_stimulus *continued(const struct design_stimulus **sorted, int n, const char *name, struct arena *a)
{
    const char *slash = strrchr(name, '/');
    for (const char *dot = strchr(slash ? slash : name, '.'); dot; dot = strchr(dot + 1, '.')) {
        if (!isalpha((unsigned char)dot[1]) && dot[1] != '_')
            continue;
        const char *stem = arena_format(a, "%.*s", (int)(dot - name), name);
        const struct design_stimulus **found = bsearch(stem, sorted, (size_t)n, sizeof *sorted, name_only);
        if (found)
            return *found;
    }
    return NULL;
}

/* One clash is told: they come in crowds. */
static void clashes(const struct design_reading *r)
{
    const struct design *d = r->design;
    const struct design_stimulus **sorted = ARENA_TAKE(r->arena, const struct design_stimulus *, d->n_stimuli + 1);
    for (int i = 0; i < d->n_stimuli; i++)
        sorted[i] = &d->stimuli[i];
    qsort(sorted, (size_t)d->n_stimuli, sizeof *sorted, by_name);
    for (int i = 0; i < d->n_stimuli; i++) {
        const struct design_stimulus *other = i > 0 && strcasecmp(sorted[i]->name, sorted[i - 1]->name) == 0 ? sorted[i - 1] : NULL;
        other = other ? other : continued(sorted, d->n_stimuli, sorted[i]->name, r->arena);
        if (other) {
            clash(r, other, sorted[i]);
            return;
        }
    }
}

void design_names_check(const struct design_reading *r)
{
    for (int i = 0; i < r->design->n_stimuli; i++) {
        const struct design_stimulus *s = &r->design->stimuli[i];
        const char *cure, *fault = name_fault(s->name, &cure);
        if (!fault)
            continue;
        diag_add(r->yaml->diag, place_of(r, s), cure, "the name '%s' of %s %s", diag_shown(r->yaml->diag, s->name), called(r, s), fault);
        return;
    }
    clashes(r);
}
