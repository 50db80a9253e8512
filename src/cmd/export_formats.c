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

/* ------------------------------------------------------------------ what all say of a trial */

static const struct design_trials *said(const struct export *x) { return x->design->trials; }

static const char *title(const struct export *x) { return x->design->title ? x->design->title : x->name; }

static const char *id_of(const struct export *x, const struct trial *t, struct arena *a)
{
    return arena_format(a, "trial_%s", export_number(t->id, x->trials.n, a));
}

static const char *label(const struct export *x, int factor, int level)
{
    return factor < 0 || level < 0 ? "n/a" : x->design->factors[factor].levels[level].label;
}

static const char *role(const struct export *x, int i)
{
    const struct design_trials *w = said(x);
    return w->for_training[i] && w->roles[i] == DESIGN_ROLE_TEST ? "training" : design_trials_roles[w->roles[i]];
}

/* The right answer; NULL: there is none. */
static const char *played(const struct export *x, const struct trial *t)
{
    int right = trials_right(&x->trials, t);
    return right < 0 ? NULL : said(x)->answers[right].label;
}

/* ------------------------------------------------------------------ webMUSHRA */

/* JSON in block style; at: columns of the indentation; in: behind a key or a dash. */
static void put_yaml(FILE *f, const json_t *value, int at, bool in_list)
{
    const char *key;
    json_t *one;
    size_t i, first = in_list;
    if (json_is_string(value)) {
        fputs(" \"", f);
        for (const char *p = json_string_value(value); *p; p++) {
            if (*p == '"' || *p == '\\') fputc('\\', f);
            fputc((unsigned char)*p < ' ' ? ' ' : *p, f);
        }
        fputs("\"\n", f);
    } else if (json_is_boolean(value) || json_is_integer(value)) {
        if (json_is_boolean(value))
            fprintf(f, " %s\n", json_is_true(value) ? "true" : "false");
        else
            fprintf(f, " %d\n", (int)json_integer_value(value));
    } else {
        if (!in_list) fputc('\n', f);
        json_object_foreach((json_t *)value, key, one)
        {
            fprintf(f, "%*s\"%s\":", first ? 1 : at, "", key);
            put_yaml(f, one, at + 4, false);
            first = false;
        }
        json_array_foreach(value, i, one)
        {
            fprintf(f, "%*s-", at, "");
            put_yaml(f, one, at + 2, true);
        }
    }
}

/* HTML of question and text. */
static const char *content(const struct export *x, const struct trial *t, struct arena *a)
{
    const char *question = said(x)->question, *html = "";
    if (question) html = arena_format(a, "<p>%s</p>", text_html(a, question));
    return t->text ? arena_format(a, "%s<p>%s</p>", html, text_html(a, t->text)) : html;
}

static json_t *webmushra_page(const struct export *x, const struct export_list *l, int k)
{
    const struct design_trials *w = said(x);
    const struct trial *t = &l->trials[k];
    struct arena *a = l->arena;
    bool several = t->n > 1;
    const char *id = arena_format(a, "%s%s", t->training ? "training_" : "", id_of(x, t, a));
    json_t *stimuli = json_object(), *page = json_object();
    json_value_set(page, "type:s id:s name:s content:s",
                   t->reference >= 0 ? "mushra"
                   : several         ? "likert_multi_stimulus"
                                     : "likert_single_stimulus",
                   id, arena_format(a, "%s %d / %d", t->training ? "Training" : "Trial", k + 1, l->n),
                   content(x, t, a));
    for (int i = 0; i < t->n; i++)
        if (t->stimuli[i] != t->reference)
            json_object_set_new(stimuli, x->design->stimuli[t->stimuli[i]].name,
                                json_string(export_sound(x, t->stimuli[i], a)));
    if (t->reference >= 0) {
        json_value_set(page,
                       "showWaveform:b enableLooping:b strict:b reference:s createAnchor35:b createAnchor70:b "
                       "randomize:b showConditionNames:b switchBack:b stimuli:o",
                       false, true, false, export_sound(x, t->reference, a), false, false, true, false, true, stimuli);
        return page;
    }
    json_t *response = json_array();
    for (int i = 0; i < w->n_answers; i++) {
        const char *value = w->task == DESIGN_TASK_RATE ? arena_format(a, "%d", (200 * i / (w->n_answers - 1) + 1) / 2)
                                                        : w->answers[i].label;
        json_array_append_new(response, json_value_object("value:s label:s", value, text_html(a, w->answers[i].text)));
    }
    json_value_set(page, "mustRate:b mustPlayback:s stimuli:o response:o", true, several ? "processUpdate" : "ended",
                   stimuli, response);
    return page;
}

