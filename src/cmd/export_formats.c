/* The formats of `rasp export`, each a row of the table at the end: what it wants, and who writes it.

   - webMUSHRA 1.4 (its experimenter.md and pages): a configuration for each list, in the part of YAML that its parser
     (yaml.js), PyYAML and libyaml read alike: block style, every text in double quotes, UTF-8 as it is. A MUSHRA page
     has a reference, which webMUSHRA hides among the others by itself; where there is none a Likert page has several
     sounds, or one.
   - PsychoPy (importConditions): CSV whose columns are names of variables; a text that reads as a number becomes one.
   - jsPsych 8, and a page without library: the same lists, as JavaScript, since a page that is opened from the disk may
     not fetch JSON.
   - BIDS 1.9: tables with tabs, n/a for what is not there, a side-car for the columns of each.
   - Hugging Face's AudioFolder: metadata.csv with file_name beside the sounds, a folder for each split. */
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/text.h"
#include "cmd/export.h"
#include "file/json_value.h"

/* ------------------------------------------------------------------ what formats share of a trial */

static const char *title(const struct export *x) { return x->design->title ? x->design->title : x->name; }

static const char *id_of(const struct export *x, const struct trial *t, struct arena *a)
{
    return arena_format(a, "trial_%0*d", snprintf(NULL, 0, "%d", x->trials.n), t->id);
}

static const char *session_of(const struct export *x, const struct trial *t)
{
    int f = x->design->trials->session;
    return f < 0 || t->session < 0 ? "n/a" : x->design->factors[f].levels[t->session].label;
}

static const char *role(const struct export *x, int i)
{
    const struct design_trials *w = x->design->trials;
    return w->for_training[i] && w->roles[i] == DESIGN_ROLE_TEST ? "training" : design_trials_roles[w->roles[i]];
}

/* The right answer; NULL: there is none. */
static const char *played(const struct export *x, const struct trial *t)
{
    int right = trials_right(&x->trials, t);
    return right < 0 ? NULL : x->design->trials->answers[right].label;
}

/* ------------------------------------------------------------------ webMUSHRA */

/* JSON in block style; at: columns of the indentation; in_list: after a dash. */
static void put_yaml(FILE *f, const json_t *value, int at, bool in_list)
{
    const char *key;
    json_t *one;
    size_t i;
    if (json_is_string(value)) {
        fputs(" \"", f);
        for (const char *p = json_string_value(value); *p; p++) {
            if (*p == '"' || *p == '\\') fputc('\\', f);
            fputc((unsigned char)*p < ' ' ? ' ' : *p, f);
        }
        fputc('"', f);
    } else if (!json_is_object(value) && !json_is_array(value)) {
        fputc(' ', f);
        json_dumpf(value, f, JSON_ENCODE_ANY);
    }
    if (!in_list || json_is_string(value)) fputc('\n', f);
    json_object_foreach((json_t *)value, key, one)
    {
        fprintf(f, "%*s\"%s\":", in_list ? 1 : at, "", key);
        put_yaml(f, one, at + 4, false);
        in_list = false;
    }
    json_array_foreach(value, i, one)
    {
        fprintf(f, "%*s-", at, "");
        put_yaml(f, one, at + 2, true);
    }
}

/* HTML of question and text. */
static const char *content(const struct export *x, const struct trial *t, struct arena *a)
{
    const char *question = x->design->trials->question, *html = "";
    if (question) html = arena_format(a, "<p>%s</p>", text_html(a, question));
    return t->text ? arena_format(a, "%s<p>%s</p>", html, text_html(a, t->text)) : html;
}

