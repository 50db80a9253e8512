/* heightfile_csv: grids of numbers. */
#include "heights.h"

static void grid(const char *s)
{
    size = 0;
    text(s);
}

static void reads(const char *s, size_t columns, size_t rows, const double *z)
{
    grid(s);
    accepted();
    ck_assert_msg(h.columns == columns && h.rows == rows, "'%s': %zu x %zu", s, h.columns, h.rows);
    ck_assert(!strcmp(h.format, "CSV") && !h.metric && isnan(h.pitch_x) && h.quantum == 0);
    for (size_t i = 0; i < columns * rows; i++)
        ck_assert_msg(isnan(z[i]) ? isnan(h.z[i]) : h.z[i] == z[i], "'%s': %zu is %g", s, i, h.z[i]);
}

START_TEST(separators)
{
    static const double z[] = {1, -2.5, 3e-6, 4, 5, 0.25};
    reads("1,-2.5,3e-6\n4,5,.25\n", 3, 2, z);
    reads("1;-2.5;3e-6\n4;5;.25", 3, 2, z);
    reads("1 -2.5\t3e-6\n4   5\t .25 \n", 3, 2, z);
    reads("  1 , -2.5 ,3e-6 \r\n4,5,+0.25\r\n", 3, 2, z);
    reads("# a remark, 1\n\n1,-2.5,3e-6\n# 7,8,9\n4,5,0.25\n\n\n", 3, 2, z);
    reads("\xef\xbb\xbf"
          "1,-2.5,3e-6\n4,5,0.25\n",
          3, 2, z);
    reads("1\n-2.5\n3e-6\n4\n5\n.25\n", 6, 1, z); /* one number a line: a profile */
    reads("1 -2.5 3e-6 4 5 .25", 6, 1, z);
}
END_TEST

START_TEST(holes)
{
    reads("1,,3\n,nan,NaN\n", 3, 2, (const double[]){1, NAN, 3, NAN, NAN, NAN});
    reads("1;;\n;2;3\n", 3, 2, (const double[]){1, NAN, NAN, NAN, 2, 3});
    reads("1 nan 3\n", 3, 1, (const double[]){1, NAN, 3});
    reads(",1,2\n3,4,5\n", 3, 2, (const double[]){NAN, 1, 2, 3, 4, 5});
    reads("nan,1\n2,3\n", 2, 2, (const double[]){NAN, 1, 2, 3});
    ck_assert(h.holes == 1 && h.first_hole == 0);
}
END_TEST

static void wrong(const char *s, const char *says)
{
    grid(s);
    refused(says);
}

START_TEST(faults)
{
    wrong("1,2,3\n4,5\n", ":2: has 2 numbers, and line 1 has 3: all rows");
    wrong("# x\n1,2\n\n4,5,6\n", ":4: has 3 numbers, and line 2 has 2");
    wrong("1,2,3\n4,x,6\n", ":2: column 2: 'x' is not a number");
    wrong("1,2,3\n4,5 6,7\n", ":2: column 2: '5 6' is not a number");
    wrong("1,5;2,5\n", "column 1: '1,5' is not a number; write decimal points instead of commas");
    wrong("1 2 3\n4 5mm 6\n", ":2: column 2: '5mm' is not a number");
    wrong("1 2 3\n4 0x1p3 6\n", "'0x1p3' is not a number");
    wrong("1,2,inf\n", "column 3: 'inf' is not a number");
    wrong("1,2,1e999\n", "column 2 (counted from 0) is infinite");
    wrong("x,y,z\n1,2,3\n", "is no height map");
    wrong("# only a remark\n", "is no height map");
    wrong("\n\n", "is no height map");
    wrong("-\n", "is no height map");
    size = 0;
    put("1,2\0,3\n", 7);
    refused("is no height map");
    size = 0;
    put("#\0 um\n1,2,3,4\n", 14); /* a NUL in a remark */
    refused("is no height map");
}
END_TEST

UNIT("heightfile_csv", separators, holes, faults)
