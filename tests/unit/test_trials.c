/* Trials and their orders: the papers' experiments by their printed counts, a small design by hand, and what must hold of any order, counted over many
 * participants. */
#include "batch/trials.h"
#include "folder.h"
#include "unit.h"

static struct arena *arena;

static struct design read_file(const char *file)
{
    struct design d;
    const char *messages;
    struct err e = {0};
    bool good = design_read(file, arena, &d, &messages, &e);
    ck_assert_msg(good, "%s: %s", file, messages);
    return d;
}

static struct design *made(const char *rest)
{
    static struct design d;
    folder_write("design.yaml", arena_format(arena, "rasp-design: 1\nbase: scene.yaml\n%s", rest));
    d = read_file(folder_path("design.yaml"));
    return &d;
}

static struct trials trials_of(const struct design *d)
{
    struct trials t;
    struct err e = {0};
    ck_assert_msg(trials_make(d, arena, &t, &e), "%s", e.text);
    return t;
}

static const char *names(const struct trials *t, const struct trial *x)
{
    const char *all = "";
    for (int k = 0; k < x->n; k++)
        all = arena_format(arena, "%s%s%s", all, k ? "+" : "", t->design->stimuli[x->stimuli[k]].name);
    return all;
}

static const char *all_names(const struct trials *t, const struct trial *list, int n)
{
    const char *all = "";
    for (int i = 0; i < n; i++)
        all = arena_format(arena, "%s%s%s%s", all, i ? " " : "", list[i].training ? "*" : "", names(t, &list[i]));
    return all;
}

/* papers/000 to 004: trials, sounds of each, what is for training, answers. Conditions are those that the design has. */
START_TEST(papers_have_their_counts)
{
    static const struct {
        const char *file;
        int trials, training, answers;
        int sounds; /* of a trial; 0: as many as there are conditions */
    } papers[] = {{"000_experiment_1", 30, 0, 5, 0}, {"000_experiment_3", 18, 0, 5, 0}, {"002_rolling", 36, 6, 5, 1},
                  {"002_controls", 90, 0, 3, 2},     {"003_materials", 16, 0, 5, 1},    {"004_continuum", 30, 0, 2, 1}};
    arena = folder_make();
    for (size_t i = 0; i < sizeof papers / sizeof *papers; i++) {
        struct design d =
            read_file(arena_format(arena, "%s/scenes/experiments/%s.yaml", getenv("ROOT"), papers[i].file));
        struct trials t = trials_of(&d);
        int training = 0, sounds = papers[i].sounds ? papers[i].sounds : d.factors[d.n_factors - 1].n_levels;
        for (int k = 0; k < t.n; k++) {
            training += t.all[k].training;
            ck_assert_int_eq(t.all[k].n, sounds);
            int differ = !t.all[k].differs; /* of three factors within a pair one varies in each of its groups */
            for (int f = 0; t.all[k].differs && f < d.n_factors; f++)
                differ += t.all[k].differs[f];
            ck_assert_int_eq(differ, 1);
        }
        ck_assert_int_eq(t.n - training, papers[i].trials);
        ck_assert_int_eq(training, papers[i].training);
        ck_assert_int_eq(d.trials->n_answers, papers[i].answers);
    }
    struct design d = read_file(arena_format(arena, "%s/scenes/experiments/000_experiment_2.yaml", getenv("ROOT")));
    ck_assert_int_eq(trials_of(&d).n, 5 * d.factors[1].n_levels);
    folder_remove();
}
END_TEST

#define FACTORS                                                                                                        \
    "factors:\n  place: [{label: p}, {label: q}]\n  kind: [{label: a, text: an A}, {label: b}, {label: c}]\n"          \
    "text: \"at {place}\"\n"