static json_t *webmushra_trial(struct export *x, const struct export_list *l, int k, struct err *e)
{
    const struct design_trials *w = x->design->trials;
    const struct trial *t = &l->trials[k];
    struct arena *a = l->arena;
    bool several = t->n > 1, mushra = t->reference >= 0;
    json_auto_t *stimuli = json_object(), *response = json_array();
    json_t *page = json_value_object("type:s id:s name:s content:s",
                                     mushra    ? "mushra"
                                     : several ? "likert_multi_stimulus"
                                               : "likert_single_stimulus",
                                     arena_format(a, "%s%s", t->training ? "training_" : "", id_of(x, t, a)),
                                     arena_format(a, "%s %d / %d", t->training ? "Training" : "Trial", k + 1, l->n),
                                     content(x, t, a));
    for (int i = 0; i < t->n; i++) {
        int sound = t->stimuli[i];
        const char *name = x->design->stimuli[sound].name, *frames = export_manifest(x, sound, "frames"),
                   *wanted = mushra ? export_manifest(x, t->reference, "frames") : frames;
        if (strcmp(frames, wanted) != 0)
            err_set(e, ERR_SCENE,
                    "%s: %s has %s samples, its reference %s: webMUSHRA wants sounds of one length on a page: "
                    "length: longest, in the design",
                    x->set, name, frames, wanted);
        if (sound != t->reference) json_object_set_new(stimuli, name, json_string(export_sound(x, sound, a)));
    }
    for (int i = 0; i < w->n_answers; i++) {
        const char *value = w->task == DESIGN_TASK_RATE ? arena_format(a, "%d", (200 * i / (w->n_answers - 1) + 1) / 2)
                                                        : w->answers[i].label;
        json_array_append_new(response, json_value_object("value:s label:s", value, text_html(a, w->answers[i].text)));
    }
    if (mushra)
        json_value_set(page,
                       "showWaveform:b enableLooping:b strict:b reference:s createAnchor35:b createAnchor70:b "
                       "randomize:b showConditionNames:b switchBack:b stimuli:o",
                       false, true, false, export_sound(x, t->reference, a), false, false, true, false, true,
                       json_incref(stimuli));
    else
        json_value_set(page, "mustRate:b mustPlayback:s stimuli:o response:o", true,
                       several ? "processUpdate" : "ended", json_incref(stimuli), json_incref(response));
    return page;
}

/* webMUSHRA puts names and answers between apostrophes, and sends them as part of a form without saying so. */
static bool webmushra_word(const struct export *x, const char *word, struct err *e)
{
    return !word[strcspn(word, "&+%'")] ||
           err_set(e, ERR_SCENE,
                   "%s: '%s' does not survive webMUSHRA, which loses & + %% and ': write another label, or name:",
                   x->design->file, word);
}

static bool webmushra_files(struct export *x, struct err *e)
{
    const struct design_trials *w = x->design->trials;
    if (w->task == DESIGN_TASK_COMPARE)
        return err_set(e, ERR_SCENE,
                       "%s: trials.task: webMUSHRA has no page on which one of two sounds is chosen; --for jspsych, "
                       "page and psychopy do",
                       x->design->file);
    for (int i = 0; i < x->design->n_stimuli; i++)
        if (!webmushra_word(x, x->design->stimuli[i].name, e)) return false;
    for (int i = 0; i < w->n_answers && w->task == DESIGN_TASK_CHOOSE; i++)
        if (!webmushra_word(x, w->answers[i].label, e)) return false;
    return true;
}

static bool webmushra_list(struct export *x, const struct export_list *l, json_t *trials, struct err *e)
{
    json_t *pages = json_array();
    if (x->design->trials->instructions)
        json_array_append_new(pages,
                              json_value_object("type:s id:s name:s content:s", "generic", "instructions",
                                                "Instructions", text_html(l->arena, x->design->trials->instructions)));
    json_array_extend(pages, trials);
    json_array_append_new(pages,
                          json_value_object("type:s name:s content:s popupContent:s showResults:b writeResults:b",
                                            "finish", "Thank you", "", "Your answers were sent.", false, true));
    json_auto_t *all = json_value_object("testname:s testId:s bufferSize:i stopOnErrors:b showButtonPreviousPage:b "
                                         "remoteService:s language:s pages:o",
                                         title(x), arena_format(l->arena, "%s_%s", x->name, l->name), 2048, true, false,
                                         "service/write.php", "en", pages);
    if (!export_open(x, arena_format(l->arena, "configs/%s_%s.yaml", x->name, l->name), e)) return false;
    fputs("# for webMUSHRA: to be opened with ?config= and this file's name", x->stream);
    put_yaml(x->stream, all, 0, false);
    return export_close(x, e);
}

