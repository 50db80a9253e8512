/* What the reader tells of series of impacts and of gestures, with its place; and what it takes. */
#include "scenes.h"

#include "force/gesture.h"
#include "force/impact_law.h"
#include "pipeline/stages.h"
#include "scene/params.h"

#define MOVES "rasp: 1\nmotion: {path: line, to: [1 cm, 0], duration: 1 s}\noutput: {diagnostics: {}}\n"
#define IMPACTS(keys) MOVES "contact: {model: impacts, impacts: {" keys "}}\n"
#define CUSTOM(keys) IMPACTS("prototype: custom, duration: {zeta: 1 ms}, " keys)
#define SERIES "amplitude: {mean: 0.3, deviation: 0.1}, interval: {mean: 5 ms, deviation: 1 ms}"

struct row {
    const char *text, *at, *says, *cure; /* at: where the message's place begins in the text */
};

static const struct row bad[] = {
    {IMPACTS("size: 0.5"), "impacts: {s", "contact.impacts.prototype is missing", "prototype: roll"},
    {IMPACTS("prototype: rolling"), "rolling",
     "contact.impacts.prototype must be one of: roll, rub, scratch, space, custom", "did you mean 'roll'"},
    {CUSTOM("interval: {mean: 5 ms, deviation: 1 ms}, amplitude: {deviation: 0.1}"), "amplitude",
     "contact.impacts.amplitude.mean is missing: of custom nothing is known", "mean: 0.3"},
    {CUSTOM("interval: {mean: 5 ms, deviation: 1 ms}, amplitude: {mean: 0.1}"), "amplitude",
     "contact.impacts.amplitude.deviation is missing", "deviation: 0.05"},
    {CUSTOM("amplitude: {mean: 0.3, deviation: 0.1}, interval: {deviation: 1 ms}"), "interval",
     "contact.impacts.interval.mean is missing", "mean: 5 ms"},
    {CUSTOM("amplitude: {mean: 0.3, deviation: 0.1}, interval: {mean: 1 ms}"), "interval",
     "contact.impacts.interval.deviation is missing", "deviation: 1 ms"},
    {IMPACTS("prototype: custom, " SERIES), "impacts: {p", "contact.impacts.duration.zeta is missing", "zeta: 0.4 ms"},
    {CUSTOM("amplitude: {mean: 0.3, distribution: table, table: a.csv, deviation: 1}, interval: {mean: 5 ms, "
            "deviation: 1 ms}"),
     "deviation: 1}",
     "contact.impacts.amplitude.deviation applies only where contact.impacts.amplitude.distribution is gaussian or "
     "exponential",
     "now it is table"},
    {CUSTOM("amplitude: {mean: 0.3, distribution: table}, interval: {mean: 5 ms, deviation: 1 ms}"), "amplitude",
     "contact.impacts.amplitude.table is missing", ""},
    {CUSTOM("amplitude: {mean: 0.3, deviation: 0.1}, interval: {mean: 0 s, deviation: 1 ms}"), "0 s, dev",
     "contact.impacts.interval.mean: impacts would come every 0 s on average", "mean: 5 ms"},
    {CUSTOM("amplitude: {mean: 0.3, deviation: 0.1}, interval: {mean: -1 ms, deviation: 1 ms, distribution: "
            "exponential, a1: 0.5}"),
     "-1 ms", "impacts would come every -0.0003333 s on average", ""},
    {CUSTOM("amplitude: {mean: 0.3, deviation: 0.1}, interval: {mean: 10 us, deviation: 0}"), "10 us",
     "contact.impacts.interval.mean: impacts would come every 1e-05 s on average, and the least interval, "
     "contact.impacts.floor.interval, is 2.268e-05 s",
     "lower contact.impacts.floor.interval"},
    {IMPACTS("prototype: roll, interval: {mean: -1 ms}"), "-1 ms",
     "contact.impacts.interval.mean: impacts would come every -0.001 s", ""},
    {IMPACTS("prototype: roll, amplitude: {mean: 0}"), "0}",
     "contact.impacts.amplitude.mean must be such that amplitudes are above 0 on average", "custom"},
    {CUSTOM("floor: {amplitude: 0.1}, amplitude: {mean: 0, deviation: 0.1}, interval: {mean: 5 ms, deviation: 1 ms}"),
     "0, dev", "contact.impacts.floor.amplitude is a share of the mean, and that is 0", "remove floor.amplitude"},
    {CUSTOM(SERIES ", modulation: {depth: 0.5}"), "modulation",
     "contact.impacts.modulation.rate is missing: contact.impacts.modulation.depth is above 0", "rate: 5 Hz"},
    {CUSTOM(SERIES ", modulation: {rate: 5 Hz}"), "5 Hz",
     "contact.impacts.modulation.rate has no effect where contact.impacts.modulation.depth is 0", "remove it"},
    {IMPACTS("prototype: roll, marginal: lognormal, interval: {distribution: exponential}"), "exponential",
     "contact.impacts.interval.distribution must be gaussian where contact.impacts.marginal is lognormal", "as_drawn"},
    {CUSTOM("marginal: lognormal, amplitude: {mean: -1, deviation: 0.1}, interval: {mean: 5 ms, deviation: 1 ms}"),
     "-1", "contact.impacts.amplitude.mean must be above 0 where contact.impacts.marginal is lognormal", "as_drawn"},
    {IMPACTS("prototype: rub, marginal: lognormal"), "marginal",
     "contact.impacts.marginal applies only where contact.impacts.prototype is roll or custom", "now it is rub"},
    {IMPACTS("prototype: rub, rub: {interval: 5 us}"), "5 us",
     "contact.impacts.rub.interval, 5e-06 s, is below the least interval", "raise contact.impacts.rub.interval"},
    {IMPACTS("prototype: scratch, floor: {interval: 20 ms}"), "20 ms",
     "contact.impacts.scratch.interval, 0.01 s, is below the least interval", "lower contact.impacts.floor.interval"},
    {IMPACTS("prototype: space, space: {radius: 1.01}"), "1.01", "contact.impacts.space.radius must be from -1 to 1",
     ""},
    {IMPACTS("prototype: space, space: {walk: w.csv, angle: 90 deg}"), "angle",
     "contact.impacts.space.angle applies only where contact.impacts.space.walk is not given", "remove it"},
    {IMPACTS("prototype: roll, space: {walk: w.csv}"), "walk",
     "contact.impacts.space.walk applies only where contact.impacts.prototype is space", "now it is roll"},
    {IMPACTS("prototype: roll, space: {angle: 90 deg}"), "angle",
     "contact.impacts.space.angle applies only where contact.impacts.prototype is space", "now it is roll"},
    {IMPACTS("prototype: rub") "surface: {roughness: {}}\n", "roughness",
     "surface.roughness has no effect where contact.model is impacts", "remove it"},
    {IMPACTS("prototype: rub") "grip: {}\n", "grip", "grip has no effect where contact.model is impacts", "remove it"},
    {IMPACTS("prototype: rub") "load: {release: 2 s}\n", "2 s}",
     "load.approach and load.release take 2 s together, and the motion lasts 1 s", "lower them"},
    {"rasp: 1\nmotion: {path: still, duration: 1 s}\noutput: {diagnostics: {}}\ncontact: {model: impacts, impacts: "
     "{prototype: rub}, gesture: {cutoff: 1 kHz}}\n",
     "{cutoff", "motion.path is still and contact.gesture is given", "let it move"},
    {"rasp: 1\nmotion: {path: still, duration: 1 s}\noutput: {diagnostics: {}}\ncontact: {model: given, given: {file: "
     "a.csv}, gesture: {order: 1}}\n",
     "{order", "motion.path is still and contact.gesture is given", ""},
    {MOVES "scraper: {mass: 1 g}\nsurface: {roughness: {}}\ncontact: {gesture: {}}\n", "gesture",
     "contact.gesture has no effect where contact.model is scrape", "impacts, playback or given"},
    {MOVES "scraper: {mass: 1 g}\nsurface: {roughness: {}}\ncontact: {gesture: {order: 1}}\n", "order",
     "contact.gesture.order applies only where contact.model is impacts, playback or given", ""},
    {MOVES "scraper: {mass: 1 g}\nsurface: {roughness: {}}\ncontact: {impacts: {size: 1}}\n", "size",
     "contact.impacts.size applies only where contact.model is impacts", "now it is scrape"},
    {"rasp: 1\noutput: {impacts: table, diagnostics: {}}\nmotion: {path: line, to: [1, 0], duration: 1}\nsurface: "
     "{roughness: {}}\nscraper: {mass: 1}\n",
     "table", "output.impacts is table, and no contact is of model impacts", "set contact.model to impacts"},
    {"rasp: 1\nmotion: {path: still, duration: 1 s}\ncontact: {model: impacts, impacts: {prototype: rub}}\n", "rasp",
     "nothing is asked of the contact", "surface.response"},
};

