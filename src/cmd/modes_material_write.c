/* What `rasp modes material` writes: the material's file, and the report. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/text.h"
#include "cmd/modes_material.h"
#include "cmd/report.h"
#include "num/real.h"

static double decibel(double log_ratio) { return 20.0 / real_log(10.0) * log_ratio; }

static void put(FILE *f, const char *key, const struct material_figure *x, const char *unit)
{
    fprintf(f, "    %s: %.6g%s%s", key, x->value, *unit ? " " : "", unit);
    if (!isnan(x->low)) fprintf(f, " # 95 %%: %.6g to %.6g", x->low, x->high);
    fputc('\n', f);
}

/* The density, and Young's modulus: where the mass was weighed, lengths that are all too long by a share s make the
   density 3 s too low and E/density 2 s too high, so that of E it is s. */
static void modulus_of(const struct modes_material *j, struct material_figure *e, struct material_figure *density)
{
    const struct material_figure *g = &j->fit.gamma;
    bool weighed = j->size_error > 0.0 && args_given(&j->c->args, "mass") && !isnan(g->low);
    double size = 1.96 * j->size_error, half = real_log(g->high / g->value),
           own =
               weighed ? sqrt(fmax(half * half - 3.0 * size * size, 0.0)) : half; /* of (2 size)^2 there stays size^2 */
    *e = (struct material_figure){g->value * j->density, g->value * j->density * real_exp(-own),
                                  g->value * j->density * real_exp(own)};
    *density = (struct material_figure){j->density, NAN, NAN};
    if (weighed) {
        density->low = j->density * real_exp(-3.0 * size);
        density->high = j->density * real_exp(3.0 * size);
    }
}

void modes_material_write(FILE *f, const struct modes_material *j)
{
    const struct material_fit *t = &j->fit;
    struct arena *a = j->c->arena;
    double damping[3];
    struct material_figure e, density, speed = {sqrt(t->gamma.value), sqrt(t->gamma.low), sqrt(t->gamma.high)};
    modulus_of(j, &e, &density);
    fprintf(f, "# A material by rasp modes material: include this file in a scene and write material: %s\n", j->name);
    for (int o = 0; o < j->n; o++)
        fprintf(f, "# object %d: %s, %.6g m^3\n", o + 1, text_shown(a, j->thing[o].text),
                j->thing[o].solid.boundary.volume);
    for (int i = 0; i < j->strikes; i++) {
        const char *slash = strrchr(j->strike[i].file, '/');
        fprintf(f, "# strike %d: of object %d, %s, sha256 %s\n", i + 1, j->set[i].object + 1,
                text_shown(a, slash ? slash + 1 : j->strike[i].file), j->strike[i].hash);
    }
    if (j->paper)
        fprintf(f, "# method: the search of Ren et al. (2013), the best of %ld starts\n", j->starts);
    else
        fprintf(f, "# matched: %d of %d modes, %.3g %% beside computed ones (rms); %d that should show are missing\n",
                t->matched, t->modes, 100.0 * t->scatter, t->missing);
    if (!isnan(j->metric.image))
        fprintf(f, "# metrics: image %.4g, feature %.4g (0: alike)\n", j->metric.image, j->metric.feature);
    for (char *rest = t->warning ? arena_text(a, t->warning) : NULL, *line; (line = strsep(&rest, "\n"));)
        fprintf(f, "# warning: %s\n", line);
    fprintf(f, "materials:\n  %s:\n", j->name);
    if (isnan(j->density))
        put(f, "wave_speed", &speed, "m/s"); /* sqrt(E/density) */
    else {
        put(f, "youngs_modulus", &e, "Pa");
        put(f, "density", &density, "kg/m^3");
    }
    if (j->wood)
        fprintf(f, "    like: %s # moduli across the grain keep their ratios to that along it\n", j->wood->name);
    else
        put(f, "poisson", &t->nu, "");
    material_damping_terms(t->damping, t->best, damping);
    static const char *const names[3] = {"alpha", "beta", "loss"}, *const units[3] = {"1/s", "s", ""};
    for (int k = 0; k < 3; k++) {
        struct material_figure x = {damping[k], NAN, NAN};
        const struct material_damping *d = &t->damping[t->best];
        for (int i = 0; i < d->n; i++)
            if (!strcmp(d->parameter[i], names[k])) x = d->figure[i];
        put(f, names[k], &x, units[k]);
    }
    if (j->paper)
        fputs("    source: fitted to the sound of a strike by the search of Ren et al. (2013)\n", f);
    else
        fprintf(f, "    source: fitted to %d modes of %d strike%s; damping by the law %s%s\n", t->matched, j->strikes,
                j->strikes == 1 ? "" : "s", t->damping[t->best].name, j->polish ? ", polished on the sound" : "");
}

