/* See manifest_columns.h. Names are those that PsychoPy, R and BIDS take: lower case, with the unit at the end; file_name is what Hugging Face's AudioFolder looks for. */
#include "batch/manifest_columns.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "num/real.h"
#include "scene/keys.h"

void manifest_columns_number(FILE *f, double x)
{
    char text[40];
    if (!isfinite(x)) {
        fputs("n/a", f);
        return;
    }
    if (x == rint(x) && fabs(x) < 1e15) {
        fprintf(f, "%.0f", x + 0.0);
        return;
    }
    for (int digits = 1; digits <= 17; digits++) {
        snprintf(text, sizeof text, "%.*g", digits, x);
        if (strtod(text, NULL) == x)
            break;
    }
    fputs(text, f);
}

void manifest_columns_text(FILE *f, const char *text)
{
    bool quoted = text[strcspn(text, ",\"\r\n")] != '\0' || *text == ' ' || (*text && text[strlen(text) - 1] == ' ');
    if (quoted)
        fputc('"', f);
    for (; *text; text++) {
        if (*text == '"')
            fputc('"', f);
        fputc(*text, f);
    }
    if (quoted)
        fputc('"', f);
}

/* ------------------------------------------------------------------ cells */

static const struct record *record_of(const struct manifest_cell *c)
{
    return c->record;
}

/* Of a stimulus that has a WAV and is complete. */
static const struct record *sound_of(const struct manifest_cell *c)
{
    const struct record *r = record_of(c);
    return r && r->sounds && r->job ? r : NULL;
}

static void put(const struct manifest_cell *c, const char *text)
{
    manifest_columns_text(c->f, text ? text : "n/a");
}

static void put_number(const struct manifest_cell *c, bool known, double x)
{
    manifest_columns_number(c->f, known ? x : NAN);
}

static double decibel(double x)
{
    return x > 0 ? 20 * real_log10(x) : NAN;
}

static const struct record_file *file_of(const struct manifest_cell *c, const char *kind)
{
    const struct record *r = record_of(c);
    for (int i = 0; r && r->job && i < r->n_files; i++)
        if (!strcmp(r->files[i].kind, kind))
            return &r->files[i];
    return NULL;
}

static const struct record_file *main_file(const struct manifest_cell *c)
{
    static const char *const kinds[] = {"wav", "csv", "npy", "impacts"};
    const struct record_file *f = NULL;
    for (int k = 0; !f && k < 4; k++)
        f = file_of(c, kinds[k]);
    return f;
}

static const struct set_row *row_of(const struct manifest_cell *c)
{
    return &c->set->rows[c->row];
}

static void file_name(const struct manifest_cell *c) { put(c, main_file(c) ? main_file(c)->path : NULL); }
static void stimulus_id(const struct manifest_cell *c) { put(c, row_of(c)->name); }
static void row(const struct manifest_cell *c) { fprintf(c->f, "%d", c->row + 1); }
static void scene_file(const struct manifest_cell *c) { put(c, file_of(c, "scene") ? file_of(c, "scene")->path : NULL); }
static void scene_sha256(const struct manifest_cell *c) { put(c, file_of(c, "scene") ? file_of(c, "scene")->sha256 : NULL); }
static void text(const struct manifest_cell *c) { put(c, row_of(c)->text); }
static void replicate(const struct manifest_cell *c) { put_number(c, !row_of(c)->recording, row_of(c)->replicate); }
static void recording(const struct manifest_cell *c) { put(c, row_of(c)->recording); }

static void seed(const struct manifest_cell *c)
{
    if (row_of(c)->recording)
        put(c, NULL);
    else
        fprintf(c->f, "%" PRIu64, row_of(c)->seed);
}

static void rate(const struct manifest_cell *c) { put_number(c, record_of(c), record_of(c) ? record_of(c)->rate : 0); }
static void channels(const struct manifest_cell *c) { put_number(c, sound_of(c), sound_of(c) ? sound_of(c)->channels : 0); }
static void frames(const struct manifest_cell *c) { put_number(c, record_of(c), record_of(c) ? (double)record_of(c)->frames : 0); }
static void duration(const struct manifest_cell *c) { put_number(c, record_of(c), record_of(c) ? (double)record_of(c)->frames / record_of(c)->rate : 0); }
static void encoding(const struct manifest_cell *c) { put(c, sound_of(c) ? keys_find("output.encoding")->choices[sound_of(c)->encoding].word : NULL); }
static void level_mode(const struct manifest_cell *c) { put(c, c->level); }
static void gain(const struct manifest_cell *c) { put_number(c, sound_of(c), sound_of(c) ? decibel(sound_of(c)->gain) : 0); }
static void unit(const struct manifest_cell *c) { put(c, sound_of(c) ? sound_of(c)->unit : NULL); }
static void peak(const struct manifest_cell *c) { put_number(c, sound_of(c), sound_of(c) ? decibel(sound_of(c)->file_peak) : 0); }
static void silent(const struct manifest_cell *c) { put_number(c, sound_of(c), sound_of(c) ? sound_of(c)->file_peak == 0 : 0); }
static void beyond(const struct manifest_cell *c) { put_number(c, sound_of(c), sound_of(c) ? sound_of(c)->beyond : 0); }
static void true_peak(const struct manifest_cell *c) { put_number(c, sound_of(c), sound_of(c) ? rint(decibel(sound_of(c)->true_peak) * 1e4) / 1e4 : 0); }
static void rms(const struct manifest_cell *c) { put_number(c, sound_of(c), sound_of(c) ? decibel(sound_of(c)->file_rms) : 0); }
static void lufs(const struct manifest_cell *c) { put_number(c, sound_of(c), sound_of(c) ? rint(sound_of(c)->file_lufs * 1e4) / 1e4 : 0); }
static void ramp(const struct manifest_cell *c) { put_number(c, sound_of(c), sound_of(c) ? sound_of(c)->ramp : 0); }
static void onset(const struct manifest_cell *c) { put_number(c, sound_of(c), sound_of(c) && !row_of(c)->recording ? sound_of(c)->ramp : 0); }
static void audio(const struct manifest_cell *c) { put(c, sound_of(c) ? sound_of(c)->audio : NULL); }
static void file_sha256(const struct manifest_cell *c) { put(c, main_file(c) ? main_file(c)->sha256 : NULL); }
static void job(const struct manifest_cell *c) { put(c, !record_of(c) ? NULL : record_of(c)->job ? record_of(c)->job : record_of(c)->key); }
static void version(const struct manifest_cell *c) { put(c, c->set->build); }

