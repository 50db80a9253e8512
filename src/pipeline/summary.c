#include "pipeline/summary.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/version.h"
#include "convolution/ring_choice.h"
#include "file/json_value.h"
#include "num/real.h"
#include "output/mark.h"
#include "output/sound.h"
#include "output/stems.h"
#include "response/modes.h"
#include "scene/keys.h"
#include "trajectory/contact.h"
#include "trajectory/load.h"

enum { MOST_OF_BOARD = (int)(sizeof((struct board *)0)->warnings / sizeof((struct board *)0)->warnings[0]) };

static void warn(struct render_report *report, const char *text) { report->warnings[report->n_warnings++] = text; }

/* ------------------------------------------------------------------ what stages report */

enum { REPORTS = 16 };

/* In the order of the stages; returns how many. Their values are the caller's. */
static int reports_make(const struct run *r, struct arena *a, struct stage_report *all)
{
    int n = 0;
    for (int i = 0; i < r->n; i++) {
        const struct stage_run *st = &r->stages[i];
        struct stage_report one = st->stage->report ? st->stage->report(st, a) : (struct stage_report){.key = NULL};
        int k = 0;
        while (one.key && k < n && strcmp(all[k].key, one.key) != 0)
            k++;
        if (!one.key || k == REPORTS) continue;
        if (k < n) json_decref(all[k].value);
        all[k] = one;
        n += k == n;
    }
    return n;
}

static void reports_drop(const struct stage_report *all, int n)
{
    for (int i = 0; i < n; i++)
        json_decref(all[i].value);
}

/* ------------------------------------------------------------------ notes */

void summary_notes(const struct scene *s, const struct run *const *runs, struct render_report *report, struct arena *a)
{
    report->notes = ARENA_TAKE(a, const char *, s->n_contacts *REPORTS + 1);
    if (report->error_budget.text && (report->error_budget.asked || report->error_budget.diverges))
        report->notes[report->n_notes++] = report->error_budget.text;
    for (int i = 0; i < s->n_contacts; i++) {
        struct stage_report all[REPORTS];
        int n = runs[i] ? reports_make(runs[i], a, all) : 0;
        for (int k = 0; k < n; k++)
            if (all[k].note)
                report->notes[report->n_notes++] =
                    arena_format(a, "contact '%s': %s", s->contacts[i].name, all[k].note);
        reports_drop(all, n);
    }
}

/* ------------------------------------------------------------------ remarks */

/* 20 dB: beside a sound of its own kind that much louder, one adds 0.04 dB to the whole, and what is varied of it alone
 * is hardly heard. */
static void warn_drowned(const struct contact *c, const struct board *b, struct render_report *report, struct arena *a)
{
    const char *other = contact_rolls(c) ? "ball" : "scraper", *under[2] = {other, "surface"}, *help = "";
    double ratio = b->energy[1] / b->energy[0],
           equal = (contact_rolls(c) ? c->ball.weight : c->scraper.weight) / sqrt(ratio);
    if (!(ratio > 100) && !(ratio < 0.01)) return;
    bool surface = ratio > 100;
    if (equal >= 1e-6 && equal <= 1000) /* what can be set, and means something */
        help = arena_format(a, "; %s.weight %s the %s, %.2g makes both alike", other, surface ? "lowers" : "raises",
                            other, equal);
    warn(report, arena_format(a,
                              "contact '%s': the %s is more than 20 dB under its %s, and hardly heard%s "
                              "(ablation.sound: %s gives it alone)",
                              c->name, under[surface], under[!surface], help, under[surface]));
}

static void warn_contact(const struct contact *c, const struct run *r, struct render_report *report, struct arena *a)
{
    const struct board *b = &r->board;
    for (int k = 0; k < b->n_warnings && k < MOST_OF_BOARD; k++)
        warn(report, arena_text(a, b->warnings[k])); /* the text ends with its run */
    if (b->n_warnings > MOST_OF_BOARD)
        warn(report, arena_format(a, "contact '%s': %d more remark%s", c->name, b->n_warnings - MOST_OF_BOARD,
                                  b->n_warnings > MOST_OF_BOARD + 1 ? "s" : ""));
    if (b->lifted > 0)
        warn(report,
             arena_format(a,
                          "contact '%s': the %s lifts %s off for %.4g s in all (negative normal force); no force then",
                          c->name, contact_rolls(c) ? "turning of the uneven ball" : "hand",
                          contact_rolls(c) ? "it" : "the scraper", b->lifted));
    if (b->unstated && b->quantity >= 0)
        warn(report, arena_format(a,
                                  "contact '%s': its WAV response does not say what it is in, and is summed as if in "
                                  "%s, like its mode table",
                                  c->name, modes_quantity_unit(b->quantity)));
    warn_drowned(c, b, report, a);
    struct stage_report all[REPORTS];
    int n = reports_make(r, a, all);
    for (int k = 0; k < n; k++)
        for (int i = 0; i < STAGE_WARNINGS && all[k].warnings[i]; i++)
            warn(report, arena_format(a, "contact '%s': %s", c->name, all[k].warnings[i]));
    reports_drop(all, n);
}

