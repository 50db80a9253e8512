/* heightfile_sdf: ISO 25178-71 by hand, from NIST's and NPL's pages, and damaged ones. */
#include "heights.h"

/* The binary header; counts of `wide` bytes. */
static void header(const char *version, int wide, unsigned points, unsigned profiles, const double scales[3],
                   const int bytes[3])
{
    size = 0;
    put(version, 8);
    put("maker\0\0\0\0\0", 10);
    put("311220249999", 12);
    put("000000000000", 12);
    number(points, wide);
    number(profiles, wide);
    for (int i = 0; i < 3; i++)
        f64(scales[i]);
    f64(-1);
    for (int i = 0; i < 3; i++)
        number((unsigned)bytes[i], 1);
}

static const double scales[3] = {1e-6, 2e-6, 1e-9};

static void check_type(int type, int bytes, const uint64_t raw[4], const double want[4])
{
    header("bBCR-0.0", 2, 2, 2, scales, (const int[]){0, type, 0});
    ck_assert_uint_eq(size, 81);
    for (int i = 0; i < 4; i++)
        number(raw[i], bytes);
    accepted();
    ck_assert(h.columns == 2 && h.rows == 2 && h.pitch_x == 1e-6 && h.pitch_y == 2e-6 && h.metric &&
              !strcmp(h.format, "SDF (binary)"));
    size_t holes = 0;
    for (int i = 0; i < 4; i++) {
        holes += isnan(want[i]);
        ck_assert_msg(isnan(want[i]) ? isnan(h.z[i]) : h.z[i] == want[i] * 1e-9, "type %d, height %d: %g", type, i,
                      h.z[i]);
    }
    ck_assert_uint_eq(h.holes, holes);
    ck_assert(type == 3 || type == 7 ? h.step == 0 : h.step == 1e-9);
}

/* All eight types; the highest unsigned and the lowest signed of 16 and 32 bits stand for missing points, as does NaN.
 */
START_TEST(binary_types)
{
    check_type(0, 1, (const uint64_t[]){0, 1, 128, 255}, (const double[]){0, 1, 128, 255});
    check_type(1, 2, (const uint64_t[]){0, 1, 65534, 65535}, (const double[]){0, 1, 65534, NAN});
    check_type(2, 4, (const uint64_t[]){0, 1, 0xfffffffe, 0xffffffff}, (const double[]){0, 1, 4294967294.0, NAN});
    check_type(3, 4, (const uint64_t[]){0, 0x3f800000, 0xc0200000, 0x7fc00000}, (const double[]){0, 1, -2.5, NAN});
    check_type(4, 1, (const uint64_t[]){0, 1, 0x80, 0xff}, (const double[]){0, 1, -128, -1});
    check_type(5, 2, (const uint64_t[]){0, 1, 0x8001, 0x8000}, (const double[]){0, 1, -32767, NAN});
    check_type(6, 4, (const uint64_t[]){0, 1, 0x80000001, 0x80000000}, (const double[]){0, 1, -2147483647.0, NAN});
    check_type(7, 8, (const uint64_t[]){0, 0x3ff0000000000000, 0xc004000000000000, 0x7ff8000000000000},
               (const double[]){0, 1, -2.5, NAN});
}
END_TEST

START_TEST(binary_versions)
{
    header("bISO-2.0", 4, 70000, 1, (const double[]){1e-6, 0, 1e-9},
           (const int[]){0, 0, 0}); /* 32-bit counts; a profile: Yscale 0 */
    for (int i = 0; i < 70000; i++)
        number((unsigned)i, 1);
    accepted();
    ck_assert(h.columns == 70000 && h.rows == 1 && isnan(h.pitch_y) && h.z[69999] == (69999 & 255) * 1e-9);
    header("bISO-1.0", 2, 2, 1, scales, (const int[]){0, 1, 0}); /* 8 bytes of header more */
    number(5, 4);
    number(1, 4);
    number(7, 2);
    number(9, 2);
    accepted();
    ck_assert(h.z[0] == 7 * 1e-9 && h.z[1] == 9 * 1e-9);
    header("bNPL-V1.", 2, 2, 1, scales, (const int[]){0, 1, 0}); /* a trailer is passed over */
    number(7, 2);
    number(9, 2);
    text("made in spring");
    accepted();
    ck_assert(h.z[0] == 7 * 1e-9);
}
END_TEST

static void bad_header(const double *s, const int *bytes, unsigned points, const char *says)
{
    header("bBCR-0.0", 2, points, 2, s, bytes);
    for (int i = 0; i < 4; i++)
        number(0, 2);
    refused(says);
}

