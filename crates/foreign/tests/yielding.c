/* yielding.c: a spring that yields, beside a dashpot. */
#include "trilith_link.h"
#include <math.h>

static const trilith_parameter PARAMETERS[] = {
    {"k", "N/m", "stiffness before it yields", TRILITH_POSITIVE, 0, 0, NAN},
    {"fy", "N", "force at which it yields", TRILITH_POSITIVE, 0, 0, NAN},
    {"c", "N*s/m", "dashpot beside it", TRILITH_NON_NEGATIVE, 0, 0, 0.0},
    {"torn", "m", "elongation at which it tears", TRILITH_POSITIVE, 0, 0, 1.0},
};

static const trilith_field HISTORY[] = {{"slip", "m"}};

static int32_t respond(const double *p, const double *d, const double *v, const double *d0, const double *v0, double dt,
                       const double *history, double *trial, double *f, double *k, double *c, double *energy) {
    const double stiffness = p[0], fy = p[1], dashpot = p[2], torn = p[3];
    if (d[0] > torn) return 1;
    const double elastic = stiffness * (d[0] - history[0]);
    const double q = elastic > fy ? fy : elastic < -fy ? -fy : elastic;
    trial[0] = d[0] - q / stiffness;
    f[0] = q + dashpot * v[0];
    k[0] = q == elastic ? stiffness : 0;
    c[0] = dashpot;
    energy[0] = q * q / (2 * stiffness);
    energy[1] = q * (trial[0] - history[0]);
    energy[2] = dashpot * dt * (v0[0] * v0[0] + v0[0] * v[0] + v[0] * v[0]) / 3;
    (void)d0;
    return 0;
}

static int32_t check(const double *p) { return p[1] / p[0] < p[3] ? 0 : 2; }

static const char *message(int32_t status) {
    return status == 1 ? "torn" : "`torn` must be more than the elongation `fy / k` at which it yields";
}

static const trilith_law YIELDING = {
    .abi = TRILITH_LINK_ABI,
    .flags = TRILITH_RATES | TRILITH_TANGENT | TRILITH_ENERGY,
    .kind = "Yielding",
    .summary = "Spring that yields, beside a dashpot.",
    .law = "f = k (d - p) + c v, |k (d - p)| <= fy",
    .axes = "U1",
    .parameter_count = sizeof PARAMETERS / sizeof *PARAMETERS,
    .parameters = PARAMETERS,
    .history_count = 1,
    .history = HISTORY,
    .respond = respond,
    .check = check,
    .message = message,
};

const trilith_law *trilith_law_at(size_t index) { return index == 0 ? &YIELDING : NULL; }
