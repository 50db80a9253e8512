/* How much of a motion's way is over ground that is new to it: what is gone over again, there and back, round a circle or within a small place, counts once.

     straight      from end to end
     along path    all of the way: a profile along it has no end
     along x       W D / X      W the width in x of the motion's box, D the way, X how far x went in all, there and back: the profile has W to give, and
                                D / X of way is what a metre of it takes. Round a circle of radius R, however often, pi R
     plane         (W + b) (H + b) / b     W x H the box, b a breadth over which the ground is alike, for a ball contact.leak: a way that goes over nothing
                                twice, taken b wide, lies beside itself in the box that is b/2 wider all round

   in m, and never more than the way itself, in the plane nor than once round a circle. A straight line fits into its box always. In the plane this is a
   bound: a way that keeps to a few lines in a wide box has less. */
#include <math.h>

#include "trajectory/trajectory.h"

enum { GROUND_CHUNK = 256 };

static double ground_went(const struct trajectory *tr)
{
    double t[GROUND_CHUNK], x[GROUND_CHUNK], sum = 0;
    for (long first = 0; first < tr->detail; first += GROUND_CHUNK - 1) {
        long n = tr->detail - first < GROUND_CHUNK ? tr->detail - first + 1 : GROUND_CHUNK;
        for (long i = 0; i < n; i++)
            t[i] = tr->duration * ((double)(first + i) / (double)tr->detail);
        trajectory_at(tr, (size_t)n, t, (struct trajectory_out){.x = x});
        for (long i = 1; i < n; i++)
            sum += fabs(x[i] - x[i - 1]);
    }
    return sum;
}

double trajectory_ground(const struct trajectory *tr, int along, double breadth)
{
    double once = tr->mean_speed * tr->cycle, reached = tr->reach[1] - tr->reach[0], way = once < reached ? once : reached;
    double width = tr->box[1][0] - tr->box[0][0], height = tr->box[1][1] - tr->box[0][1];
    if (tr->straight || along == ALONG_PATH)
        return way;
    if (along == ALONG_PLANE)
        return fmin(fmin(way, tr->lap), (width + breadth) * (height + breadth) / breadth);
    double went = ground_went(tr);
    return went > 0 ? fmin(way, width * (tr->mean_speed * tr->duration / went)) : way;
}