static double decibel(double x) { return x > 0 ? 20 * real_log10(x) : -HUGE_VAL; }

/* A tail of its own ends 80 dB down; a cut that leaves more off is reported. */
static void warn_cut(const struct scene *s, struct render_report *report, struct arena *a)
{
    const struct sound_report *o = &report->sound;
    const struct render_length *l = &report->length;
    double rate = s->output.sample_rate;
    if (!report->sounds || (double)l->natural - (double)l->frames < 1e-3 * rate || !(o->end > 1e-4 * o->before_ramps))
        return;
    warn(report,
         arena_format(
             a, "output.duration: the file is cut at %.4g s of %.4g s, %s %.1f dB below its peak before the ramps",
             (double)l->frames / rate, (double)l->natural / rate,
             (double)l->frames + 1e-3 * rate < (double)l->motion ? "where the motion still goes on, and the sound is"
                                                                 : "where the sound is",
             fmax(0, -decibel(o->end / o->before_ramps)) + 0.0)); /* not -0 */
}

/* Up to the second point: "rasp 0.2". */
static void warn_written_by(const struct scene *s, struct render_report *report, struct arena *a)
{
    static const char own[] = "rasp " VERSION;
    const char *by = s->written_by, *point = strrchr(own, '.');
    if (!by || strncmp(by, own, (size_t)(point - own) + 1) == 0) return;
    warn(report, arena_format(a,
                              "written_by: this scene was written by %s, and this is %s, whose sounds are others "
                              "(CHANGELOG.md): the sound is not quite that one's",
                              by, own));
}

void summary_warnings(const struct scene *s, const struct run *const *runs, struct render_report *report,
                      struct arena *a)
{
    int older = 0;
    while (report->older[older])
        older++;
    report->warnings =
        ARENA_TAKE(a, const char *,
                   s->n_contacts *(MOST_OF_BOARD + 8 + REPORTS * STAGE_WARNINGS) + 2 * report->n_files + 5 + older);
    for (int i = 0; i < s->n_contacts; i++)
        if (runs[i]) warn_contact(&s->contacts[i], runs[i], report, a);
    const struct error_budget *b = &report->error_budget;
    if (b->missed)
        warn(report,
             arena_format(a,
                          "accuracy: %s aims at %.6g dB, and %.1f dB are predicted: where the force has steps or "
                          "kinks no preset has enough; measure it (--verify), or ask for what there is "
                          "(accuracy.error)",
                          s->accuracy.preset, b->error, b->predicted));
    for (int i = 0; i < s->n_contacts; i++)
        if (runs[i] && runs[i]->board.lifted > 0 && report->error_budget.asked && report->error_budget.n > 0)
            warn(report, arena_format(a,
                                      "contact '%s': where it is lifted off its force is cut, and errors fall more "
                                      "slowly, and less evenly, than accuracy.error counts on: measure them "
                                      "(--verify)",
                                      s->contacts[i].name));
    for (int i = 0; i < report->n_files; i++) {
        const struct render_file *f = &report->files[i];
        /* Samples that wait for the set's gain are none of a file yet: batch/stimulus.c tells of those that will be. */
        const char *silent = summary_silent(s, f, report->sound.gain * report->sound.peak, a),
                   *beyond = s->output.level.later ? NULL : summary_beyond(s, f, a);
        if (silent) warn(report, silent);
        if (beyond) warn(report, beyond);
    }
    if (report->sounds && report->sound.ramp < s->output.ramp - 0.5 / s->output.sample_rate)
        warn(report,
             arena_format(a,
                          "output.ramp: the sound is too short for ramps of %.4g s; they take half of it each, %.4g s",
                          s->output.ramp, report->sound.ramp));
    warn_cut(s, report, a);
    warn_written_by(s, report, a);
    for (int i = 0; i < older; i++)
        warn(report,
             arena_format(a, "%s is not of this render, which writes no such file; it is older, and stays as it is",
                          report->older[i]));
}

