/* The table of `rasp accuracy` as CSV: one row per setting, SI units and dB; a cell is empty where there is no figure, inf where samples are the same. */
#include <math.h>

#include "cmd/accuracy.h"

static void cell(FILE *f, double x)
{
    if (isnan(x))
        fputc(',', f);
    else
        fprintf(f, ",%.6g", x);
}

static void errors(FILE *f, const struct accuracy_render *r)
{
    const struct accuracy_error *o = r && r->code == 0 ? &r->error : NULL;
    cell(f, o ? o->snr : NAN);
    cell(f, o ? o->third : NAN);
    cell(f, o ? o->third_hz : NAN);
    cell(f, o ? o->spectral : NAN);
    cell(f, o ? o->level : NAN);
    cell(f, o ? o->follows : NAN);
}

static void row(const struct accuracy_sweep *s, const struct accuracy_row *w, FILE *f)
{
    const struct accuracy_render *r = &s->renders[w->total];
    bool ran = r->code == 0;
    fprintf(f, "%s,%s,%d", w->name, w->value, w->chosen);
    errors(f, w->alone >= 0 ? &s->renders[w->alone] : NULL);
    cell(f, w->order);
    errors(f, r);
    cell(f, ran ? r->cpu : NAN);
    cell(f, ran ? r->error.length / fmax(r->cpu, 1e-9) : NAN);
    fprintf(f, ran ? ",%.0f" : ",", r->peak);
    cell(f, ran ? r->contact_share : NAN);
    fprintf(f, ",%d,%d,%d", r->front, accuracy_judge_below(s, r), r->code);
    cell(f, isfinite(s->until) ? s->until : NAN);
    cell(f, s->own_db);
    fputc('\n', f);
}

void accuracy_table(const struct accuracy_sweep *s, FILE *f)
{
    fputs("setting,value,scene", f);
    for (int i = 0; i < 2; i++) {
        const char *of = i ? "" : "alone_";
        fprintf(f, ",%ssnr_db,%sthird_octave_db,%sthird_octave_hz,%sspectral_db,%slevel_db,%sfollows_s%s", of, of, of, of, of, of, i ? "" : ",order");
    }
    fputs(",cpu_s,real_time_factor,peak_bytes,contact_share,front,below_reference,exit_code,diverges_s,reference_snr_db\n", f);
    for (int i = 0; i < s->n_rows; i++)
        row(s, &s->rows[i], f);
}
