/* Parts of `rasp modes material`: objects and strikes, the fit, and what is written of it. */
#ifndef CMD_MODES_MATERIAL_H
#define CMD_MODES_MATERIAL_H
#include "analysis/material_metric.h"
#include "analysis/material_set.h"
#include "cmd/modes_compute.h"
#include "response/mode_table.h"

struct modes_material_strike {
    const char *file, *shown;
    char hash[HASH_TEXT];
    struct mode_table table;
    bool placed;
    double x, y;             /* m, behind @ */
    int first, places;       /* of the object's points; places 0: not known where it was struck */
    double strength, spread; /* sigma of papers/003 eq. 8 and rms of log(gain/(sigma a)); NAN: not known */
};

struct modes_material_object { /* an object */
    const char *text;
    struct compute solid;
    struct boundary_point *point; /* [points] struck places, then the place that is heard */
    int points, ear;              /* ear -1: not given */
    double mass;                  /* kg; NAN: not weighed */
};

struct modes_material {
    struct cmd_call *c;
    int n, strikes;
    struct modes_material_object *thing;  /* [n] */
    struct modes_material_strike *strike; /* [strikes] */
    struct material_set *set;             /* [strikes] */
    struct solid_family *family;          /* [n] */
    double density;                       /* kg/m^3; NAN: not known */
    const char *name, *file;
    const struct material *wood; /* a material that keeps its moduli's ratios; NULL: isotropic */
    struct elastic elastic;      /* of that */
    double range[2], poisson, model_error, size_error;
    long modes;
    struct material_fit fit;
    bool paper, polish; /* --method paper, --polish perceptual */
    long starts;
    struct modes_material_ending {
        double x[MATERIAL_UNKNOWNS];
        struct material_metric metric;
    } * ending;                    /* [starts] of --method paper */
    struct material_metric metric; /* of the result; NAN: where was it struck? */
    int evaluations;
};

void modes_material_write(FILE *f, const struct modes_material *j);
bool modes_material_write_report(const struct modes_material *j, struct err *e);

/* Of strikes without an object: a file for surface.recipe, and the report. */
void modes_material_write_damping(FILE *f, const struct modes_material *j);
bool modes_material_write_damping_report(const struct modes_material *j, struct err *e);

#endif
