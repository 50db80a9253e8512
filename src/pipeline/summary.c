#include "pipeline/summary.h"

#include <jansson.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "convolution/ring_choice.h"
#include "num/real.h"
#include "response/modes.h"
#include "trajectory/load.h"

static const char *const summary_units[] = {"m", "m/s", "m/s^2", "Pa"}; /* by enum modes_quantity */

enum { MOST_OF_BOARD = (int)(sizeof ((struct board *)0)->warnings / sizeof ((struct board *)0)->warnings[0]) };

static void warn(struct render_report *report, const char *text)
{
    report->warnings[report->n_warnings++] = text;
}

static void warn_contact(const struct contact *c, const struct board *b, struct render_report *report, struct arena *a)
{
    for (int k = 0; k < b->n_warnings && k < MOST_OF_BOARD; k++)
        warn(report, arena_text(a, b->warnings[k])); /* the text ends with its run */
    if (b->n_warnings > MOST_OF_BOARD)
        warn(report, arena_format(a, "contact '%s': %d more remarks", c->name, b->n_warnings - MOST_OF_BOARD));
    if (b->lifted > 0)
        warn(report, arena_format(a, "contact '%s': the hand lifts the scraper off for %.4g s in all (negative normal force); no force then",
                                  c->name, b->lifted));
    if (b->unstated && b->quantity >= 0)
        warn(report, arena_format(a, "contact '%s': its WAV response does not say what it is in, and is summed as if in %s, like its mode table",
                                  c->name, summary_units[b->quantity]));
}

void summary_warnings(const struct scene *s, const struct run *const *runs, struct render_report *report, struct arena *a)
{
    int older = 0;
    while (report->older[older])
        older++;
    report->warnings = ARENA_TAKE(a, const char *, s->n_contacts * (MOST_OF_BOARD + 3) + 2 + older);
    for (int i = 0; i < s->n_contacts; i++)
        if (runs[i])
            warn_contact(&s->contacts[i], &runs[i]->board, report, a);
    if (report->sounds && report->sound.silent)
        warn(report, "the sound is silent: no level was set");
    if (report->sounds && report->sound.ramp < s->output.ramp - 0.5 / s->output.sample_rate)
        warn(report, arena_format(a, "output.ramp: the sound is too short for ramps of %.4g s; they take half of it each, %.4g s", s->output.ramp,
                                  report->sound.ramp));
    for (int i = 0; i < older; i++)
        warn(report, arena_format(a, "%s is not of this render, which writes no such file; it is older, and stays as it is", report->older[i]));
}

/* A number, or null for one that is not finite. */
static json_t *number(double x)
{
    return isfinite(x) ? json_real(x) : json_null();
}

static double decibel(double x)
{
    return x > 0 ? 20 * real_log10(x) : -HUGE_VAL;
}

/* Each listening place of several: what is heard there, unscaled. */
static json_t *channels_json(const struct scene *s, const struct sound_report *o)
{
    json_t *all = json_array();
    for (int k = 0; k < o->channels; k++) {
        const double *place = s->output.listen.places + 3 * k;
        json_array_append_new(all, json_pack("{s:[o, o, o], s:o, s:o}", "place_m", number(place[0]), number(place[1]), number(place[2]), "peak",
                                             number(o->channel_peak[k]), "rms", number(o->channel_rms[k])));
    }
    return all;
}

static json_t *sound_json(const struct scene *s, const struct render_report *report)
{
    const struct sound_report *o = &report->sound;
    json_t *sound = json_pack("{s:s, s:o, s:o, s:o, s:o, s:o, s:o, s:b}", "unit",
                              report->quantity >= 0 ? summary_units[report->quantity] : "the impulse response's", "peak", number(o->peak), "rms",
                              number(o->rms), "gain", number(o->gain), "gain_db", number(decibel(o->gain)), "peak_dbfs",
                              number(decibel(o->gain * o->peak)), "rms_dbfs", number(decibel(o->gain * o->rms)), "silent", o->silent);
    if (o->channels > 1)
        json_object_set_new(sound, "channels", channels_json(s, o));
    return sound;
}

