/* Laws of links in C, or in any language that makes shared libraries.
 *
 * A library describes its laws by constant tables and exports one function, trilith_law_at. Trilith opens it with
 * `trilith run MODEL --laws ./libmine.so`, or from Python with `trilith.c_laws("./libmine.so")`; a model file then names the
 * laws as it names the built-in kinds. `crates/guide/src/foreign_laws.md` has a whole example.
 *
 * What a law is: a pure function from the deformation of a link, its rate and the history that was committed at the start of
 * the step to force, history at the end of the step, tangents and energies. Equal questions get equal answers, bit for bit; the
 * only memory is the history; functions are called from several threads at once; no exception of C++ and no longjmp may
 * leave one. Everything is in SI: m, rad, s, N, N m, J. Matrices are row by row.
 */
#ifndef TRILITH_LINK_H
#define TRILITH_LINK_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Goes into trilith_law.abi. Another number is refused. */
#define TRILITH_LINK_ABI 1u

/* What a law does; into trilith_law.flags. */
#define TRILITH_RATES 1u   /* it looks at v and v0; without it they are NaN, and c stays zero */
#define TRILITH_TANGENT 2u /* it writes k (and c); without it, central differences of f are taken, by 2 n or 4 n more calls */
#define TRILITH_ENERGY 4u  /* it writes energy; without it, the work done on the link is counted as heat, and runs say so */

/* Numbers that a parameter may have. */
#define TRILITH_ANY 0
#define TRILITH_POSITIVE 1     /* > 0 */
#define TRILITH_NON_NEGATIVE 2 /* >= 0 */
#define TRILITH_WITHIN 3       /* low ... high, both included */
#define TRILITH_ABOVE 4        /* > low, <= high */

/* A parameter of a model file. */
typedef struct trilith_parameter {
    const char *name;     /* a name of letters, digits and _ */
    const char *unit;     /* SI, such as "N/m", "kg m^2" or "1": values in a model are checked for it, and arrive in it */
    const char *meaning;  /* one sentence; may be NULL */
    int32_t range;        /* TRILITH_ANY ... */
    double low, high;     /* of TRILITH_WITHIN and TRILITH_ABOVE */
    double default_value; /* NaN: a model must give it */
} trilith_parameter;

/* A variable of the history. */
typedef struct trilith_field {
    const char *name;
    const char *unit; /* SI, or "1" */
} trilith_field;

/* The law: n coordinates, h history variables. Returns 0, or why there is no answer:
 *   > 0   the law holds no more there (torn, beyond its table). Shorter steps are tried; where none helps, the run ends
 *         with the words of trilith_law.message for this number;
 *   < 0   something is wrong with the law: the run ends at once, with these words. */
typedef int32_t (*trilith_respond)(
    const double *parameters, /* in the order of the table */
    const double *d,          /* n: deformations at the end of the step */
    const double *v,          /* n: rates there */
    const double *d0,         /* n: deformations at the start of the step */
    const double *v0,         /* n: rates there */
    double dt,                /* length of the step, s; 0 in static cases and where the law is only looked at */
    const double *history,    /* h: at the start of the step */
    double *trial,            /* h: at the end of the step; every one is to be written */
    double *f,                /* n: forces, positive where they resist positive d */
    double *k,                /* n*n: df/dd, for fixed d0, v0, dt and history */
    double *c,                /* n*n: df/dv */
    double *energy);          /* 3: stored at the end of the step; heat of the step without and with regard to rates */

/* A law. */
typedef struct trilith_law {
    uint32_t abi;        /* TRILITH_LINK_ABI */
    uint32_t flags;      /* TRILITH_RATES ... */
    const char *kind;    /* name in model files, beginning with a capital letter */
    const char *summary; /* one sentence */
    const char *law;     /* the law in words or formulae; may be NULL */
    const char *source;  /* where it comes from; may be NULL */
    const char *axes;    /* its coordinates: local axes out of U1 U2 U3 R1 R2 R3, such as "U1" or "U2 U3" */
    size_t parameter_count;
    const trilith_parameter *parameters; /* may be NULL where there are none */
    size_t history_count;
    const trilith_field *history;        /* may be NULL where there are none */
    const double *amplitude;             /* n: deformations at which the law does what it is for; may be NULL: 0.01 */
    double frequency;                    /* of such cycles, Hz; 0: 1 */
    trilith_respond respond;
    /* Each of these may be NULL. */
    int32_t (*check)(const double *parameters);              /* parameters that depend on each other: not 0 refuses them */
    void (*engaged)(const double *parameters, double *k);    /* n*n, zeros on entry: stiffness where it is engaged; without
                                                                it, the diagonal of k at rest */
    void (*at_rest)(const double *parameters, double *history); /* h, zeros on entry: history before anything has happened */
    const char *(*message)(int32_t status);                  /* what a status means: constant texts */
} trilith_law;

/* The only name that a library exports: its laws from 0 on, NULL behind the last. Tables and texts stay as they are for as
 * long as the library is open. */
#if defined(_WIN32)
__declspec(dllexport)
#elif defined(__GNUC__)
__attribute__((visibility("default")))
#endif
const trilith_law *trilith_law_at(size_t index);

#ifdef __cplusplus
}
#endif
#endif