static void report_figure_of(struct report *r, const char *key, const char *label, const struct material_figure *x,
                             const char *unit)
{
    report_object(r, key);
    report_set(r, "value:n low:n high:n", x->value, x->low, x->high);
    report_end(r);
    if (isnan(x->low))
        report_row(r, label, "%.6g%s%s", x->value, *unit ? " " : "", unit);
    else
        report_row(r, label, "%.6g%s%s (95 %%: %.6g to %.6g)", x->value, *unit ? " " : "", unit, x->low, x->high);
}

static void report_damping(struct report *r, const struct modes_material *j)
{
    const struct material_fit *f = &j->fit;
    report_list(r, "damping");
    for (int law = 0; law < MATERIAL_LAWS; law++) {
        const struct material_damping *d = &f->damping[law];
        if (!isfinite(d->bic)) continue; /* as many terms as modes, or more */
        report_object(r, NULL);
        report_set(r, "law:s bic:n scatter:n chosen:b", d->name, d->bic, d->scatter, law == f->best);
        report_text(r, "  damping %-16s BIC %8.1f, scatter %4.1f %%%s", d->name, d->bic, 100.0 * d->scatter,
                    law == f->best ? ", chosen:" : ":");
        for (int k = 0; k < d->n; k++) {
            const struct material_figure *x = &d->figure[k];
            report_object(r, d->parameter[k]);
            report_set(r, "value:n low:n high:n", x->value, x->low, x->high);
            report_end(r);
            report_text(r, " %s %.4g", d->parameter[k], x->value);
            if (!isnan(x->low)) report_text(r, " (%.4g to %.4g)", x->low, x->high);
            report_text(r, "%s%s%s", *d->unit[k] ? " " : "", d->unit[k], k + 1 < d->n ? "," : "");
        }
        report_text(r, "\n");
        report_end(r);
    }
    report_end(r);
}

static void report_matches(struct report *r, const struct modes_material *j)
{
    double *log_ratio, *slope;
    report_list(r, "strikes");
    for (int i = 0; i < j->strikes; i++) {
        const struct material_set *set = &j->set[i];
        const struct modes_material_strike *s = &j->strike[i];
        const struct solid_family *f = &j->family[set->object];
        int matched = 0;
        log_ratio = ARENA_TAKE(j->c->arena, double, f->n);
        slope = ARENA_TAKE(j->c->arena, double, f->n);
        solid_family_at(f, j->fit.nu.value, log_ratio, slope);
        report_object(r, NULL);
        report_set(r, "file:s sha256:s object:i strength:n spread_db:n", s->file, s->hash, set->object + 1, s->strength,
                   decibel(s->spread));
        report_list(r, "modes");
        for (int k = 0; k < set->n; k++) {
            int branch = set->match[k];
            double computed = NAN, d = NAN;
            if (branch >= 0) {
                const struct material_damping *law = &j->fit.damping[j->fit.best];
                double parameter[3];
                for (int p = 0; p < law->n; p++)
                    parameter[p] = law->figure[p].value;
                d = material_damping_decay(j->fit.best, parameter, real_exp(set->log_lambda[k]));
                double lambda = real_exp(log_ratio[branch]) * j->fit.gamma.value;
                computed = sqrt(fmax(lambda - d * d, 0.0)) / (2.0 * REAL_PI);
                matched++;
            }
            report_object(r, NULL);
            report_set(r, "frequency_hz:n decay_per_s:n computed_hz:n computed_decay_per_s:n", set->frequency[k],
                       set->decay[k], computed, d);
            report_end(r);
        }
        report_end(r);
        report_end(r);
        report_text(r, "  %s: %d of %d modes match", s->file, matched, set->n);
        if (!isnan(s->strength)) report_text(r, "; strength %.4g", s->strength);
        if (!isnan(s->spread)) report_text(r, "; gains %.3g dB (rms) beside computed ones", decibel(s->spread));
        report_text(r, "\n");
    }
    report_end(r);
}

/* Where each start of --method paper ended. */
static void report_endings(struct report *r, const struct modes_material *j)
{
    report_text(r, "  %14s %12s %12s %10s %10s\n", "E/density", "alpha 1/s", "beta s", "image", "feature");
    report_list(r, "endings");
    for (const struct modes_material_ending *end = j->ending; end < j->ending + j->starts; end++) {
        double gamma = real_exp(end->x[MATERIAL_GAMMA]), alpha = real_exp(end->x[MATERIAL_ALPHA_OF]),
               beta = real_exp(end->x[MATERIAL_BETA_OF]);
        report_object(r, NULL);
        report_set(r, "youngs_modulus_per_density:n alpha:n beta:n metric_image:n metric_feature:n", gamma, alpha, beta,
                   end->metric.image, end->metric.feature);
        report_end(r);
        report_text(r, "  %14.6g %12.4g %12.4g %10.4g %10.4g\n", gamma, alpha, beta, end->metric.image,
                    end->metric.feature);
    }
    report_end(r);
}

