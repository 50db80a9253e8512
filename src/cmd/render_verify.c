/* See render_verify.h. Compared is what was computed, before its level is set and its samples are rounded to the file's encoding. */
#include "cmd/render_verify.h"

#include <jansson.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/outfile.h"
#include "cmd/accuracy.h"
#include "pipeline/plan_scene.h"
#include "scene/accuracy.h"
#include "scene/keys.h"
#include "scene/scene_places.h"

enum { REFERENCE, OWN };

/* ------------------------------------------------------------------ the reference

   The preset reference, but of every knob at least twice as fine as what is verified, so that no more than a fraction of its error (2^-order of it) is left out of what is
   measured. Where that is beyond the knob's range, or a stage refuses it (memory), the reference is as fine as it may be, and the knob is told. Ramps of one sample are as
   fine as they go. */

static bool steps(int knob)
{
    return keys_knobs[knob].scale == KEY_STEPS;
}

static double finer(int knob, double own)
{
    return steps(knob) ? fmin(2 * own, keys_knobs[knob].high) : fmax(floor(own / 2), keys_knobs[knob].low);
}

/* Is `than` at least twice as fine as own, or own as fine as it goes? */
static bool twice(int knob, double own, double than)
{
    return steps(knob) ? than >= 2 * own : own <= 1 || than <= own / 2;
}

/* `raised`: set of knobs that are finer than the preset has them. */
static struct accuracy finest(const struct accuracy *own, unsigned used, unsigned *raised)
{
    struct accuracy set = *own;
    accuracy_preset(&set, "reference");
    *raised = 0;
    for (int k = 0; k < KNOBS; k++) {
        double x = accuracy_knob(own, (enum knob)k), y = accuracy_knob(&set, (enum knob)k), z = used & 1u << k ? finer(k, x) : x;
        double best = steps(k) ? fmax(z, y) : fmin(z, y);
        accuracy_turn(&set, (enum knob)k, best);
        *raised |= best != y ? 1u << k : 0;
    }
    return set;
}

/* What is raised and refused (heights that take too much memory) is had one and a half times as fine as what is verified, or as fine, never coarser than the preset has it:
   one knob after another, until the reference is rendered. */
static bool reference(struct accuracy_sweep *s, unsigned raised, struct err *e)
{
    struct accuracy_render *r = &s->renders[REFERENCE];
    struct accuracy preset = r->set;
    accuracy_preset(&preset, "reference");
    s->reference = -1; /* that a reference is refused would be an error */
    bool ok = accuracy_child(s, REFERENCE, e);
    for (int i = 0; ok && r->code != 0 && i < 2 * KNOBS; i++) {
        enum knob k = (enum knob)(i / 2);
        double own = accuracy_knob(&s->renders[OWN].set, k), least = accuracy_knob(&preset, k);
        if (!(raised & 1u << k) || (!steps(k) && i % 2 == 0))
            continue;
        accuracy_turn(&r->set, k, steps(k) ? fmax(i % 2 ? own : floor(1.5 * own), least) : fmin(own, least));
        ok = accuracy_child(s, REFERENCE, e);
    }
    s->reference = REFERENCE;
    return ok;
}

static bool measure(struct accuracy_sweep *s, unsigned raised, struct err *e)
{
    if (!accuracy_child_folder(s, e))
        return false;
    bool ok = true;
    for (int i = 0; ok && i < s->n_renders; i++) {
        const struct accuracy_render *r = &s->renders[i];
        ok = (i == REFERENCE ? reference(s, raised, e) : accuracy_child(s, i, e)) && (r->code == 0 || err_set(e, (enum err_kind)r->code, "%s", r->words)) && accuracy_compare(s, i, e);
    }
    accuracy_child_end(s);
    return ok;
}

/* Of which knobs there is nothing twice as fine: "" or what is told. */
static const char *unmeasured(const struct accuracy_sweep *s, unsigned used, struct arena *a)
{
    const char *text = "";
    for (int k = 0; k < KNOBS; k++) {
        double own = accuracy_knob(&s->renders[OWN].set, (enum knob)k), than = accuracy_knob(&s->renders[REFERENCE].set, (enum knob)k);
        if (used & 1u << k && !twice(k, own, than))
            text = arena_format(a, "%s; %s of %s %.6g, as the reference has no finer than %.6g", text, than == own ? "nothing" : "less than all", keys_knobs[k].name, own, than);
    }
    return text;
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
    unsigned used, raised;
    s.scene.accuracy = r->accuracy;
    if (!plan_scene_knobs(&s.scene, c->arena, &used, e))
        return false;
    s.renders[REFERENCE] = (struct accuracy_render){.set = finest(&r->accuracy, used, &raised), .cpu = HUGE_VAL, .contact_share = NAN};
    s.renders[OWN] = (struct accuracy_render){.set = r->accuracy, .cpu = HUGE_VAL, .contact_share = NAN};
    if (!measure(&s, raised, e))
        return false;
    double measured = -s.renders[OWN].error.snr;
    if (!summary_again(r, measured, c->arena, e))
        return false;
    const char *less = unmeasured(&s, used, c->arena);
    note(r, isfinite(measured) ? arena_format(c->arena, "accuracy: %.1f dB measured, against the reference%s", measured, less)
                               : arena_format(c->arena, "accuracy: measured: the same bits as the reference%s", less), c->arena);
    return isnan(asked->accuracy.error) || measured <= asked->accuracy.error || err_about(e, NULL, "accuracy.error") ||
           err_set(e, ERR_DIFFERS, "accuracy.error: %.6g dB is not kept: %.1f dB measured against the reference; the files stay as they are: ask for less (accuracy.error: %.0f dB), or say the knobs",
                   asked->accuracy.error, measured, ceil(measured)) ||
           scene_places_tell(asked, e);
}