static json_t *sound_json(const struct scene *s, const struct render_report *report)
{
    const struct sound_report *o = &report->sound;
    const struct render_file *wav = summary_sound(report);
    json_t *sound = json_value_object(
               "unit:s peak:n rms:n gain:n gain_db:n peak_dbfs:n rms_dbfs:n",
               report->quantity >= 0 ? modes_quantity_unit(report->quantity) : "the impulse response's", o->peak,
               o->rms, o->gain, decibel(o->gain), decibel(o->gain * o->peak), decibel(o->gain * o->rms)),
           *channels = json_array();
    summary_written(wav, sound);
    for (int k = 0; o->channels > 1 && k < o->channels;
         k++) /* what is heard at each listening place of several, unscaled */
        json_array_append_new(channels,
                              json_value_object("place_m:a peak:n rms:n silent:b", s->output.listen.places + 3 * k, 3,
                                                o->channel_peak[k], o->channel_rms[k], !wav->written->audible[k]));
    if (o->channels > 1) json_object_set(sound, "channels", channels);
    json_decref(channels);
    return sound;
}

/* cpu NAN: no times. */
static json_t *contact_json(const struct run *run, const struct scene *s, double cpu, struct arena *a)
{
    const struct board *b = &run->board;
    const struct ring_choice *choice = run->plan.contact->surface.response.choice;
    json_t *c = json_value_object("name:s lifted_off_s:n", run->plan.contact->name, b->lifted);
    json_t *stages = isnan(cpu) ? NULL : json_array();
    for (int i = 0; stages && i < run->n; i++) {
        const struct stage_run *st = &run->stages[i];
        json_array_append_new(stages, json_value_object("stage:s cpu_s:n share:n blocks:l bytes:l", st->stage->name,
                                                        st->seconds, cpu > 0 ? st->seconds / cpu : 0.0,
                                                        (long)st->blocks, (long)st->bytes));
    }
    if (stages) json_object_set_new(c, "stages", stages);
    if (choice && !choice->recorded) { /* how a surface that rings by modes is convolved */
        static const char *const readings[] = {"auto", "fixed", "launch", "glide", "readout"};
        json_t *r = json_value_object("moving:s modes:i", readings[choice->reading], choice->modes.n);
        if (choice->moves && choice->engine != RING_RESONATORS)
            json_value_set(r, "hop_s:n", ring_choice_hop(choice, &s->accuracy) / s->output.sample_rate);
        json_object_set_new(c, "response", r);
    }
    struct stage_report all[REPORTS];
    int n = reports_make(run, a, all);
    for (int k = 0; k < n; k++)
        json_object_set_new(c, all[k].key, all[k].value);
    if (b->load) json_value_set(c, "normal_force_n:[ :n :n ]", b->load->least, b->load->most);
    return c;
}

/* What accuracy.error or the preset asked for, and what the knobs that leave an error are predicted to leave. */
static json_t *error_budget_json(const struct error_budget *p, bool times)
{
    json_t *by = json_array();
    for (int i = 0; i < p->n; i++)
        json_array_append_new(by,
                              json_value_object("knob:s value:n error_db:n said:b", keys_knobs[p->parts[i].knob].name,
                                                p->parts[i].value, decibel(p->parts[i].error), p->parts[i].by_user));
    json_t *j = json_value_object("asked_db:n predicted_db:n chosen:b by:o", p->error, p->predicted, p->chosen, by);
    if (p->diverges) json_value_set(j, "diverges:b", true);
    if (times) json_value_set(j, "cpu_s:n", p->cpu);
    return j;
}

