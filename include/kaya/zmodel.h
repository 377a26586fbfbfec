/* SPDX-License-Identifier: MIT */
/* The interface of kaya's zone models: what a zone does with strain. Plain C, one shared library per model; the sister
 * of kaya/jmodel.h, with which it shares limits, tables and the rules for threads and errors.
 *
 * A library exports one function,
 *
 *     const kaya_zmodel* kaya_zone_model(void);
 *
 * which returns a descriptor that stays valid as long as the library is loaded. A batch is a run of n zones that share a
 * zone model and a set of properties: columns in, columns out; row i of every column is the same zone, or the same cell of six
 * zones that strain together.
 *
 * Signs. Stress: tension positive, compression negative. Strain: extension positive. Shear strains are tensor
 * components, half of the engineering ones. The six components are in the order xx, yy, zz, xy, xz, yz. Stress is
 * effective: where there is water, the pore pressure is a separate column, compression positive. Axes are global, and
 * the engine has turned the stress with the material before `run` is called. Angles are degrees. No units are enforced.
 *
 * Threads. `run` is called from several threads at once, each time with its own rows: it must write only to
 * the columns of the batch.
 *
 * History variables start as 0, and are 0 again when a zone gets another model. Stress that was there stays.
 *
 * Errors. `run` returns -1, or the row at which it failed, after writing a sentence to batch->message.
 * Do not throw across this interface; what is thrown all the same is caught, and is reported with the name of the model.
 * So is a stress or a history value that is not finite.
 */
#ifndef KAYA_ZMODEL_H
#define KAYA_ZMODEL_H

#include "kaya/jmodel.h" /* kaya_jhistory, kaya_jtables, limits */

#ifdef __cplusplus
extern "C" {
#endif

/* Libraries made for interface 1 are loaded too: version 2 added `spin` at the end of the batch. A library made for any other version is
 * refused, with both numbers. */
#define KAYA_ZMODEL_INTERFACE 2

/* What a strength reduction with the factor F makes of a property. */
typedef enum kaya_zreduction {
    KAYA_ZREDUCE_NONE = 0,
    KAYA_ZREDUCE_DIVIDE = 1,  /* value / F */
    KAYA_ZREDUCE_TANGENT = 2, /* an angle whose tangent is tan(value) / F */
    KAYA_ZREDUCE_MULTIPLY = 3 /* value * F: the model divides its strength by it */
} kaya_zreduction;

/* One property, in the order of the values that `run` gets. Only `name` must not be NULL. */
typedef struct kaya_zproperty {
    const char* name;    /* "cohesion": lower case, words joined by hyphens */
    const char* aliases; /* other spellings, separated by blanks: "bcohesion"; may be "" */
    const char* unit;    /* "stress", "angle", "length", "-" */
    const char* help;    /* one sentence */
    double initial;      /* value before the user gives one; NAN: there is none */
    double minimum;      /* limits, inclusive; -INFINITY and INFINITY for none */
    double maximum;
    uint32_t optional;  /* with an initial NAN: 0, the user must give a value; 1, the model gets NAN */
    uint32_t reduction; /* kaya_zreduction */
} kaya_zproperty;

/* The zones of one call. Columns marked "in" must not be written. No two columns overlap. */
typedef struct kaya_zbatch {
    size_t n;
    const double* properties;          /* in: the values, in the order of the property table */
    double time_step;                  /* in */
    const double* volume;              /* in: of the zone as it is now */
    const double* strain_inc[6];       /* in: of this step */
    const double* pore_pressure;       /* in */
    double* stress[6];                 /* in: old; out: new */
    double* dissipation;               /* in: 0; out: work per volume that plastic flow took up in this step */
    uint32_t* state;                   /* in, out: bit i belongs to the i-th name of state_names */
    double* const* history;            /* in, out: history[k][i] is variable k of row i */
    const kaya_jtables* tables;        /* in: may be NULL, when there is no deck */
    size_t row;                        /* out: a model that works row by row writes here where it is */
    char message[KAYA_JMODEL_MESSAGE]; /* out: why a row failed */

    /* Since interface 2. In: axial vector w of the spin W of this step, radians; NULL where nothing turns, as in small strain. The
     * engine has turned the stress by (1 - W/2)^-1 (1 + W/2); a model with directions turns them in the same way. */
    const double* spin[3];
} kaya_zbatch;

/* `name`, `run` and `moduli` must not be NULL; neither must a table whose count is not 0. */
typedef struct kaya_zmodel {
    uint32_t interface_version; /* KAYA_ZMODEL_INTERFACE */
    uint32_t size;              /* sizeof(kaya_zmodel) */
    const char* name;           /* keyword: "mohr-coulomb"; lower case, words joined by hyphens */
    const char* title;
    const char* version;
    const kaya_zproperty* properties;
    size_t property_count;
    const kaya_jhistory* history;
    size_t history_count;
    const char* state_names; /* "shear tension": bit 0, bit 1, ...; separated by blanks */

    /* 1: zones of this model yield, so that the zones of a cell may have different strains: it runs at six points of the cell. 0: it runs
     * once for a cell, with its mean strain. */
    uint32_t flows;

    /* One step: old stress and strain increment in, new stress out. */
    ptrdiff_t (*run)(kaya_zbatch* batch);

    /* Whether the values can work together: NULL, or a sentence that says what is wrong and what to do; it is copied
     * before the next call. May be NULL. */
    const char* (*check)(const double* properties);

    /* The greatest bulk and shear moduli with which a zone resists: for the time step, ties and quiet boundaries. */
    void (*moduli)(const double* properties, double* bulk, double* shear);
} kaya_zmodel;

KAYA_JMODEL_EXPORT const kaya_zmodel* kaya_zone_model(void);

#ifdef __cplusplus
}
#endif

#endif /* KAYA_ZMODEL_H */
