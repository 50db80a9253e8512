/* cmd/report: one description, printed as text and as JSON. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cmd/report.h"
#include "unit.h"

static char *described(bool json)
{
    static const double x[2] = {0.5, NAN};
    char *text = NULL;
    size_t size;
    struct err e = {0};
    FILE *f = open_memstream(&text, &size);
    struct report r = report_open(f, json);
    report_text(&r, "a.gsf\n");
    report_set(&r, "file:s rows:z later:0 none:n", "a.gsf", (size_t)3, INFINITY);
    report_figure(&r, "sq_m", 2e-6, "Sq", "%g um", 2.0);
    report_list(&r, "parts");
    report_object(&r, NULL);
    report_set(&r, "x:a channel:c ok:b", x, 2, -1L, 1);
    report_end(&r);
    report_end(&r);
    report_object(&r, "later");
    report_set(&r, "n:i", 7);
    report_end(&r);
    report_row(&r, "label", "%d of %d", 1, 2);
    report_note(&r, "  note: ", "words");
    ck_assert(report_close(&r, 12, &e));
    fclose(f);
    return text;
}

START_TEST(as_text)
{
    char *text = described(false);
    ck_assert_str_eq(text, "a.gsf\n  Sq                   2 um\n  label                1 of 2\n  note: words\n");
    free(text);
}
END_TEST

/* A later member of the same key keeps the place of the first; what is not finite is null. */
START_TEST(as_json)
{
    char *text = described(true);
    json_t *j = json_loads(text, 0, NULL);
    char *plain = json_dumps(j, JSON_COMPACT);
    ck_assert_str_eq(plain,
                     "{\"file\":\"a.gsf\",\"rows\":3,\"later\":{\"n\":7},\"none\":null,\"sq_m\":1.9999999999999999e-6,"
                     "\"parts\":[{\"x\":[0.5,null],\"channel\":null,\"ok\":true}]}");
    free(plain);
    json_decref(j);
    free(text);
}
END_TEST

UNIT("report", as_text, as_json)