START_TEST(binary_damaged)
{
    static const int good[3] = {0, 1, 0};
    bad_header(scales, (const int[]){1, 1, 0}, 2, "Compression is 1");
    bad_header(scales, (const int[]){0, 8, 0}, 2, "DataType must be a whole number from 0 to 7, not 8");
    bad_header((const double[]){0, 1e-6, 1e-9}, good, 2, "Xscale is 0");
    bad_header((const double[]){1e-6, -1e-6, 1e-9}, good, 2, "Yscale is -1e-06");
    bad_header((const double[]){1e-6, 1e-6, NAN}, good, 2, "Zscale is nan");
    bad_header(scales, good, 0, "4.29497e+09, not 0");
    bad_header(scales, good, 3, "3 x 2 numbers of 2 bytes should follow byte 81, and 8 bytes do");
    bad_header(scales, good, 65535, "65535 x 2 heights should follow");
    header("bBCR-0.0", 2, 2, 2, scales, good);
    while (size-- > 46)
        refused("the file ends inside its SDF header");
}
END_TEST

static void sdf(const char *lines, const char *data)
{
    size = 0;
    text(lines);
    text(data);
}

#define NPL                                                                                                            \
    "aNPL-V1.0\nManuFacID = Softgauges\nCreateDate = 210520051200\nModDate = 210520051200\nNumPoints = "               \
    "5\nNumProfiles = 1\nXscale = 2.5E-07\n"                                                                           \
    "Yscale = 0\nZscale = 1E-06\nZresolution = -1\nCompression = 0\nDataType = 7\nCheckType = 0\n*\n"

START_TEST(text_profile)
{
    sdf(NPL, "-0.296539\n-0.270753\nBAD\n NaN\n1e1\n*\n*\n");
    accepted();
    ck_assert(h.columns == 5 && h.rows == 1 && h.pitch_x == 2.5e-7 && isnan(h.pitch_y) && h.holes == 2 &&
              h.first_hole == 2);
    ck_assert(h.z[0] == -0.296539 * 1e-6 && isnan(h.z[3]) && h.z[4] == 10 * 1e-6 && !strcmp(h.format, "SDF (text)"));
    sdf(NPL, "1 2 3\r\n4 5"); /* no second asterisk */
    accepted();
}
END_TEST

/* Keys in other cases and another order, remarks, CR LF, more keys, integers. */
START_TEST(text_map)
{
    sdf("aBCR-0.0\r\nnumprofiles = 2\r\nNUMPOINTS=2 ; two\r\nxscale = 1e-6\r\nyscale = 2e-6\r\nzscale = 1e-9\r\nColour "
        "= red\r\n; remark\r\nDataType = 5\r\n"
        "  *\r\n",
        "1 2\r\n-32768 4\r\n*\r\ntrailer");
    accepted();
    ck_assert(h.columns == 2 && h.rows == 2 && h.pitch_y == 2e-6 && h.z[1] == 2 * 1e-9 && isnan(h.z[2]) &&
              h.step == 1e-9);
}
END_TEST

START_TEST(text_damaged)
{
    sdf(NPL, "1 2 3 4 *");
    refused("5 x 1 heights should stand between the asterisks, and 4 do");
    sdf(NPL, "1 2 3 4 5 6 *");
    refused("more than 5 x 1 heights");
    sdf(NPL, "1 2 x 4 5");
    refused("height 2 (counted from 0) is 'x'");
    sdf(NPL, "1 2 3,5 4 5");
    refused("height 2 (counted from 0) is '3,5'");
    sdf(NPL, "1 2 3 4 1e999");
    refused("infinite");
    sdf("aBC-1.0\nNumPoints = 2\n", "");
    refused("has no end");
    sdf("aBC-1.0\nNumPoints = 2\n*\n", "1 2");
    refused("has no NumProfiles");
    sdf("aBC-1.0\nNumPoints = two\n*\n", "1 2");
    refused("line 2: NumPoints is not a number");
    sdf("aBC-1.0\nNumPoints\n*\n", "1 2");
    refused("line 2: 'NumPoints' is not of the form");
    sdf("aBC-1.0\nNumPoints = 60000\nNumProfiles = 60000\nXscale = 1\nYscale = 1\nZscale = 1\n*\n", "1 2");
    refused("60000 x 60000 heights should follow");
    sdf("aBC-1.0\nNumPoints = -1e300\nNumProfiles = 2\nXscale = 1\nYscale = 1\nZscale = 1\n*\n", "1 2");
    refused("4.29497e+09, not -1e+300");
    sdf("aBC-1.0\nNumPoints = 1.5\nNumProfiles = 2\nXscale = 1\nYscale = 1\nZscale = 1\n*\n", "1 2 3");
    refused("4.29497e+09, not 1.5");
    sdf("a letter to NumPoints\n", "");
    refused("has no end");
    sdf("a letter\n", "");
    refused("is no height map");
    sdf("b\n", "");
    refused("is no height map");
}
END_TEST

UNIT("heightfile_sdf", binary_types, binary_versions, binary_damaged, text_profile, text_map, text_damaged)