START_TEST(what_is_wrong_is_told_at_its_place)
{
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        char start[64];
        int line = 1, column = 1;
        struct result r = read_with(bad[i].text, NULL);
        const char *at = strstr(bad[i].text, bad[i].at);
        ck_assert_msg(at != NULL, "%s is not in\n%s", bad[i].at, bad[i].text);
        for (const char *s = bad[i].text; s < at; s++, column++)
            if (*s == '\n') {
                line++;
                column = 0;
            }
        snprintf(start, sizeof start, "scenes/t.yaml:%d:%d: error: ", line, column);
        one_error(&r, start, bad[i].says, bad[i].cure);
        arena_close(r.arena);
    }
}
END_TEST

/* A listing is enough to be asked for; a series needs no motion; a gesture follows any; on an incline gravity is the
 * motion's. */
START_TEST(what_is_taken)
{
    static const char *const good[] = {
        "rasp: 1\nmotion: {path: still, duration: 1 s}\ncontact: {model: impacts, impacts: {prototype: rub}}\noutput: "
        "{impacts: table}\n",
        "rasp: 1\nmotion: {path: incline, to: [1, 0], incline: -5 deg}\ncontact: {model: impacts, impacts: {prototype: "
        "rub}, gesture: {}}\noutput: {impacts: table}\n",
        IMPACTS("prototype: roll, amplitude: {mean: 0.5}, modulation: {depth: 0}, floor: {amplitude: 0}"),
        IMPACTS("prototype: space, space: {angle: 400 deg, angle_to: -1000 deg, radius: -1, radius_to: 0}"),
        CUSTOM("amplitude: {mean: 0, deviation: 0.1}, interval: {mean: 0, deviation: 5 ms, distribution: exponential}"),
        CUSTOM(SERIES ", modulation: {depth: 0.2, rate: 3}, marginal: lognormal, processes: two"),
        IMPACTS("prototype: rub") "load: {approach: 0, release: 0.5}\n",
    };
    for (size_t i = 0; i < sizeof good / sizeof good[0]; i++) {
        struct result r = read_with(good[i], NULL);
        ck_assert_msg(r.good, "%s", r.messages);
        arena_close(r.arena);
    }
}
END_TEST