const char *summary_text(const struct scene *s, const struct run *const *runs, const struct render_report *report,
                         bool times, struct arena *a)
{
    double duration = (double)report->frames / s->output.sample_rate;
    json_t *contacts = json_array(), *remarks = json_array(), *files = json_array();
    for (int i = 0; i < s->n_contacts; i++)
        if (runs[i]) json_array_append_new(contacts, contact_json(runs[i], s, times ? report->cpu : NAN, a));
    for (int i = 0; i < report->n_warnings; i++)
        json_array_append_new(remarks, json_value_shown(report->warnings[i]));
    for (int i = 0; i < report->n_files; i++) { /* the others, by their names beside the summary */
        const struct render_file *f = &report->files[i];
        if (!strcmp(f->kind, "summary")) continue;
        json_t *one = json_value_object("kind:s name:v contact:? stem:? sha256:?", f->kind, basename(f->path),
                                        f->contact, f->stem, f->sha256);
        summary_written(f, one);
        json_array_append_new(files, one);
    }
    json_t *whole = json_value_object("scene:s frames:l sample_rate_hz:n duration_s:n contacts:o warnings:o files:o",
                                      s->title ? s->title : "", (long)report->frames, s->output.sample_rate, duration,
                                      contacts, remarks, files);
    if (times)
        json_value_set(whole, "wall_s:n cpu_s:n real_time_factor:n", report->seconds, report->cpu,
                       report->cpu > 0 ? duration / report->cpu : HUGE_VAL);
    for (int i = 0; times && i < report->n_files; i++) {
        /* What an earlier render wrote under these names and this one does not, so that a later one may replace it. */
        json_t *older = strcmp(report->files[i].kind, "summary")
                            ? NULL
                            : mark_older(report->files[i].path, json_object_get(whole, "files"), a);
        if (json_array_size(older)) json_object_set(whole, "older", older);
        json_decref(older);
    }
    if (report->error_budget.text)
        json_object_set_new(whole, "accuracy", error_budget_json(&report->error_budget, times));
    if (report->sounds) json_object_set_new(whole, "sound", sound_json(s, report));
    char *text = json_dumps(whole, JSON_INDENT(2) | JSON_REAL_PRECISION(times ? 9 : 17) | JSON_ENSURE_ASCII);
    const char *copy = arena_format(a, "%s\n", text ? text : "{}");
    free(text);
    json_decref(whole);
    return copy;
}

/* Integers round what is less than half a step to 0; what is beyond their range they refuse
 * (file/wav.h). Floating point holds both. */
static const char *sound_silent(const struct scene *s, double peak, struct arena *a)
{
    if (peak > 0)
        return arena_format(a,
                            "the sound is silent: every sample is 0 in %s, for its peak is %.1f dB re full scale: give "
                            "a higher level (%s)%s",
                            keys_find("output.encoding")->choices[s->output.encoding].word, 20 * real_log10(peak),
                            sound_level_key(s),
                            sound_bits(s->output.encoding) > 0 ? ", or write float32 (output.encoding)" : "");
    return isnan(sound_known_gain(s)) || s->output.level.later ? "the sound is silent: no level was set"
                                                               : "the sound is silent: every sample is 0";
}

const char *summary_silent(const struct scene *s, const struct render_file *f, double peak, struct arena *a)
{
    const struct wav_written *w = f->written;
    const char *silent = "";
    int n = 0;
    if (!w) return NULL;
    for (int k = 0; k < w->channels; k++)
        if (!w->audible[k]) silent = arena_format(a, "%s%s%d", silent, n++ ? ", " : "", k + 1);
    if (n == w->channels)
        return f->stem ? arena_format(a, "the stem %s is silent: every sample is 0", f->stem)
                       : sound_silent(s, peak, a);
    return n == 0 || f->stem ? NULL
                             : arena_format(a, "channel%s %s of %d %s silent: every sample there is 0",
                                            n == 1 ? "" : "s", silent, w->channels, n == 1 ? "is" : "are");
}

static bool has_full_scale(const struct render_file *f)
{
    return !f->stem || strcmp(f->stem, stems_names[STEM_FORCE]) != 0;
}

const char *summary_beyond(const struct scene *s, const struct render_file *f, struct arena *a)
{
    const struct wav_written *w = f->written;
    if (!w || !has_full_scale(f) || !(w->beyond > 0)) return NULL;
    return arena_format(a,
                        "the %s%s: %.0f of %.0f samples lie beyond full scale, by up to %.2f dB: floating point holds "
                        "them, but whatever plays them, or makes integers of them, clips: give a lower "
                        "level (%s)",
                        f->stem ? "stem " : "sound", f->stem ? f->stem : "", w->beyond, w->frames * w->channels,
                        20 * real_log10(w->peak), sound_level_key(s));
}

void summary_written(const struct render_file *f, json_t *to)
{
    if (!f->written) return;
    json_value_set(to, "silent:b samples_beyond_full_scale:o", !wav_written_audible(f->written),
                   has_full_scale(f) ? json_integer((json_int_t)f->written->beyond) : json_null());
}

const struct render_file *summary_sound(const struct render_report *report)
{
    const struct render_file *f = report->files;
    while (!f->written || f->stem)
        f++;
    return f;
}