/* ------------------------------------------------------------------ tables of trials: PsychoPy and BIDS */

/* What columns mean; names of sounds' columns end in a number. */
static const struct {
    const char *name, *meaning;
} columns[] = {
    {"trial", "place of the trial in the list, from 1"},
    {"trial_id", "which trial of the design it is, the same for all participants"},
    {"session", "label of the session's factor"},
    {"block", "number of the block, from 1; 0: training"},
    {"training", "1: the answer does not count"},
    {"question", "what the listener is asked"},
    {"text", "what the listener reads of the sounds"},
    {"played", "the right answer"},
    {"stim_file", "a sound, in the order in which they are presented"},
    {"stimulus", "which stimulus it is, stimulus_id of the table of sounds"},
    {"role", "what it is for: test, reference, anchor or training"},
    {"response", "the answer; of several sounds, numbers with blanks between"},
    {"response_time", "how long it took, in seconds"},
};

/* Of stimulus i: its WAV, its name, its role. */
static const char *sound_cell(const struct export *x, int i, int which, struct arena *a)
{
    const char *name = x->design->stimuli[i].name;
    if (which == 0) return x->format->tabs ? export_manifest(x, i, "file_name") : export_sound(x, i, a);
    return which == 1 ? name : role(x, i);
}

/* A row of the table, whose columns are its keys; in BIDS the last two are to be filled in. */
static json_t *row_trial(struct export *x, const struct export_list *l, int k, struct err *e)
{
    const struct trial *t = &l->trials[k];
    bool bids = x->format->tabs;
    const char *const read[] = {x->design->trials->question, t->text, played(x, t)};
    const char *const of_sound[] = {bids ? "stim_file" : "file", "stimulus", "role"};
    json_t *row =
        json_value_object("trial:i trial_id:s session:s block:i training:i question:s text:s played:s", k + 1,
                          id_of(x, t, l->arena), session_of(x, t), t->part, t->training, read[0], read[1], read[2]);
    for (int c = 0; c < 3; c++)
        for (int s = 0; s < x->trials.most; s++)
            json_object_set_new(row, arena_format(l->arena, "%s_%d", of_sound[c], s + 1),
                                json_value_text(s < t->n ? sound_cell(x, t->stimuli[s], c, l->arena) : NULL));
    if (bids) json_value_set(row, "response:0 response_time:0");
    for (int i = 0; i < 3 && !bids; i++)
        if (read[i] && *read[i] == '[' && text_ends(read[i], "]"))
            err_set(e, ERR_SCENE, "%s: '%s' stands in brackets, which PsychoPy would compute: leave them out",
                    x->design->file, read[i]);
    return row;
}

static bool rows_write(struct export *x, const char *name, const json_t *rows, struct arena *a, struct err *e)
{
    const char *key;
    json_t *cell;
    if (!export_open(x, name, e)) return false;
    for (size_t i = 0; i <= json_array_size(rows); i++) { /* 0: the head */
        bool first = true;
        json_object_foreach(json_array_get(rows, i ? i - 1 : 0), key, cell)
        {
            const char *text = json_is_null(cell) ? "n/a" : json_string_value(cell);
            if (json_is_integer(cell)) text = arena_format(a, "%d", (int)json_integer_value(cell));
            export_cell(x, first, i ? text : key);
            first = false;
        }
        fputc('\n', x->stream);
    }
    return export_close(x, e);
}

static bool psychopy_list(struct export *x, const struct export_list *l, json_t *trials, struct err *e)
{
    return rows_write(x, arena_format(l->arena, "conditions_%s.csv", l->name), trials, l->arena, e);
}