static json_t *stages_json(const struct run *run, double cpu)
{
    json_t *all = json_array();
    for (int i = 0; i < run->n; i++) {
        const struct stage_run *st = &run->stages[i];
        json_array_append_new(all, json_pack("{s:s, s:o, s:o, s:I, s:I}", "stage", st->stage->name, "cpu_s", number(st->seconds), "share",
                                             number(cpu > 0 ? st->seconds / cpu : 0), "blocks", (json_int_t)st->blocks, "bytes",
                                             (json_int_t)st->bytes));
    }
    return all;
}

/* How a surface that rings by modes is convolved; of a moving response also with what predicted error. */
static json_t *response_json(const struct ring_choice *c, double rate)
{
    static const char *const readings[] = {"auto", "fixed", "launch", "glide", "readout"};
    json_t *r = json_pack("{s:s, s:i}", "moving", readings[c->reading], "modes", c->modes.n);
    if (c->moves && (c->engine == RING_OVERLAP || c->engine == RING_READOUT))
        json_object_set_new(r, "hop_s", number(c->hop / rate));
    if (c->engine == RING_PANNED)
        json_object_set_new(r, "nodes", json_integer(c->nodes.n));
    if (c->error > 0)
        json_object_set_new(r, "predicted_error_db", number(decibel(c->error)));
    return r;
}

static json_t *contact_json(const struct run *run, double cpu)
{
    const struct board *b = &run->board;
    const struct ring_choice *choice = run->plan.contact->surface.response.choice;
    json_t *c = json_pack("{s:s, s:o, s:o}", "name", run->plan.contact->name, "lifted_off_s", number(b->lifted), "stages",
                          stages_json(run, cpu));
    if (choice && !choice->recorded)
        json_object_set_new(c, "response", response_json(choice, b->rate));
    if (b->load)
        json_object_set_new(c, "normal_force_n", json_pack("[o, o]", number(b->load->least), number(b->load->most)));
    return c;
}

/* The other files of the render, by their names beside the summary. */
static json_t *files_json(const struct render_report *report)
{
    json_t *all = json_array();
    for (int i = 0; i < report->n_files; i++) {
        const struct render_file *f = &report->files[i];
        const char *slash = strrchr(f->path, '/');
        if (!strcmp(f->kind, "summary"))
            continue;
        json_array_append_new(all, json_pack("{s:s, s:s, s:s*, s:s*, s:s*}", "kind", f->kind, "name", slash ? slash + 1 : f->path, "contact",
                                             f->contact, "stem", f->stem, "sha256", f->sha256));
    }
    return all;
}

const char *summary_text(const struct scene *s, const struct run *const *runs, const struct render_report *report, struct arena *a)
{
    double duration = (double)report->frames / s->output.sample_rate;
    json_t *contacts = json_array(), *remarks = json_array();
    for (int i = 0; i < s->n_contacts; i++)
        if (runs[i])
            json_array_append_new(contacts, contact_json(runs[i], report->cpu));
    for (int i = 0; i < report->n_warnings; i++)
        json_array_append_new(remarks, json_string(report->warnings[i]));
    json_t *whole = json_pack("{s:s, s:I, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o}", "scene", s->title ? s->title : "", "frames",
                              (json_int_t)report->frames, "sample_rate_hz", number(s->output.sample_rate), "duration_s", number(duration),
                              "wall_s", number(report->seconds), "cpu_s", number(report->cpu), "real_time_factor",
                              number(report->cpu > 0 ? duration / report->cpu : HUGE_VAL), "contacts", contacts, "warnings", remarks,
                              "files", files_json(report));
    if (report->sounds)
        json_object_set_new(whole, "sound", sound_json(s, report));
    char *text = json_dumps(whole, JSON_INDENT(2) | JSON_REAL_PRECISION(9) | JSON_ENSURE_ASCII);
    const char *kept = arena_format(a, "%s\n", text ? text : "{}");
    free(text);
    json_decref(whole);
    return kept;
}