static void status(const struct manifest_cell *c)
{
    put(c, record_of(c) ? (record_of(c)->job ? "ok" : "waits") : c->is->kind ? "failed" : "missing");
}

static void error_code(const struct manifest_cell *c) { fprintf(c->f, "%d", (int)c->is->kind); }
static void error(const struct manifest_cell *c) { put(c, c->is->text); }

const struct manifest_column manifest_columns[] = {
    {"file_name", "File", "the stimulus, from the folder of this table: a WAV, or the table of what makes no sound", NULL, file_name},
    {"stimulus_id", "Stimulus", "name of the stimulus, as the design makes it: its files begin with it", NULL, stimulus_id},
    {"plan_row", "Row", "number of the stimulus in the order of the design, from 1", NULL, row},
    {"scene_file", "Scene", "the effective scene, with every parameter spelt out: rendering it gives the same bytes; n/a of a recording", NULL, scene_file},
    {"scene_sha256", "Hash of the scene", "SHA-256 of scene_file, which names its inputs as they are seen from its folder: it is another where the folder lies elsewhere", NULL, scene_sha256},
    {"*", NULL, NULL, NULL, NULL},
    {"text", "Text", "what the stimulus is, in words for those who listen", NULL, text},
    {"replicate", "Replicate", "number of the replicate, from 1: replicates differ in their noise alone; n/a of a recording", NULL, replicate},
    {"seed", "Noise seed", "seed of the scene's noise, 64 bits: stimuli of one replicate share it, but for factors that the design calls independent", NULL, seed},
    {"recording", "Recording", "the supplied WAV that this stimulus was made from; n/a of what is rendered", NULL, recording},
    {"sample_rate_hz", "Sample rate", "audio samples per second", "Hz", rate},
    {"channels", "Channels", "channels of the WAV", NULL, channels},
    {"frames", "Frames", "samples of each channel", NULL, frames},
    {"duration_s", "Duration", "length of the file", "s", duration},
    {"encoding", "Encoding", "how samples are stored", NULL, encoding},
    {"level_mode", "Level rule", "how the level was set: common: one gain for the whole set, such that its greatest stimulus has the level; each: every stimulus has it; scene: as its scene says", NULL, level_mode},
    {"gain_db", "Gain", "file value per unit of the sound's quantity (of a recording: per its own sample value), in decibels", "dB", gain},
    {"gain_per", "Unit of the gain", "unit of the sound's quantity, which gain_db is per; n/a where recorded responses do not say theirs, and of a recording", NULL, unit},
    {"peak_dbfs", "Peak", "greatest sample of the file, re full scale", "dB", peak},
    {"true_peak_dbtp", "True peak", "greatest magnitude of the file between samples, too, re full scale: BS.1770, of four times as many samples (below 96 kHz)", "dB", true_peak},
    {"rms_dbfs", "Level", "rms of the whole file, re full scale (a square wave of full scale has 0)", "dB", rms},
    {"loudness_lufs", "Loudness", "integrated loudness of the file, BS.1770, mono counted on two ears; n/a below 0.4 s", "LUFS", lufs},
    {"silent", "Silent", "1: every sample of the file is 0; 0: some is not", NULL, silent},
    {"samples_beyond_full_scale", "Samples beyond full scale", "samples of the file, of all channels, whose magnitude is more than 1, as floating point holds them: whatever plays them clips", NULL, beyond},
    {"onset_ramp_s", "Onset ramp", "length of the raised-cosine ramp at the beginning", "s", onset},
    {"offset_ramp_s", "Offset ramp", "length of the raised-cosine ramp at the end", "s", ramp},
    {"audio_sha256", "Hash of the samples", "SHA-256 of the decoded samples, as rasp compare --hash has it", NULL, audio},
    {"file_sha256", "Hash of the file", "SHA-256 of file_name", NULL, file_sha256},
    {"job_hash", "Hash of the job", "SHA-256 of all that the stimulus depends on: effective scene, with inputs by their hashes and by their names as seen from the design, program, level; the same wherever the output folder lies", NULL, job},
    {"tool_version", "Program", "the program that made it", NULL, version},
    {"status", "Status", "ok; failed: see error; waits: the common gain is not known while other stimuli are missing; missing: not rendered yet", NULL, status},
    {"error_code", "Exit code", "what a render of this stimulus alone exits with: 0, or as the manual's EXIT STATUS has it", NULL, error_code},
    {"error", "Error", "why it failed; n/a of what did not", NULL, error},
    {NULL, NULL, NULL, NULL, NULL},
};
