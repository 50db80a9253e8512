/* What a response is, as far as the scene alone tells. */
#ifndef RESPONSE_RESPONSE_H
#define RESPONSE_RESPONSE_H
#include <math.h>
#include <string.h>
#include <sys/stat.h>

#include "trajectory/contact.h"

/* Is a response given at all? */
static inline bool response_given(const struct response *r) { return r->file || r->object.given || r->space.given; }

/* Is it a mode table? */
static inline bool response_is_table(const struct response *r)
{
    size_t n = r->file ? strlen(r->file) : 0;
    return n > 4 && strcmp(r->file + n - 4, ".csv") == 0;
}

/* Is it recorded: an impulse response, or a folder of them? It has no modes. */
static inline bool response_is_recorded(const struct response *r) { return r->file && !response_is_table(r); }

/* Is it a folder of recorded responses, as it is there now? */
static inline bool response_is_folder(const struct response *r)
{
    struct stat status;
    return response_is_recorded(r) && stat(r->file, &status) == 0 && S_ISDIR(status.st_mode);
}

/* Does a place in the space of materials change while the motion lasts? */
static inline bool response_travels(const struct space *s)
{
    return s->given && (!isnan(s->to[0]) || !isnan(s->dimension_to));
}

/* Is the surface heard? */
static inline bool response_surface_rings(const struct contact *c)
{
    return response_given(&c->surface.response) && !contact_mutes_surface(c);
}

/* ... the scraper, or ball? */
static inline bool response_tool_rings(const struct contact *c)
{
    return response_given(&c->scraper.response) && c->scraper.weight != 0 && !contact_mutes_tool(c);
}

/* Does it make a sound? Its gain may still be 0. */
static inline bool response_rings(const struct contact *c)
{
    return response_surface_rings(c) || response_tool_rings(c);
}

/* Is it heard: does it ring, or is its force the sound? Its gain may still be 0. */
static inline bool response_audible(const struct contact *c, const struct output *o)
{
    return response_rings(c) || o->quantity == QUANTITY_FORCE;
}

#endif
