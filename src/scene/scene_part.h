/* One map of a scene on its way into a struct: the top level (into struct scene), or what describes a contact (into
   struct contact): the top level again, or an entry of contacts. */
#ifndef SCENE_SCENE_PART_H
#define SCENE_SCENE_PART_H
#include "file/yaml.h"
#include "scene/keys.h"

struct scene_part {
    struct yaml *yaml;
    struct yaml_node *map;
    const char *prefix; /* of key names in messages: "", or "contacts.rod." */
    enum key_struct of;
    void *to; /* struct scene or struct contact */
    const struct scene *scene; /* whose own materials are known; NULL: any name of one may be meant */
};

/* A key's name in messages. */
const char *scene_part_label(const struct scene_part *p, const char *path);

/* "contact 'rod'", or "the contact" where there is only one. */
const char *scene_part_contact(const struct scene_part *p, const char *name);

/* Where to say that something is missing in a map of the part: its key, its entry, or the top of the file. */
struct diag_place scene_part_place(const struct scene_part *p, const struct yaml_node *map);

/* The place of that of two keys' values which was laid down later (the command line's rather than the file's); of the
   part if neither is given. */
struct diag_place scene_part_later(const struct scene_part *p, const char *path, const char *other);

/* Tells there that "path SAYS other", and whether one of them is a default. */
void scene_part_contradiction(const struct scene_part *p, const char *path, const char *other, const char *says,
                              const char *cure);

/* Does the scene say something of it? */
bool scene_part_given(const struct scene_part *p, const char *path);

/* Reports what `format` says behind the key's name, where the later of both keys (which may be the same) is given. */
void scene_part_refuse(const struct scene_part *p, const char *path, const char *other, const char *cure,
                       const char *format, ...) __attribute__((format(printf, 5, 6)));

/* Has the key one of its words, or is it left out? Else its error is reported already, and what follows from it is not
 * known. */
bool scene_part_known(const struct scene_part *p, const char *path);

enum scene_part_where {
    SCENE_PART_SINGLE, /* the top level of a scene with one contact: keys of the scene and of the contact */
    SCENE_PART_TOP,    /* the top level beside a list of contacts: a contact's key there is an error      */
    SCENE_PART_ENTRY   /* an entry of contacts                                                            */
};

/* Tells every key of the map (and of the maps in it) that does not belong there, and sections that are not maps.
   `prefix` stands before key names in messages. */
void scene_part_names(struct yaml *y, const struct yaml_node *map, enum scene_part_where where, const char *prefix);

/* Fills every field of the part's struct: given values, defaults, "not given", and sections' flags; tells what is
   missing, does not apply, or excludes another. */
void scene_part_fill(const struct scene_part *p);

/* Is there an unknown key in the path's place whose name is nearly its own? Then the value is not missing: it stands
   there, which is reported by itself. */
bool scene_part_misspelt(const struct scene_part *p, const char *path);

/* Where the path is not there (not even in error): "PATH is missing" and BECAUSE, reported at the innermost map on its
   way, with the line that adds the value. */
void scene_part_missing(const struct scene_part *p, const char *path, const char *value, const char *because);

#endif
