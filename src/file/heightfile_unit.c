/* See heightfile_unit.h. */
#include "file/heightfile_unit.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const struct {
    const char *name;
    double per_metre;
} units[] = {{"", 1},        {"m", 1},    {"mm", 1e3}, {"um", 1e6}, {"\xc2\xb5m", 1e6}, {"\xce\xbcm", 1e6},
             {"\xb5m", 1e6}, {"nm", 1e9}, {"pm", 1e12}};

bool heightfile_unit(const char *name, double *per_metre)
{
    for (size_t i = 0; i < sizeof units / sizeof units[0]; i++)
        if (!strcmp(name, units[i].name)) {
            *per_metre = units[i].per_metre;
            return true;
        }
    return false;
}

uint64_t heightfile_unit_word(const void *bytes, size_t size)
{
    const unsigned char *u = bytes;
    uint64_t v = 0;
    while (size-- > 0)
        v = v << 8 | u[size];
    return v;
}

float heightfile_unit_f32(const void *bytes)
{
    uint32_t w = (uint32_t)heightfile_unit_word(bytes, 4);
    float v;
    memcpy(&v, &w, 4);
    return v;
}

double heightfile_unit_f64(const void *bytes)
{
    uint64_t w = heightfile_unit_word(bytes, 8);
    double v;
    memcpy(&v, &w, 8);
    return v;
}

void heightfile_unit_put(FILE *f, uint64_t value, size_t size)
{
    unsigned char u[8];
    for (size_t i = 0; i < 8; i++)
        u[i] = (unsigned char)(value >> 8 * i);
    fwrite(u, 1, size, f);
}

void heightfile_unit_put_f64(FILE *f, double value)
{
    uint64_t w;
    memcpy(&w, &value, 8);
    heightfile_unit_put(f, w, 8);
}

const char *heightfile_unit_text(char text[32], double value)
{
    for (int digits = 15; digits <= 17; digits++) {
        snprintf(text, 32, "%.*g", digits, value);
        if (isnan(value) || strtod(text, NULL) == value) break;
    }
    return isnan(value) ? "nan" : text;
}