/* Sounds beside a reference have its length. */
static bool webmushra_lengths(const struct export *x, const struct trial *t, struct err *e)
{
    const struct csv *m = &x->manifest;
    for (int i = 0; t->reference >= 0 && i < t->n; i++) {
        const char *frames[2];
        for (int k = 0; k < 2; k++)
            frames[k] =
                m->cells[(size_t)(k ? t->reference : t->stimuli[i]) * m->columns + (size_t)csv_column(m, "frames")];
        if (strcmp(frames[0], frames[1]) != 0)
            return err_set(e, ERR_SCENE,
                           "%s: %s has %s samples, its reference %s: webMUSHRA wants sounds of one length on a page: "
                           "length: longest, in the design",
                           x->set, x->design->stimuli[t->stimuli[i]].name, frames[0], frames[1]);
    }
    return true;
}

static bool webmushra_list(struct export *x, const struct export_list *l, struct err *e)
{
    if (said(x)->task == DESIGN_TASK_COMPARE)
        return err_set(
            e, ERR_SCENE,
            "%s: trials.task: webMUSHRA has no page on which one of two sounds is chosen; --for jspsych, page "
            "and psychopy do",
            x->design->file);
    for (int k = 0; k < l->n; k++)
        if (!webmushra_lengths(x, &l->trials[k], e)) return false;
    json_t *pages = json_array();
    if (said(x)->instructions)
        json_array_append_new(pages, json_value_object("type:s id:s name:s content:s", "generic", "instructions",
                                                       "Instructions", text_html(l->arena, said(x)->instructions)));
    for (int k = 0; k < l->n; k++)
        json_array_append_new(pages, webmushra_page(x, l, k));
    json_array_append_new(pages,
                          json_value_object("type:s name:s content:s popupContent:s showResults:b writeResults:b",
                                            "finish", "Thank you", "", "Your answers were sent.", false, true));
    json_t *all = json_value_object("testname:s testId:s bufferSize:i stopOnErrors:b showButtonPreviousPage:b "
                                    "remoteService:s language:s pages:o",
                                    title(x), arena_format(l->arena, "%s_%s", x->name, l->name), 2048, true, false,
                                    "service/write.php", "en", pages);
    bool ok = export_open(x, arena_format(l->arena, "configs/%s_%s.yaml", x->name, l->name), e);
    if (ok) {
        fputs("# for webMUSHRA: to be opened with ?config= and this file's name", x->stream);
        put_yaml(x->stream, all, 0, false);
    }
    json_decref(all);
    return ok && export_close(x, e);
}

/* ------------------------------------------------------------------ tables of trials: PsychoPy and BIDS */

static const struct column {
    const char *name, *meaning; /* %d in the name: one for each sound                          */
    bool bids;                  /* to be filled in there                                       */
} columns[] = {
    {"trial", "place of the trial in the list, from 1", false},
    {"trial_id", "which trial of the design it is, the same for all participants", false},
    {"session", "label of the session's factor", false},
    {"block", "number of the block, from 1; 0: training", false},
    {"training", "1: the answer does not count", false},
    {"question", "what the listener is asked", false},
    {"text", "what the listener reads of the sounds", false},
    {"played", "the right answer", false},
    {"%s_%d", "a sound, in the order in which they are heard", false},
    {"stimulus_%d", "which stimulus it is, stimulus_id of the table of sounds", false},
    {"role_%d", "what it is for: test, reference, anchor or training", false},
    {"response", "the answer; of several sounds, numbers with blanks between", true},
    {"response_time", "how long it took, in seconds", true},
};

enum { COLUMNS = sizeof columns / sizeof *columns, OF_SOUND = 8, SOUND_COLUMNS = 3 };

