/* SPDX-License-Identifier: MIT */
/* The native interface of kaya's joint models: plain C, one shared library per model.
 *
 * A library exports one function,
 *
 *     const kaya_jmodel* kaya_joint_model(void);
 *
 * which returns a descriptor that stays valid as long as the library is loaded. The descriptor is a
 * table of metadata and one function over a batch. A batch is a run of n sub-contacts that share a
 * joint model and a set of properties: columns in, columns out; row i of every column is the same
 * sub-contact.
 *
 * Signs. Displacement is that of block 2 relative to block 1, and the unit normal n points from block
 * 1 to block 2. Normal displacement: opening positive. Normal force: compression positive. The force
 * on block 2 is normal_force * n + shear_force, so shear force opposes shear displacement: a spring is
 * shear_force -= stiffness * area * shear_disp_inc. Forces are forces, not stresses: divide by area.
 * Angles are degrees. No units are enforced; they are the deck's.
 *
 * Shear vectors are in global axes and lie in the plane of the contact; the engine has turned them
 * with the plane before `run` is called; and so are three history variables in a row whose names are
 * alike but for their ends -x, -y, -z. Other history variables are plain numbers.
 *
 * Threads. `run` and `initialise` are called from several threads at once, each with its own rows:
 * they must write only to the columns of the batch. The other functions are called from
 * one thread at a time.
 *
 * Arithmetic. The engine rounds to the nearest number and keeps the very small ones. A library may change that, by itself
 * or because it was linked with -ffast-math; the engine undoes the change after each call, and warns the user.
 *
 * Errors. `run` and `initialise` return -1, or the row at which they failed, after writing a sentence
 * to batch->message. Do not throw across this interface; what is thrown all the same is caught, and is
 * reported with the name of the model. So is a force, a stiffness or a history value that is not finite.
 */
#ifndef KAYA_JMODEL_H
#define KAYA_JMODEL_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The number grows with every change that a library can see: a member added, another limit. Members never move, keep
 * their names and meanings, and new ones come last: a library that was built for an older version, from
 * KAYA_JMODEL_OLDEST on, still loads, and a source made for one compiles again. A library made for a newer version than
 * the program's is refused, with both numbers.
 * 1: batches. 2: objects, tables, `row`. 3: places and fields, values of objects, wider limits. 4: roles of properties. */
#define KAYA_JMODEL_INTERFACE 4
#define KAYA_JMODEL_OLDEST 2

#define KAYA_JMODEL_MAX_PROPERTIES 256 /* properties of one model, at most */
#define KAYA_JMODEL_MAX_HISTORY 64     /* history variables of one model, at most */
#define KAYA_JMODEL_MAX_STATES 32      /* state names of one model, at most */
#define KAYA_JMODEL_MAX_FIELDS 8       /* fields of one model, at most */
#define KAYA_JMODEL_MESSAGE 256        /* bytes of a message, with the closing zero */

/* Last members that a model leaves out are NULL, in C by the language, in C++ by this. */
#ifdef __cplusplus
#define KAYA_JMODEL_NONE = NULL
#define KAYA_JMODEL_ZERO = 0
#else
#define KAYA_JMODEL_NONE
#define KAYA_JMODEL_ZERO
#endif

/* What a property means. A factor of safety divides cohesions and tensions, and the tangents of friction; `solve elastic` raises cohesion
 * and tension; checks of values, `list interfaces` and slices ask for the role and not for the name. A property that states none, and each of a
 * library made for interface 3 or older, has the role of its name where it has one of those below and the unit in brackets. */
typedef enum kaya_jrole {
    KAYA_JROLE_BY_NAME = 0,
    KAYA_JROLE_NONE = 1,              /* none, whatever its name */
    KAYA_JROLE_STIFFNESS_NORMAL = 2,  /* stiffness-normal [stress/length] */
    KAYA_JROLE_STIFFNESS_SHEAR = 3,   /* stiffness-shear [stress/length] */
    KAYA_JROLE_FRICTION = 4,          /* friction [angle]: of the peak, degrees */
    KAYA_JROLE_FRICTION_RESIDUAL = 5, /* friction-residual [angle] */
    KAYA_JROLE_FRICTION_OTHER = 6,    /* friction-... [angle]: another angle that is part of the strength */
    KAYA_JROLE_COHESION = 7,          /* cohesion [stress]: of the peak */
    KAYA_JROLE_COHESION_RESIDUAL = 8, /* cohesion-residual [stress] */
    KAYA_JROLE_STRENGTH_OTHER = 9,    /* cohesion-... [stress]: another strength in shear */
    KAYA_JROLE_TENSION = 10,          /* tension [stress]: tensile strength */
    KAYA_JROLE_TENSION_RESIDUAL = 11, /* tension-residual, tension-... [stress] */
    KAYA_JROLE_DILATION = 12,         /* dilation [angle] */
    KAYA_JROLE_WALL_STRENGTH = 13,    /* jcso [stress]: compressive strength of the walls */
    KAYA_JROLE_STRENGTH_FACTOR =
        14 /* strength-factor [-]: the model divides its strength by it; no other property is then reduced */
} kaya_jrole;