/* What is left out is the prototype's: not a number. */
START_TEST(defaults)
{
    struct result r = read_with(IMPACTS("prototype: roll"), NULL);
    const struct impacts *m = impact_law_given(r.scene.contacts);
    ck_assert_msg(r.good, "%s", r.messages);
    ck_assert(m->prototype == PROTOTYPE_ROLL && m->size == 0.5 && m->velocity == 0.5 && m->roughness == 0.5 &&
              m->unit_force == 1);
    ck_assert(isnan(m->amplitude.mean) && isnan(m->amplitude.deviation) && isnan(m->interval.a1) &&
              isnan(m->interval.b1) && isnan(m->zeta) && isnan(m->theta));
    ck_assert(isnan(m->depth) && isnan(m->rate) && isnan(m->least_amplitude) && m->least_interval == 22.6757e-6);
    ck_assert(m->amplitude.distribution == DISTRIBUTION_GAUSSIAN && m->marginal == MARGINAL_AS_DRAWN &&
              m->processes == PROCESSES_ONE && !m->walk);
    ck_assert(!params_given(r.scene.contacts, gesture_stage.params) && r.scene.output.impacts == LISTING_NONE);
    arena_close(r.arena);
    r = read_with(MOVES "contact: {model: impacts, impacts: {prototype: rub}, gesture: {}}\n", NULL);
    const struct gesture *g = params_of(r.scene.contacts, gesture_stage.params);
    ck_assert_msg(r.good, "%s", r.messages);
    ck_assert(g->given && g->cutoff == 1e4 && g->speed == 0.5 && g->order == 2);
    m = impact_law_given(r.scene.contacts);
    ck_assert(m->rub.interval == 22.6757e-6 && m->rub.deviation == 0.15);
    arena_close(r.arena);
}
END_TEST

UNIT("scene_impacts", what_is_wrong_is_told_at_its_place, what_is_taken, defaults)