/* Text of a cell of trial k; sound: from 0, of columns that each sound has. */
static const char *trial_cell(const struct export *x, const struct export_list *l, int k, int column, int sound)
{
    const struct trial *t = &l->trials[k];
    struct arena *a = l->arena;
    int i = sound < t->n ? t->stimuli[sound] : -1;
    switch (column) {
    case 0:
        return arena_format(a, "%d", k + 1);
    case 1:
        return id_of(x, t, a);
    case 2:
        return label(x, said(x)->session, t->session);
    case 3:
        return arena_format(a, "%d", l->trials[k].part);
    case 4:
        return t->training ? "1" : "0";
    case 5:
        return said(x)->question;
    case 6:
        return t->text;
    case 7:
        return played(x, t);
    case OF_SOUND:
        return i < 0             ? NULL
               : x->format->tabs ? arena_format(a, "%s.wav", x->design->stimuli[i].name)
                                 : export_sound(x, i, a);
    case OF_SOUND + 1:
        return i < 0 ? NULL : x->design->stimuli[i].name;
    case OF_SOUND + 2:
        return i < 0 ? NULL : role(x, i);
    default:
        return NULL;
    }
}

static const char *column_name(const struct export *x, int column, int sound, struct arena *a)
{
    const char *file = x->format->tabs ? "stim_file" : "file";
    if (column == OF_SOUND) return arena_format(a, "%s_%d", file, sound + 1);
    return column < OF_SOUND || column >= OF_SOUND + SOUND_COLUMNS
               ? columns[column].name
               : arena_format(a, column == OF_SOUND + 1 ? "stimulus_%d" : "role_%d", sound + 1);
}

static bool list_table(struct export *x, const struct export_list *l, const char *name, struct err *e)
{
    if (!export_open(x, name, e)) return false;
    for (int k = -1; k < l->n; k++) { /* -1: the head */
        for (int c = 0; c < COLUMNS; c++) {
            bool sounds = c >= OF_SOUND && c < OF_SOUND + SOUND_COLUMNS;
            for (int s = 0; s < (sounds ? x->trials.most : 1) && (!columns[c].bids || x->format->tabs); s++) {
                const char *text = k < 0 ? column_name(x, c, s, l->arena) : trial_cell(x, l, k, c, s);
                export_cell(x, c == 0, text ? text : "n/a");
            }
        }
        fputc('\n', x->stream);
    }
    return export_close(x, e);
}

static bool psychopy_list(struct export *x, const struct export_list *l, struct err *e)
{
    for (int k = 0; k < l->n; k++)
        for (int c = 5; c < 8; c++) {
            const char *text = trial_cell(x, l, k, c, 0);
            if (text && *text == '[' && text[strlen(text) - 1] == ']')
                return err_set(e, ERR_SCENE,
                               "%s: '%s' stands in brackets, which PsychoPy would compute: leave them out",
                               x->design->file, text);
        }
    return list_table(x, l, arena_format(l->arena, "conditions_%s.csv", l->name), e);
}