START_TEST(together_is_what_differs_within)
{
    arena = folder_make();
    struct trials t = trials_of(made(FACTORS "trials: {task: rate, within: kind, reference: [{kind: c}]}\n"));
    ck_assert_str_eq(all_names(&t, t.all, t.n), "p_a+p_b+p_c q_a+q_b+q_c");
    ck_assert_str_eq(t.design->stimuli[t.all[1].reference].name, "q_c");
    ck_assert_str_eq(t.all[1].text, "at q");
    t = trials_of(made(FACTORS "trials: {task: compare, within: [kind]}\n"));
    ck_assert_str_eq(all_names(&t, t.all, t.n), "p_a+p_b p_a+p_c p_b+p_c q_a+q_b q_a+q_c q_b+q_c");
    t = trials_of(made(FACTORS "trials: {task: choose, answers: kind, training: [{place: q, kind: [a, c]}]}\n"));
    ck_assert_str_eq(all_names(&t, t.all, t.n), "p_a p_b p_c *q_a q_b *q_c");
    ck_assert_int_eq(trials_right(&t, &t.all[4]), 1);
    ck_assert_ptr_null(t.all[0].text);
    t = trials_of(made(FACTORS "trials: {task: rate, within: kind, reference: [{kind: c}], training: [{place: p}]}\n"));
    ck_assert_str_eq(all_names(&t, t.all, t.n), "*p_a+p_b+p_c q_a+q_b+q_c");
    ck_assert_str_eq(t.design->stimuli[t.all[0].reference].name, "p_c");
    ck_assert_str_eq(t.design->stimuli[t.all[1].reference].name, "q_c");
    folder_remove();
}
END_TEST

START_TEST(orders_are_everyones_own)
{
    enum { PEOPLE = 600 };
    arena = folder_make();
    struct trials t = trials_of(made("factors:\n  kind: [{label: a}, {label: b}, {label: c}, {label: d}]\n"
                                     "trials: {task: compare, within: kind}\n"));
    int first[6] = {0}, turned = 0, n;
    for (int p = 1; p <= PEOPLE; p++) {
        struct trial *l = trials_list(&t, 7, p, 1, arena, &n), *again = trials_list(&t, 7, p, 1, arena, &n);
        bool seen[6] = {false};
        ck_assert_int_eq(n, 6);
        ck_assert_str_eq(all_names(&t, l, n), all_names(&t, again, n));
        for (int i = 0; i < n; i++) {
            ck_assert(!seen[l[i].id - 1]);
            seen[l[i].id - 1] = true;
            turned += l[i].stimuli[0] > l[i].stimuli[1];
        }
        first[l[0].id - 1]++;
    }
    double chi = 0; /* five degrees of freedom: beyond 25 by chance once in 7000; the seed is fixed */
    for (int i = 0; i < 6; i++)
        chi += (first[i] - PEOPLE / 6.) * (first[i] - PEOPLE / 6.) / (PEOPLE / 6.);
    ck_assert_double_lt(chi, 25);
    ck_assert_double_lt(fabs(turned - 3.0 * PEOPLE), 4 * sqrt(6 * PEOPLE * 0.25)); /* A and B: even, four deviations */
    const char *one = all_names(&t, trials_list(&t, 7, 3, 1, arena, &n), 6);
    ck_assert_str_ne(one, all_names(&t, trials_list(&t, 8, 3, 1, arena, &n), 6));
    folder_remove();
}
END_TEST

/* A level more comes in between: the order of the other trials stays. */
START_TEST(a_level_more_moves_no_other)
{
    arena = folder_make();
    const char *orders[2];
    for (int k = 0; k < 2; k++) {
        struct trials t =
            trials_of(made(arena_format(arena,
                                        "factors:\n  kind: [%s{label: a}, {label: b}, {label: c}, {label: d}, "
                                        "{label: e}]\ntrials: {task: rate}\n",
                                        k ? "{label: new}, " : "")));
        int n;
        struct trial *l = trials_list(&t, 7, 2, 1, arena, &n);
        orders[k] = "";
        for (int i = 0; i < n; i++)
            if (strcmp(names(&t, &l[i]), "new") != 0)
                orders[k] = arena_format(arena, "%s %s", orders[k], names(&t, &l[i]));
        ck_assert_int_eq(n, 5 + k);
    }
    ck_assert_str_eq(orders[0], orders[1]);
    folder_remove();
}
END_TEST

