/* See render_verify.h. Compared is what was computed, before its level is set and its samples are rounded to the file's encoding. */
#include "cmd/render_verify.h"

#include <jansson.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/outfile.h"
#include "cmd/accuracy.h"
#include "scene/accuracy.h"
#include "scene/keys.h"

enum { REFERENCE, OWN };

/* The preset reference, but nowhere coarser than what is verified. */
static struct accuracy finest(const struct accuracy *own)
{
    struct accuracy set = *own;
    accuracy_preset(&set, "reference");
    for (int k = 0; k < KNOBS; k++) {
        double x = accuracy_knob(own, (enum knob)k), y = accuracy_knob(&set, (enum knob)k);
        bool up = keys_knobs[k].scale == KEY_STEPS || keys_knobs[k].scale == KEY_METHOD;
        accuracy_turn(&set, (enum knob)k, up ? fmax(x, y) : keys_knobs[k].scale == KEY_ERROR && x == 0 ? y : fmin(x, y));
    }
    return set;
}

static bool measure(struct accuracy_sweep *s, struct err *e)
{
    if (!accuracy_child_folder(s, e))
        return false;
    bool ok = true;
    for (int i = 0; ok && i < s->n_renders; i++)
        ok = accuracy_child(s, i, e) && (s->renders[i].code == 0 || err_set(e, (enum err_kind)s->renders[i].code, "%s", s->renders[i].words)) && accuracy_compare(s, i, e);
    accuracy_child_end(s);
    return ok;
}

/* The summary once more, with what was measured. */
static bool summary_again(struct render_report *r, double measured, struct arena *a, struct err *e)
{
    json_t *whole = json_loads(r->summary, 0, NULL), *accuracy = json_object_get(whole, "accuracy");
    struct outfile file = {.fd = -1};
    const char *path = NULL;
    if (!accuracy)
        json_object_set_new(whole, "accuracy", accuracy = json_object());
    json_object_set_new(accuracy, "measured_db", isfinite(measured) ? json_real(measured) : json_null());
    char *text = json_dumps(whole, JSON_INDENT(2) | JSON_REAL_PRECISION(9) | JSON_ENSURE_ASCII);
    r->summary = arena_format(a, "%s\n", text ? text : "{}");
    free(text);
    json_decref(whole);
    for (int i = 0; i < r->n_files; i++)
        path = strcmp(r->files[i].kind, "summary") ? path : r->files[i].path;
    bool ok = outfile_open(&file, path, e);
    if (ok)
        fputs(r->summary, file.stream);
    ok = ok && outfile_settle(&file, e) && outfile_commit(&file, e);
    outfile_drop(&file);
    return ok;
}

static void note(struct render_report *r, const char *text, struct arena *a)
{
    const char **notes = ARENA_TAKE(a, const char *, r->n_notes + 1);
    memcpy(notes, r->notes, (size_t)r->n_notes * sizeof *notes);
    notes[r->n_notes++] = text;
    r->notes = notes;
}

bool render_verify(struct cmd_call *c, const char *file, const struct scene *asked, struct render_report *r, struct err *e)
{
    struct accuracy_sweep s = {.call = c, .file = file, .scene = *asked, .until = INFINITY, .high = -1, .n_renders = 2, .reference = REFERENCE};
    s.renders = ARENA_TAKE(c->arena, struct accuracy_render, 2);
    s.force = accuracy_silent(asked);
    s.renders[REFERENCE] = (struct accuracy_render){.set = finest(&r->accuracy), .cpu = HUGE_VAL, .contact_share = NAN};
    s.renders[OWN] = (struct accuracy_render){.set = r->accuracy, .cpu = HUGE_VAL, .contact_share = NAN};
    if (!measure(&s, e))
        return false;
    double measured = -s.renders[OWN].error.snr;
    if (!summary_again(r, measured, c->arena, e))
        return false;
    note(r, isfinite(measured) ? arena_format(c->arena, "accuracy: %.1f dB measured, against the reference", measured) : "accuracy: measured: the same bits as the reference", c->arena);
    return isnan(asked->accuracy.error) || measured <= asked->accuracy.error ||
           err_set(e, ERR_DIFFERS, "%s: accuracy.error: %.6g dB is not kept: %.1f dB measured against the reference; the files stay as they are: ask for less error, or say the knobs",
                   file, asked->accuracy.error, measured);
}