static bool psychopy_files(struct export *x, struct err *e)
{
    const struct design_trials *w = said(x);
    if (w->instructions && !export_text(x, "instructions.txt", arena_format(x->arena, "%s\n", w->instructions), e))
        return false;
    if (!export_open(x, "answers.csv", e)) return false;
    fputs("answer,text\n", x->stream);
    for (int i = 0; i < w->n_answers; i++) {
        export_cell(x, true, w->answers[i].label);
        export_cell(x, false, w->answers[i].text);
        fputc('\n', x->stream);
    }
    return export_close(x, e);
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

static bool bids_list(struct export *x, const struct export_list *l, struct err *e)
{
    struct arena *a = l->arena;
    const char *sub = arena_format(a, "sub-%s", export_person(x, l->participant, a)), *folder = sub;
    if (x->trials.n_sessions > 1) {
        const char *session = export_number(l->sitting, x->trials.n_sessions, a);
        folder = arena_format(a, "%s/ses-%s", sub, session);
        sub = arena_format(a, "%s_ses-%s", sub, session);
    }
    return list_table(x, l, arena_format(a, "%s/beh/%s_task-%s_beh.tsv", folder, sub, task_name(x)), e);
}

static bool bids_files(struct export *x, struct err *e)
{
    struct arena *a = x->arena;
    const char *about = "An experiment in listening, to be carried out. The sounds and what they were made from are in "
                        "stimuli/.";
    const char *people = "participant_id\n";
    if (!export_json(x, "dataset_description.json",
                     json_value_object("Name:s BIDSVersion:s DatasetType:s", title(x), "1.9.0", "raw"), e) ||
        !export_text(x, "README", arena_format(a, "%s\n\n%s\n", title(x), about), e) ||
        !export_text(x, ".bidsignore", "SHA256SUMS\n", e) || !x->trials.n)
        return !e->kind;
    json_t *columns_of = json_object();
    json_value_set(columns_of, "TaskName:s TaskDescription:? Instructions:?", task_name(x), said(x)->question,
                   said(x)->instructions);
    for (int c = 0; c < COLUMNS; c++)
        for (int s = 0; s < (c >= OF_SOUND && c < OF_SOUND + SOUND_COLUMNS ? x->trials.most : 1); s++) {
            json_t *one = json_value_object("Description:s", columns[c].meaning);
            json_t *levels = !strcmp(columns[c].name, "response") ? json_object() : NULL;
            if (!strcmp(columns[c].name, "response_time")) json_value_set(one, "Units:s", "s");
            for (int i = 0; levels && said(x)->task != DESIGN_TASK_RATE && i < said(x)->n_answers; i++)
                json_object_set_new(levels, said(x)->answers[i].label, json_string(said(x)->answers[i].text));
            if (levels && json_object_size(levels))
                json_object_set_new(one, "Levels", levels);
            else
                json_decref(levels);
            json_object_set_new(columns_of, column_name(x, c, s, a), one);
        }
    for (int p = 1; p <= x->people; p++)
        people = arena_format(a, "%ssub-%s\n", people, export_person(x, p, a));
    return export_json(x, arena_format(a, "task-%s_beh.json", task_name(x)), columns_of, e) &&
           export_text(x, "participants.tsv", people, e);
}

/* ------------------------------------------------------------------ jsPsych, and a page without library */

static json_t *script_sound(const struct export *x, int i, struct arena *a)
{
    const struct design *d = x->design;
    json_t *levels = json_object();
    const char *level = "";
    for (int f = 0; f < d->n_factors; f++) {
        json_object_set_new(levels, d->factors[f].column, json_value_text(design_value(d, i, f)));
        if (said(x)->within[f]) level = arena_format(a, "%s%s%s", level, *level ? ", " : "", design_label(d, i, f));
    }
    return json_value_object("file:s stimulus_id:s role:s level:s levels:o", export_sound(x, i, a), d->stimuli[i].name,
                             role(x, i), level, levels);
}

static bool script_list(struct export *x, const struct export_list *l, struct err *e)
{
    const struct design_trials *w = said(x);
    struct arena *a = l->arena;
    json_t *trials = json_array(), *answers = json_array();
    for (int i = 0; i < w->n_answers; i++)
        json_array_append_new(answers, json_value_object("label:s text:s", w->answers[i].label, w->answers[i].text));
    for (int k = 0; k < l->n; k++) {
        const struct trial *t = &l->trials[k];
        json_t *sounds = json_array();
        for (int i = 0; i < t->n; i++)
            json_array_append_new(sounds, script_sound(x, t->stimuli[i], a));
        json_array_append_new(trials,
                              json_value_object("trial:i trial_id:s block:i training:i text:s played:s sounds:o", k + 1,
                                                id_of(x, t, a), t->part, t->training, t->text, played(x, t), sounds));
    }
    json_t *study =
        json_value_object("title:s instructions:s task:s question:s answers:o participant:s session:s trials:o",
                          title(x), w->instructions, design_trials_tasks[w->task], w->question, answers,
                          arena_format(a, "%.*s", (int)strcspn(l->name, "_"), l->name),
                          l->n ? label(x, w->session, l->trials[0].session) : "n/a", trials);
    bool ok = export_open(x, arena_format(a, "lists/%s.js", l->name), e);
    if (ok) {
        fputs("study = ", x->stream);
        json_dumpf(study, x->stream, JSON_INDENT(1) | JSON_ENSURE_ASCII);
        fputs(";\n", x->stream);
    }
    json_decref(study);
    return ok && export_close(x, e);
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
    {"webmushra", "configs/resources/audio/%s", "stimuli.csv", .browser = true, .list = webmushra_list},
    {"psychopy", "sounds", "stimuli.csv", .files = psychopy_files, .list = psychopy_list},
    {"jspsych", "sounds", "stimuli.csv", .browser = true, .files = jspsych_files, .list = script_list},
    {"page", "sounds", "stimuli.csv", .browser = true, .files = page_files, .list = script_list},
    {"bids", "stimuli", "stimuli.tsv", .tabs = true, .bare = true, .files = bids_files, .list = bids_list},
    {"audiofolder", "%s", "metadata.csv", .splits = true},
    {.name = NULL},
};