static bool psychopy_files(struct export *x, struct err *e)
{
    const struct design_trials *w = x->design->trials;
    json_auto_t *answers = json_array();
    for (int i = 0; i < w->n_answers; i++)
        json_array_append_new(answers, json_value_object("answer:s text:s", w->answers[i].label, w->answers[i].text));
    return (!w->instructions ||
            export_text(x, "instructions.txt", arena_format(x->arena, "%s\n", w->instructions), e)) &&
           rows_write(x, "answers.csv", answers, x->arena, e);
}

/* ------------------------------------------------------------------ BIDS */

/* Labels there are letters and digits. */
static const char *task_name(const struct export *x)
{
    char *name = arena_text(x->arena, x->name), *to = name;
    for (const char *p = x->name; *p; p++)
        if (*p != '_' && *p != '-') *to++ = *p;
    *to = '\0';
    return *name ? name : "task";
}

static bool bids_list(struct export *x, const struct export_list *l, json_t *trials, struct err *e)
{
    const char *ses = l->sitting ? "ses-" : "", *sitting = l->sitting ? l->sitting : "";
    const char *name =
        arena_format(l->arena, "sub-%s%s%s%s/beh/sub-%s%s%s%s_task-%s_beh.tsv", l->person, l->sitting ? "/" : "", ses,
                     sitting, l->person, l->sitting ? "_" : "", ses, sitting, task_name(x));
    return rows_write(x, name, trials, l->arena, e);
}

/* The side-car of the tables of trials. */
static json_t *bids_columns(struct export *x, struct err *e)
{
    const struct design_trials *w = x->design->trials;
    const char *key;
    json_t *cell, *all = json_value_object("TaskName:s", task_name(x));
    json_value_set(all, "TaskDescription:? Instructions:?", w->question, w->instructions);
    json_auto_t *row = row_trial(x, &(struct export_list){.trials = x->trials.all, .arena = x->arena}, 0, e);
    json_object_foreach(row, key, cell)
    {
        size_t c = 0, n = strcspn(key, "0123456789");
        n -= key[n] != '\0'; /* "stimulus_1": without _1 */
        while (strncmp(columns[c].name, key, n) != 0 || columns[c].name[n])
            c++;
        json_t *one = json_value_object("Description:s", columns[c].meaning), *levels = json_object();
        if (!strcmp(key, "response_time")) json_value_set(one, "Units:s", "s");
        for (int i = 0; !strcmp(key, "response") && w->task != DESIGN_TASK_RATE && i < w->n_answers; i++)
            json_object_set_new(levels, w->answers[i].label, json_string(w->answers[i].text));
        if (json_object_size(levels)) json_object_set(one, "Levels", levels);
        json_decref(levels);
        json_object_set_new(all, key, one);
    }
    return all;
}

static bool bids_files(struct export *x, struct err *e)
{
    struct arena *a = x->arena;
    const char *about = "An experiment in listening, to be carried out. The sounds and what they were made from are in "
                        "stimuli/.";
    if (!export_json(x, "dataset_description.json",
                     json_value_object("Name:s BIDSVersion:s DatasetType:s", title(x), "1.9.0", "raw"), e) ||
        !export_text(x, "README", arena_format(a, "%s\n\n%s\n", title(x), about), e) ||
        !export_text(x, ".bidsignore", "SHA256SUMS\n", e) || !x->trials.n)
        return !e->kind;
    if (!export_json(x, arena_format(a, "task-%s_beh.json", task_name(x)), bids_columns(x, e), e) ||
        !export_open(x, "participants.tsv", e))
        return false;
    fputs("participant_id\n", x->stream);
    for (int p = 1; p <= x->people; p++)
        fprintf(x->stream, "sub-%s\n", export_person(x, p, a));
    return export_close(x, e);
}

/* ------------------------------------------------------------------ jsPsych, and a page without library */

