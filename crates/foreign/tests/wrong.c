/* Tables that are none, one of them chosen by WRONG; and a library that is no library of laws where it is 0. */
#include "trilith_link.h"

static int32_t respond(const double *p, const double *d, const double *v, const double *d0, const double *v0, double dt,
                       const double *history, double *trial, double *f, double *k, double *c, double *energy) {
    (void)p, (void)v, (void)d0, (void)v0, (void)dt, (void)history, (void)trial, (void)k, (void)c, (void)energy;
    f[0] = 0;
    return d[0] > 0.5 ? -7 : 0;
}

#if WRONG == 0
trilith_respond nothing_of_this = respond;
#else
static const trilith_field HISTORY[] = {{"a", "m"}, {"a", "m"}};
static const trilith_law LAW = {
    .abi = TRILITH_LINK_ABI + (WRONG == 1),
    .flags = WRONG == 2 ? 64 : 0,
    .kind = WRONG == 3 ? "lower" : "Fails",
    .axes = WRONG == 4 ? "U1 U7" : "U1",
    .history_count = WRONG == 5 ? 2 : 0,
    .history = HISTORY,
    .parameter_count = WRONG == 6 ? 3 : 0,
    .respond = WRONG == 7 ? 0 : respond,
};
const trilith_law *trilith_law_at(size_t index) { return index == 0 ? &LAW : NULL; }
#endif
