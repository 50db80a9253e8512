/* Scenes as texts, rendered into the test's folder, and the sounds that lie there. */
#ifndef TESTS_UNIT_RENDERS_H
#define TESTS_UNIT_RENDERS_H
#include "file/wav.h"
#include "folder.h"
#include "pipeline/render.h"
#include "scene/scene_read.h"

/* Renders into BASE.wav and what goes with it. */
static inline struct render_report renders_made(const char *text, const char *base)
{
    struct scene s;
    struct err e = {0};
    const char *messages = "";
    struct render_report report;
    if (!scene_read_text(text, strlen(text), folder_path("scene.yaml"), &(struct scene_overrides){0}, folder_arena, &s,
                         &messages, &e))
        ck_abort_msg("%s%s", messages, e.text);
    ck_assert_msg(render_scene(&s, folder_path(base), folder_arena, &report, &e), "%s", e.text);
    return report;
}

static inline struct wav renders_sound(const char *name)
{
    struct wav w;
    struct err e = {0};
    ck_assert_msg(wav_read(folder_path(name), folder_arena, &w, &e), "%s", e.text);
    return w;
}

#endif