/* The cohesion and tension that `solve elastic` gives to joints: nothing reaches them, and no stiffness may follow them. */
#define KAYA_JMODEL_STRONG 1e30

/* One property, in the order of the values that `run` gets. Only `name` must not be NULL. */
typedef struct kaya_jproperty {
    const char* name;    /* "stiffness-normal": lower case, words joined by hyphens */
    const char* aliases; /* other spellings, separated by blanks: "jkn kn"; may be "" */
    const char* unit;    /* "stress/length", "stress", "angle", "length", "-" */
    const char* help;    /* one sentence */
    double initial;      /* value before the user gives one; NAN: there is none */
    double minimum;      /* limits, inclusive; -INFINITY and INFINITY for none */
    double maximum;
    uint32_t optional; /* with an initial NAN: 0, the user must give a value; 1, the model gets NAN */

    /* From interface 4 on. */
    uint32_t role KAYA_JMODEL_ZERO; /* kaya_jrole */
} kaya_jproperty;

/* A number that the model keeps per sub-contact from cycle to cycle; starts as 0. It is saved,
 * restored and hashed with the rest of the state. Only `name` must not be NULL. */
typedef struct kaya_jhistory {
    const char* name; /* "closure" */
    const char* unit;
    const char* help;
} kaya_jhistory;

/* A number of each sub-contact that comes from outside, and that the model only reads: a temperature, a degree of
 * saturation, a roughness that is not the same everywhere. A field with the name of a property of the model is that
 * property, where a sub-contact has its own value; other fields start as `initial`. Users set it by its name, as they set
 * a history variable; it is saved and hashed. Only `name` must not be NULL. */
typedef struct kaya_jfield {
    const char* name; /* "temperature"; or a property: "jrc" */
    const char* unit;
    const char* help;
    double initial; /* before anything is set; not looked at for a property */
} kaya_jfield;

/* What a model keeps of a sub-contact when numbers will not do: an object that begins with this struct.
 * The engine copies, moves, saves and deletes it with the sub-contact and never looks inside. Most models
 * need none; history variables are faster, and users see them. */
typedef struct kaya_jobject {
    const struct kaya_jobject_functions* functions; /* valid as long as the library is loaded */
} kaya_jobject;

/* None of them may be NULL. They are called from one thread at a time for each object. */
typedef struct kaya_jobject_functions {
    kaya_jobject* (*clone)(const kaya_jobject* object);
    void (*destroy)(kaya_jobject* object);
    /* Calls write(sink, bytes, count), any number of times, with the whole state of the object. The same content must always give the same bytes: they are saved, and the hash is made of them. */
    void (*save)(const kaya_jobject* object, void (*write)(void* sink, const void* bytes, size_t count), void* sink);
} kaya_jobject_functions;

/* The tables of the deck at the start of the last command that cycles. */
typedef struct kaya_jtables {
    /* The table of that name or number, NULL when there is none; it stays valid while the model is
     * loaded. It may be called from `initialise` and `run`, in any thread. */
    const void* (*find)(const struct kaya_jtables* tables, const char* name);
    double (*value)(const void* table, double x); /* straight between points, constant beyond the ends */
    double (*slope)(const void* table, double x); /* to the right of x; 0 beyond the ends */
} kaya_jtables;

/* The sub-contacts of one call. Columns marked "in" must not be written: a model that does so is refused when it is
 * tried before the run. No two columns overlap. */