static json_t *script_sound(const struct export *x, const struct trial *t, int i, struct arena *a)
{
    const struct design *d = x->design;
    json_t *levels = json_object();
    const char *level = "";
    for (int f = 0; f < d->n_factors; f++) {
        json_object_set_new(levels, d->factors[f].column, json_value_text(design_value(d, i, f)));
        if (t->differs && t->differs[f])
            level = arena_format(a, "%s%s%s", level, *level ? ", " : "", design_label(d, i, f));
    }
    return json_value_object("file:s stimulus_id:s role:s level:s levels:o", export_sound(x, i, a), d->stimuli[i].name,
                             role(x, i), level, levels);
}

static json_t *script_trial(struct export *x, const struct export_list *l, int k, struct err *e)
{
    const struct trial *t = &l->trials[k];
    json_t *sounds = json_array();
    (void)e;
    for (int i = 0; i < t->n; i++)
        json_array_append_new(sounds, script_sound(x, t, t->stimuli[i], l->arena));
    return json_value_object("trial:i trial_id:s block:i training:i text:s played:s sounds:o", k + 1,
                             id_of(x, t, l->arena), t->part, t->training, t->text, played(x, t), sounds);
}

static bool script_list(struct export *x, const struct export_list *l, json_t *trials, struct err *e)
{
    const struct design_trials *w = x->design->trials;
    struct arena *a = l->arena;
    json_t *answers = json_array();
    for (int i = 0; i < w->n_answers; i++)
        json_array_append_new(answers, json_value_object("label:s text:s", w->answers[i].label, w->answers[i].text));
    json_auto_t *study =
        json_value_object("title:s instructions:s task:s question:s answers:o participant:s session:s trials:o",
                          title(x), w->instructions, design_trials_tasks[w->task], w->question, answers,
                          arena_format(a, "p%s", l->person), session_of(x, l->trials), json_incref(trials));
    if (!export_open(x, arena_format(a, "lists/%s.js", l->name), e)) return false;
    fputs("study = ", x->stream);
    json_dumpf(study, x->stream, JSON_INDENT(1) | JSON_ENSURE_ASCII);
    fputs(";\n", x->stream);
    return export_close(x, e);
}

static bool page_files(struct export *x, struct err *e)
{
    return export_text(x, "index.html", export_pages_page, e) && export_text(x, "study.js", export_pages_study, e);
}

static bool jspsych_files(struct export *x, struct err *e)
{
    static const char *const plugins[] = {
        "audio-button-response", "audio-slider-response", "html-button-response", "preload", "survey-html-form", NULL};
    json_t *needs = json_value_object("jspsych:s", "8.3.0");
    for (int k = 0; plugins[k]; k++)
        json_object_set_new(needs, arena_format(x->arena, "@jspsych/plugin-%s", plugins[k]), json_string("^2.1.0"));
    return export_json(x, "package.json", json_value_object("private:b dependencies:o", true, needs), e) &&
           export_text(x, "index.html", export_pages_jspsych, e) && export_text(x, "study.js", export_pages_study, e);
}

const struct export_format export_formats_table[] = {
    {"webmushra", "configs/resources/audio/%s", "stimuli.csv", .browser = true, .files = webmushra_files,
     .trial = webmushra_trial, .list = webmushra_list},
    {"psychopy", "sounds", "stimuli.csv", .files = psychopy_files, .trial = row_trial, .list = psychopy_list},
    {"jspsych", "sounds", "stimuli.csv", .browser = true, .files = jspsych_files, .trial = script_trial,
     .list = script_list},
    {"page", "sounds", "stimuli.csv", .browser = true, .files = page_files, .trial = script_trial, .list = script_list},
    {"bids", "stimuli", "stimuli.tsv", .tabs = true, .bare = true, .files = bids_files, .trial = row_trial,
     .list = bids_list},
    {"audiofolder", "%s", "metadata.csv", .splits = true},
    {.name = NULL},
};