/* Each session comes at each place, and behind each other one, equally often: Williams' squares, of an even and an odd number. */
START_TEST(sessions_are_balanced)
{
    arena = folder_make();
    for (int sessions = 2; sessions <= 6; sessions++) {
        const char *levels = "";
        for (int i = 0; i < sessions; i++)
            levels = arena_format(arena, "%s%s{label: s%d}", levels, i ? ", " : "", i);
        struct trials t =
            trials_of(made(arena_format(arena,
                                        "factors:\n  s: [%s]\n  b: [{label: x}, {label: y}]\n  k: [{label: l}, "
                                        "{label: m}, {label: o}]\n"
                                        "trials: {task: compare, within: k, session: s, blocks: b, training: 2}\n",
                                        levels)));
        int at[6][6] = {{0}}, behind[6][6] = {{0}}, people = sessions % 2 ? 2 * sessions : sessions, n;
        for (int p = 1; p <= people; p++)
            for (int s = 1, last = -1; s <= sessions; s++) {
                struct trial *l = trials_list(&t, 1, p, s, arena, &n);
                int now = l[0].session, changes = 0;
                ck_assert_int_eq(n, 8);
                for (int i = 0; i < n; i++) {
                    ck_assert_int_eq(l[i].session, now);
                    ck_assert_int_eq(l[i].training, i < 2);
                    changes += i > 2 && l[i].block != l[i - 1].block;
                }
                ck_assert_int_eq(changes, 1);
                ck_assert_int_ne(l[0].block, l[1].block); /* training is of all blocks */
                at[now][s - 1]++;
                if (last >= 0) behind[last][now]++;
                last = now;
            }
        for (int i = 0; i < sessions; i++)
            for (int j = 0; j < sessions; j++) {
                ck_assert_int_eq(at[i][j], people / sessions);
                ck_assert_int_eq(behind[i][j], i == j ? 0 : people / sessions);
            }
    }
    folder_remove();
}
END_TEST

static void refused(const char *rest, const char *says)
{
    struct design d;
    const char *messages;
    struct err e = {0};
    folder_write("design.yaml", arena_format(arena, "rasp-design: 1\nbase: scene.yaml\n%s", rest));
    bool good = design_read(folder_path("design.yaml"), arena, &d, &messages, &e);
    ck_assert_msg(!good && e.kind == ERR_SCENE, "accepted: %s", rest);
    ck_assert_msg(strstr(messages, says), "%s\ndoes not say: %s", messages, says);
}

START_TEST(what_cannot_be_is_refused)
{
    arena = folder_make();
    static const char *const wrong[][2] = {
        {"{question: x}", "trials.task is missing"},
        {"{task: listen}", "trials.task must be rate, choose or compare"},
        {"{task: rate, withn: kind}", "unknown key 'withn' in trials"},
        {"{task: rate, within: kinds}", "did you mean 'kind'?"},
        {"{task: compare}", "must say in which factors"},
        {"{task: choose}", "two answers at least"},
        {"{task: choose, answers: kind, within: place}", "no within"},
        {"{task: choose, answers: [x, x]}", "there twice"},
        {"{task: rate, answers: kind}", "only where the task is to choose"},
        {"{task: compare, within: kind, answers: [a, b, c, d]}", "two or three answers"},
        {"{task: rate, within: kind, session: kind}", "cannot differ within a trial"},
        {"{task: rate, within: kind, reference: [{kind: [a, b]}]}", "one trial has two: p_a and p_b"},
        {"{task: rate, within: kind, reference: [{kind: a, place: p}]}", "has none"},
        {"{task: rate, anchors: [{kind: a}]}", "several sounds"},
        {"{task: choose, answers: kind, training: [{kind: [a, b, c]}]}", "no trial is left"},
        {"{task: choose, answers: kind, training: -1}", "a number of trials"},
        {"{task: rate, within: place}", "differs within a trial"},
        {"{task: rate, question: \"a\\tb\"}", "a text of one line"},
        {"[rate]", "trials must be a map"},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++)
        refused(arena_format(arena, FACTORS "trials: %s\n", wrong[i][0]), wrong[i][1]);
    refused("factors: {kind: [{label: a}]}\ntrials: {task: compare, within: kind}\n", "no other sound");
    folder_remove();
}
END_TEST

UNIT("trials", papers_have_their_counts, together_is_what_differs_within, orders_are_everyones_own,
     a_level_more_moves_no_other, sessions_are_balanced, what_cannot_be_is_refused)
