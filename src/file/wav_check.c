/* See wav_check.h. */
#include "file/wav_check.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "base/memory.h"

static double little_endian(const unsigned char *p, int n)
{
    double v = 0;
    while (n-- > 0)
        v = 256 * v + p[n];
    return v;
}

/* Bytes by which a RIFF or RF64 file is shorter than its data chunk says; 0 for other files and for a length left open
   by a program that wrote into a pipe. */
static double missing_bytes(FILE *f)
{
    unsigned char head[12], long_data[28];
    double length = 0, size, open_end = 4294967295.0;
    if (fread(head, 1, 12, f) != 12 || memcmp(head + 8, "WAVE", 4) != 0 ||
        (memcmp(head, "RIFF", 4) && memcmp(head, "RF64", 4)))
        return 0;
    while (fread(head, 1, 8, f) == 8) {
        size = little_endian(head + 4, 4);
        if (!memcmp(head, "data", 4)) {
            off_t at = ftello(f);
            fseeko(f, 0, SEEK_END);
            size = size == open_end ? length : size;
            return fmax(0, (double)at + size - (double)ftello(f));
        }
        if (!memcmp(head, "ds64", 4) && size >= 28 && fread(long_data, 1, 28, f) == 28) {
            length = little_endian(long_data + 8, 8);
            size -= 28;
        }
        if (fseeko(f, (off_t)(size + fmod(size, 2)), SEEK_CUR) != 0) break;
    }
    return 0;
}

bool wav_check(const char *path, struct err *e)
{
    struct stat s;
    if (stat(path, &s) == 0 && !S_ISREG(s.st_mode)) /* to open a pipe is to wait for who writes into it */
        return err_set(e, ERR_INPUT, "%s: is not a file", path);
    FILE *f = memory_fopen(path, "rb");
    if (!f) return err_set(e, err_system(ERR_INPUT), "%s: %s", path, strerror(errno));
    double missing = missing_bytes(f);
    fclose(f);
    if (missing > 0)
        return err_set(e, ERR_SCENE, "%s: is truncated: its last %.0f bytes are missing: copy or export it again", path,
                       missing);
    return true;
}