static void report_warnings(struct report *r, const struct modes_material *j)
{
    report_list(r, "warnings");
    for (char *rest = j->fit.warning ? arena_text(j->c->arena, j->fit.warning) : NULL, *line;
         (line = strsep(&rest, "\n"));) {
        report_set(r, ":s", line);
        report_note(r, "  warning: ", line);
    }
    report_end(r);
}

bool modes_material_write_report(const struct modes_material *j, struct err *e)
{
    struct report r = report_open(stdout, args_given(&j->c->args, "json"));
    const struct material_fit *f = &j->fit;
    struct material_figure modulus, density;
    modulus_of(j, &modulus, &density);
    report_set(&r, "material:s name:s method:s", j->file, j->name, j->paper ? "paper" : "scan");
    report_text(&r, "%s: ", j->name);
    if (j->paper) {
        report_text(&r, "the best of %ld starts\n", j->starts);
    } else {
        report_text(&r,
                    "%d of %d modes match computed ones, %.3g %% beside them (rms); %d that should show are missing\n",
                    f->matched, f->modes, 100.0 * f->scatter, f->missing);
        report_set(&r, "modes:i matched:i missing:i scatter:n birge:n cost:n sure:b unique:b", f->modes, f->matched,
                   f->missing, f->scatter, f->birge, f->cost, f->sure, f->unique);
    }
    report_figure_of(&r, "youngs_modulus_per_density", "E/density at these sizes", &f->gamma, "m^2/s^2");
    if (!isnan(j->density)) {
        report_figure_of(&r, "youngs_modulus", "Young's modulus", &modulus, "Pa");
        report_figure_of(&r, "density", "density", &density, "kg/m^3");
    }
    if (!j->wood) report_figure_of(&r, "poisson", "Poisson's ratio", &f->nu, "");
    report_set(&r, "metric_image:n metric_feature:n evaluations:i", j->metric.image, j->metric.feature, j->evaluations);
    const struct modes_material_strike *first = j->strike; /* of which the metrics are */
    while (first < j->strike + j->strikes - 1 && first->places == 0)
        first++;
    if (isnan(j->metric.image))
        report_row(&r, "metrics", "not known without the place that was struck (FILE.csv@X,Y)");
    else
        report_row(&r, "metrics (0: alike)", "image %.4g, feature %.4g%s", j->metric.image, j->metric.feature,
                   csv_comment(&first->table.csv, "force")
                       ? "; the force was not recorded: the image shows the hammer, too"
                       : "");
    if (!isnan(f->gamma.low) && j->size_error == 0.0)
        report_note(&r, "  ",
                    "The intervals suppose exact sizes: all lengths 1 % too long make E/density 2 % too large, one "
                    "length of a bar up to 4 %. See --size-error. alpha is what material and support take "
                    "together.");
    if (j->paper)
        report_endings(&r, j);
    else {
        report_set(&r, "correlation:n", f->correlation);
        report_object(&r, "next");
        report_set(&r, "youngs_modulus_per_density:n poisson:n cost:n", isnan(f->next.cost) ? NAN : f->next.gamma,
                   isnan(f->next.cost) ? NAN : f->next.nu, f->next.cost);
        report_end(&r);
        report_damping(&r, j);
        report_matches(&r, j);
    }
    report_warnings(&r, j);
    return report_close(&r, 10, e);
}

void modes_material_write_damping(FILE *f, const struct modes_material *j)
{
    double damping[3];
    material_damping_terms(j->fit.damping, j->fit.best, damping);
    fprintf(f,
            "# The damping of an object by rasp modes material, for surface.recipe\nobject: {alpha: %.6g 1/s, beta: "
            "%.6g s, loss: %.6g}\nsource: fitted to %d modes of %d strike%s by the law %s\n",
            damping[0], damping[1], damping[2], j->fit.modes, j->strikes, j->strikes == 1 ? "" : "s",
            j->fit.damping[j->fit.best].name);
}

bool modes_material_write_damping_report(const struct modes_material *j, struct err *e)
{
    struct report r = report_open(stdout, args_given(&j->c->args, "json"));
    report_set(&r, "material:s name:s method:s modes:i sure:b", j->file, j->name, "damping", j->fit.modes, j->fit.sure);
    report_text(&r, "%s: damping of %d modes\n", j->name, j->fit.modes);
    report_damping(&r, j);
    report_warnings(&r, j);
    return report_close(&r, 10, e);
}
