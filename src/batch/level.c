/* See level.h. With F the full_scale, r the raw samples (float64 of a render at full_scale 1, that is, times 1) and g = 1/F as a render has it (output/sound.c), a
   sample of the file is g r, rounded once to the encoding: the same two operations on the same numbers as in a render of the effective scene.

     peak   F = greatest peak / min(10^(L/20), largest value of the encoding)
     rms    F = greatest rms / 10^(L/20)
     lufs   F = 10^((greatest loudness - L)/20) */
#include "batch/level.h"

#include <math.h>
#include <string.h>

#include "batch/level_files.h"
#include "num/real.h"

struct level_greatest level_start(void)
{
    return (struct level_greatest){.lufs = -HUGE_VAL, .encoding = ENCODING_FLOAT64};
}

void level_look(struct level_greatest *g, const struct record *r)
{
    if (!r->sounds)
        return;
    g->peak = fmax(g->peak, r->peak);
    g->rms = fmax(g->rms, r->rms);
    g->unmeasured = g->unmeasured || !r->loud;
    g->lufs = isnan(r->lufs) ? g->lufs : fmax(g->lufs, r->lufs);
    g->encoding = r->encoding < g->encoding ? r->encoding : g->encoding;
    g->sounds = g->sounds || r->peak > 0;
}

static double largest(int encoding)
{
    return encoding == ENCODING_PCM16 ? 1 - ldexp(1, -15) : encoding == ENCODING_PCM24 ? 1 - ldexp(1, -23) : 1;
}

bool level_find(const struct set *set, const struct level_greatest *g, double *full_scale, struct err *e)
{
    const struct level *l = &set->level;
    *full_scale = 1;
    if (!g->sounds)
        return true;
    if (!isnan(l->rms))
        *full_scale = g->rms / real_exp10(l->rms / 20);
    else if (isnan(l->lufs))
        *full_scale = g->peak / fmin(real_exp10(l->peak / 20), largest(g->encoding));
    else if (g->unmeasured)
        return err_set(e, ERR_INPUT, "level: lufs: the loudness of a stimulus was not measured when it was rendered for another level: run its shard again");
    else if (isinf(g->lufs))
        return err_set(e, ERR_SCENE, "level: lufs: no stimulus of the set has a loudness that BS.1770 can measure (0.4 s or more that are not nearly silent): use rms or peak");
    else
        *full_scale = real_exp10((g->lufs - l->lufs) / 20);
    return true;
}

bool level_apply(const struct job_kit *k, const struct record *raw, double full_scale, struct arena *a, struct journal_ref *ref, struct err *e)
{
    struct level_files f;
    struct record *done = ARENA_TAKE(a, struct record, 1);
    *done = *raw;
    done->full_scale = full_scale;
    done->job = job_hash((const char *const[]){"level", raw->key, arena_format(a, "%.17g", full_scale)}, 3, a);
    done->audio = raw->sounds ? arena_take(a, HASH_TEXT, 1) : NULL;
    if (!level_files_make(&f, k, done, a, e) || !level_files_commit(&f, e)) {
        level_files_drop(&f);
        return false;
    }
    done->files = f.made;
    done->n_files = f.n;
    if ((raw->sounds && !job_measure(k->folder, true, done, e)) || !journal_add(k->journal, done, ref, e))
        return false;
    level_files_forget(&f);
    return true;
}
