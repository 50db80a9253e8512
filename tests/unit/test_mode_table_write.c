/* Mode tables that are written and read again. */
#include <unistd.h>

#include "response/mode_table.h"
#include "unit.h"

/* Complex gains all round the circle come back (12 digits: 1e-11), whatever the quantity; modes in the order asked for.
 */
START_TEST(what_is_written_is_read)
{
    enum { N = 24 };
    static const char *const words[] = {"displacement", "velocity", "acceleration"};
    double f[N], decay[N], re[N], im[N];
    int order[N];
    for (int i = 0; i < N; i++) {
        double angle = 2 * M_PI * (i + 0.3) / N;
        f[i] = 100.0 / 3 * (i + 1);
        decay[i] = 7.0 / (i + 1);
        re[i] = (i + 1) * cos(angle) * 1e-3;
        im[i] = (i + 1) * sin(angle) * 1e-3;
        order[i] = N - 1 - i;
    }
    for (int quantity = MODES_DISPLACEMENT; quantity <= MODES_ACCELERATION; quantity++) {
        struct arena *a = arena_open();
        struct mode_table t;
        struct err e = {0};
        FILE *out = fopen("written.csv", "w");
        fprintf(out, "# poles: shared\n# quantity: %s\n", words[quantity]);
        mode_table_write_header(out);
        for (int place = 1; place <= 2; place++)
            mode_table_write_place(out, &(struct mode_table_place){12, place, 0.1 * place, -0.0}, N, order,
                                   &(struct modes_point){f, decay, re, im}, quantity);
        fclose(out);
        ck_assert_msg(mode_table_read("written.csv", a, &t, &e), "%s", e.text);
        ck_assert_int_eq(t.quantity, quantity);
        ck_assert(t.places == 2 && t.modes == N);
        for (size_t place = 0; place < 2; place++)
            for (size_t k = 0; k < N; k++) {
                const struct mode_entry *v = &t.entry[t.first[place] + k];
                size_t i = k; /* by rising frequency, whatever the order of rows */
                double gain = v->slope[0].gain, phase = v->slope[0].phase,
                       sign = quantity == MODES_VELOCITY       ? im[i]
                              : quantity == MODES_DISPLACEMENT ? re[i]
                                                               : -re[i];
                ck_assert_double_eq_tol(t.xy[2 * place], 0.1 * (double)(place + 1), 1e-12);
                ck_assert_double_eq_tol(v->frequency, f[i], 1e-11 * f[i]);
                ck_assert_double_eq_tol(v->slope[0].decay, decay[i], 1e-11 * decay[i]);
                ck_assert_double_eq_tol(gain * cos(phase), re[i], 1e-11 * fabs(gain));
                ck_assert_double_eq_tol(gain * sin(phase), im[i], 1e-11 * fabs(gain));
                ck_assert(gain * sign > 0);
            }
        arena_close(a);
    }
    unlink("written.csv");
}
END_TEST

/* Silence is 0 without a sign, as text. */
START_TEST(zeros_have_no_sign)
{
    double f = 1, decay = 0.5, zero = -0.0, im = -0.0;
    int order = 0;
    char text[200] = "";
    FILE *out = fmemopen(text, sizeof text, "w");
    mode_table_write_place(out, &(struct mode_table_place){12, 7, -0.0, 0.25}, 1, &order,
                           &(struct modes_point){&f, &decay, &zero, &im}, MODES_VELOCITY);
    fclose(out);
    ck_assert_str_eq(text, "7,0,0.25,1,1,0.5,0,0\n");
}
END_TEST

UNIT("mode_table_write", what_is_written_is_read, zeros_have_no_sign)