typedef struct kaya_jbatch {
    size_t n;
    const double* properties;      /* in: the values, in the order of the property table */
    double time_step;              /* in */
    const double* area;            /* in: may be 0 */
    const double* normal_disp;     /* in: at the start of the step; opening positive */
    const double* normal_disp_inc; /* in: of this step */
    const double* shear_disp[3];   /* in: at the start of the step */
    const double* shear_disp_inc[3];
    const double* pore_pressure;       /* in: in the joint, compression positive; forces are effective */
    double* normal_force;              /* in: old; out: new */
    double* shear_force[3];            /* in: old; out: new */
    double* normal_stiffness;          /* out: current tangent, stress/length; the time step uses it */
    double* shear_stiffness;           /* out: likewise; leave both as they are if they are constant */
    int stiffness_changed;             /* out: 1 when `run` wrote to a stiffness column; the host sets 0 */
    double* frictional_work;           /* in, out: add what slip and breaking took up in this step */
    uint32_t* state;                   /* in, out: bit i belongs to the i-th name of state_names */
    double* const* history;            /* in, out: history[k][i] is variable k of row i */
    char message[KAYA_JMODEL_MESSAGE]; /* out: why a row failed */
    kaya_jobject** object;             /* in, out: the object of row i or NULL; NULL for a model without `restore` */
    const kaya_jtables* tables;        /* in: may be NULL, when there is no deck */
    size_t row; /* out: a model that works row by row writes here where it is; a crash is reported with it */

    /* From interface 3 on. */
    const double* const* field; /* in: field[k][i] is field k of row i; NULL for a model without fields */
    const double* position[3];  /* in: NULL without KAYA_JMODEL_NEEDS_PLACE, as the next two */
    const double* normal[3];    /* in: unit vector from block 1 to block 2 */
    const int32_t* block[2];    /* in: the numbers of block 1 and block 2, as users see them */
} kaya_jbatch;

/* What a model may ask for. */
#define KAYA_JMODEL_NEEDS_PLACE 1u /* the columns position, normal and block */

/* `name`, `initialise`, `run` and `max_stiffness` must not be NULL; neither must a table whose count
 * is not 0. */
typedef struct kaya_jmodel {
    uint32_t interface_version; /* KAYA_JMODEL_INTERFACE */
    uint32_t size;              /* sizeof(kaya_jmodel) */
    const char* name;           /* keyword of `jmodel`: "mohr"; lower case, words joined by hyphens */
    const char* title;          /* "Coulomb slip with residual strength" */
    const char* version;        /* the model's own version, shown to the user: "1.0" */
    const kaya_jproperty* properties;
    size_t property_count;
    const kaya_jhistory* history;
    size_t history_count;
    const char* state_names; /* "slip tension": bit 0, bit 1, ...; separated by blanks */

    /* New sub-contacts, and old ones whose model or forces were set from outside: make the history
     * agree with the forces and the gap that the batch holds (displacement increments are 0), and set
     * both stiffness columns. */
    ptrdiff_t (*initialise)(kaya_jbatch* batch);

    /* One step: old forces and increments in, new forces out. */
    ptrdiff_t (*run)(kaya_jbatch* batch);

    /* Whether the values can work together: NULL, or a sentence that says what is wrong and what to
     * do; it is copied before the next call. Called when all that must be given are there. May be NULL. */
    const char* (*check)(const double* properties);

    /* The tangent stiffnesses that a sub-contact starts with, stress/length, at the largest: the engine
     * needs them before any force is known. The columns of the batch take over from the first step. */
    void (*max_stiffness)(const double* properties, double* normal, double* shear);

    /* For a model that keeps objects: an object made from the bytes that its `save` gave, or NULL after
     * writing a sentence to message (KAYA_JMODEL_MESSAGE bytes). NULL: the model keeps no objects. */
    kaya_jobject* (*restore)(const double* properties, const void* bytes, size_t count, char* message)KAYA_JMODEL_NONE;

    /* From interface 3 on. */
    const kaya_jfield* fields KAYA_JMODEL_NONE;
    size_t field_count KAYA_JMODEL_ZERO;
    uint32_t needs KAYA_JMODEL_ZERO; /* KAYA_JMODEL_NEEDS_... */

    /* For a model whose objects have their own properties: the value of property `property` in the object, and a new value for
     * it; 0 when the object accepts it. NULL: users see and set only the values of the deck. */
    double (*object_value)(const kaya_jobject* object, size_t property) KAYA_JMODEL_NONE;
    int (*set_object_value)(kaya_jobject* object, size_t property, double value) KAYA_JMODEL_NONE;
} kaya_jmodel;

#if defined(_WIN32)
#define KAYA_JMODEL_EXPORT __declspec(dllexport)
#else
#define KAYA_JMODEL_EXPORT __attribute__((visibility("default")))
#endif

KAYA_JMODEL_EXPORT const kaya_jmodel* kaya_joint_model(void);

#ifdef __cplusplus
}
#endif

#endif /* KAYA_JMODEL_H */
