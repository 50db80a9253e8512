/* Conditions and alternatives name keys by their paths; a path that names none would be taken for "always". */
#include "unit.h"

#include "scene/keys.h"
#include "scene/params.h"

static bool is_word(const struct key *k, const char *word, size_t n)
{
    for (const struct choice *c = k->choices; c && c->word; c++)
        if (strlen(c->word) == n && !strncmp(c->word, word, n)) return true;
    return false;
}

/* "key=word|word", "key" or "!key", as `applies` has it. */
static void condition_good(const char *of, const struct key *k)
{
    if (!k->applies) return;
    const struct key *decides = keys_decider(k);
    ck_assert_msg(decides != NULL, "%s: '%s' names no key", of, k->applies);
    for (const char *w = keys_words(k); w && *w; w += strcspn(w, "|"), w += *w == '|')
        ck_assert_msg(is_word(decides, w, strcspn(w, "|")), "%s: '%s' is no word of %s", of, w, decides->path);
    if (!keys_words(k))
        ck_assert_msg(decides->type == KEY_FILE || decides->type == KEY_NUMBER, "%s: is %s given?", of, decides->path);
}

static bool is_path(const char *path)
{
    for (const struct key_section *s = keys_sections; s->path; s++)
        if (!strcmp(s->path, path)) return true;
    return keys_find(path) != NULL;
}

START_TEST(every_condition_names_a_key_and_its_words)
{
    for (const struct key *k = keys_table; k->path; k++)
        condition_good(k->path, k);
    for (const struct key_alternative *t = keys_alternatives; t->paths[0]; t++) {
        struct key condition = keys_condition(t);
        condition_good(t->paths[0], &condition);
    }
}
END_TEST

START_TEST(every_alternative_is_a_key_or_section)
{
    for (const struct key_alternative *t = keys_alternatives; t->paths[0]; t++)
        for (int i = 0; t->paths[i]; i++)
            ck_assert_msg(is_path(t->paths[i]), "'%s' is neither", t->paths[i]);
}
END_TEST

START_TEST(every_rule_is_of_two_numbers)
{
    const struct params *p;
    for (int i = 0; (p = stages_params(i)); i++)
        for (const struct params_rule *r = p->rules; r && r->path; r++) {
            const struct key *k[2] = {keys_find(r->path), keys_find(r->other)};
            for (int j = 0; j < 2; j++)
                ck_assert_msg(k[j] && k[j]->type == KEY_NUMBER && k[j]->of == KEY_CONTACT, "%s: %s", p->section,
                              j ? r->other : r->path);
        }
}
END_TEST

/* Its rows are in its section, and its struct begins with the bool that says whether it is given; or it has no section,
 * and says itself when its rows count. */
START_TEST(every_effect_is_in_its_section)
{
    const struct params *p;
    for (int i = 0; (p = stages_params(i)); i++) {
        size_t n = strlen(p->section);
        const struct key_section *s = keys_sections;
        while (s->path && strcmp(s->path, p->section) != 0)
            s++;
        ck_assert_msg(p->meaning ? s->path && s->in == p : (p->given || !p->size) && !s->path, "%s", p->section);
        for (const struct key *k = p->keys; k && k->path; k++) {
            bool within = !strncmp(k->path, p->section, n) && k->path[n] == '.' && k->offset >= sizeof(bool);
            if (!k->meaning || k->path[0] == '.') continue; /* a place; of several bodies */
            ck_assert_msg((p->given || !p->size || within) && keys_find(k->path) && keys_find(k->path)->in == p, "%s",
                          k->path);
        }
    }
}
END_TEST

START_TEST(no_path_is_there_twice)
{
    for (const struct key *k = keys_table; k->path; k++)
        ck_assert_msg(keys_find(k->path) == k, "%s", k->path);
}
END_TEST

UNIT("keys", every_condition_names_a_key_and_its_words, every_alternative_is_a_key_or_section,
     every_rule_is_of_two_numbers, every_effect_is_in_its_section, no_path_is_there_twice)
