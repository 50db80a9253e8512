/* The section `ablation` of a contact, for scene.h; what it does: scene/ablation.h. */
#ifndef SCENE_ABLATED_H
#define SCENE_ABLATED_H
#include <stdbool.h>

enum ablated_force { ABLATED_FORCE_VARYING, ABLATED_FORCE_CONSTANT };
enum ablated_nonlinearity { ABLATED_NONLINEARITY_FULL, ABLATED_NONLINEARITY_OMITTED, ABLATED_NONLINEARITY_SMOOTHED };
enum ablated_response { ABLATED_RESPONSE_BY_PLACE, ABLATED_RESPONSE_CONSTANT };
enum ablated_sound { ABLATED_SOUND_BOTH, ABLATED_SOUND_SURFACE, ABLATED_SOUND_SCRAPER, ABLATED_SOUND_BALL };

struct ablation { /* what is left out: scene/ablation.h                                */
    bool given;
    int normal_force; /* enum ablated_force                                                */
    int nonlinearity; /* enum ablated_nonlinearity                                         */
    int response;     /* enum ablated_response                                             */
    double place[2];  /* m, of the response that is constant; NAN: where the motion starts  */
    int sound;        /* enum ablated_sound                                                */
};

#endif
